"""A parser of text to numbers, at numpy speed, that counts them by line and names the line of a fault."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.file_format import NUMERIC, without_marks
from gbnbench.io.points.literals import NUMBER, fault_in_line, too_large
from gbnbench.io.points.point_sets import IntArray

BLOCK = 1 << 21

_COMMENT = re.compile(rb"^[ \t]*#[^\n]*", re.MULTILINE)
_BARE = re.compile(rb"[0-9]+(?![0-9.eE+-])")
# what stood in the file: Standing(line, k, cell), where column k of a line became the cell
Standing = Callable[[int, int, bytes], bytes]
# line, width, value and bare of one block; see Lexed
Tokens = tuple[IntArray, IntArray, FloatArray, NDArray[np.bool_]]


@dataclass(frozen=True)
class Lexed:
    """The numbers of a text file and the lines that hold them.

    Attributes
    ----------
    line : (lines,) int64
        1-based number of each line that holds numbers.
    width : (lines,) int64
        How many it holds, at least 1.
    value : (tokens,) float64
        All numbers in reading order; inf where a literal overflows.
    bare : (tokens,) bool
        True where the literal is digits alone, as counts are.
    comment : (comments,) int64
        1-based numbers of the lines that start with #.
    hidden : (comments,) int64
        How many numbers follow the #, where nothing else does; negative where all of them are bare; 0 for
        other comments.
    mark : (comments,) bool
        True where nothing follows the #.
    """

    line: IntArray
    width: IntArray
    value: FloatArray
    bare: NDArray[np.bool_]
    comment: IntArray
    hidden: IntArray
    mark: NDArray[np.bool_]


def lex(path: Path, data: bytes, names: Sequence[str] = (), standing: Standing | None = None) -> Lexed:
    """Read every number of a text: separated by blanks, or by one comma each, the lines ended in any fashion.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole text.
    names : sequence of str
        Of the columns, for errors; none where the file has none.
    standing : callable, optional
        What to quote in errors in place of a cell, where the text was made plain before.

    Returns
    -------
    Lexed
        The numbers with the lines that they stand in.

    Raises
    ------
    FormatError
        At the first line that holds anything but numbers, apart from comments, or one too large for a float.
    """
    parts: list[Tokens] = []
    comment: list[int] = []
    hidden: list[int] = []
    mark: list[bool] = []
    before = 0
    for raw in _blocks(data):
        block = raw.replace(b"\r\n", b"\n").replace(b"\r", b"\n") if b"\r" in raw else raw
        newlines = np.flatnonzero(np.frombuffer(block, np.uint8) == 10)
        if b"#" in block:
            found = list(_COMMENT.finditer(block))
            at = np.searchsorted(newlines, [match.start() for match in found]) + before + 1
            comment += at.tolist()
            hidden += [_numbers_in(match.group()) for match in found]
            mark += [not match.group().strip(b"# \t") for match in found]
            block = _COMMENT.sub(b"", block)
        part = _fast(block, before) or _slow(path, block, before, names, standing)
        if not np.isfinite(part[2]).all():
            _refuse_infinite(path, block, before, part, standing)
        parts.append(part)
        before += len(newlines)
    line, width, value, bare = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    struck, marks = np.array(hidden, np.int64), np.array(mark, np.bool_)
    return Lexed(line, width, value, bare, np.array(comment, np.int64), struck, marks)


def _blocks(data: bytes) -> Iterator[bytes]:
    """Cut a text after line feeds into blocks that stay in the processor's cache."""
    start = len(data) - len(without_marks(data))
    while True:
        end = data.find(b"\n", start + BLOCK) + 1 or len(data)
        yield data[start:end]
        if end == len(data):
            return
        start = end


def _cells(line: bytes) -> list[bytes]:
    return [cell.strip() for cell in line.split(b",")] if b"," in line else line.split()


def _numbers_in(comment: bytes) -> int:
    """Count the numbers of a comment that could be a point, so that none is lost behind a stray #."""
    cells = _cells(comment.strip().lstrip(b"#"))
    if not all(NUMBER.fullmatch(cell) for cell in cells):
        return 0
    return -len(cells) if all(cell.isdigit() for cell in cells) else len(cells)


def _fast(block: bytes, before: int) -> Tokens | None:
    """Read a block by whole-array steps; None where only the slow reading can tell what is wrong."""
    if block.translate(None, NUMERIC + b" \t\n,"):
        return None
    text = np.frombuffer(block, np.uint8)
    newlines = np.flatnonzero(text == 10)
    inside = (text > 32) & (text != 44)
    opens = inside.copy()
    opens[1:] &= ~inside[:-1]
    starts = np.flatnonzero(opens)
    width = np.diff(np.append(np.searchsorted(starts, newlines), len(starts)), prepend=0)
    if b"," in block:
        commas = np.append(np.searchsorted(np.flatnonzero(text == 44), newlines), block.count(b","))
        commas = np.diff(commas, prepend=0)
        if _has_empty_cell(block) or not np.all((commas == 0) | (commas == width - 1)):
            return None
        block = block.replace(b",", b" ")
    value = _floats(block, len(starts))
    if value is None:
        return None
    bare = np.zeros(len(value), np.bool_)
    for token in np.flatnonzero(value == np.floor(value)):
        bare[token] = _BARE.match(block, int(starts[token])) is not None
    held = np.flatnonzero(width)
    return held + before + 1, width[held], value, bare


def _has_empty_cell(block: bytes) -> bool:
    tight = b"\n" + block.translate(None, b" \t") + b"\n"
    return any(pair in tight for pair in (b",,", b",\n", b"\n,"))


def _floats(block: bytes, count: int) -> FloatArray | None:
    """Read every literal of a block of numerals and blanks; None unless each is one number.

    A literal such as 0.1.2 or 1-2 would be read as two numbers and 1e as none: then the total differs from
    the count of literals, for reading stops at the first that fails.
    """
    if count == 0:
        return np.empty(0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # older numpy warns where it stops
        try:
            value = np.fromstring(block, dtype=np.float64, sep=" ")
        except ValueError:
            return None
    return value if len(value) == count else None


def _slow(
    path: Path, block: bytes, before: int, names: Sequence[str] = (), standing: Standing | None = None
) -> Tokens:
    """Read the same line by line, raising at the first fault."""
    line: list[int] = []
    width: list[int] = []
    value: list[float] = []
    bare: list[bool] = []
    for number, text in enumerate(block.split(b"\n"), start=before + 1):
        if not text.strip():
            continue
        cells = _cells(text)
        for k, cell in enumerate(cells):
            if not NUMBER.fullmatch(cell):
                stood = standing(number, k, cell) if standing is not None else cell
                raise FormatError(path, fault_in_line(stood, k, text, names), number)
        line.append(number)
        width.append(len(cells))
        value += map(float, cells)
        bare += map(bytes.isdigit, cells)
    return np.array(line, np.int64), np.array(width, np.int64), np.array(value), np.array(bare, np.bool_)


def _refuse_infinite(
    path: Path, block: bytes, before: int, part: Tokens, standing: Standing | None
) -> NoReturn:
    """Quote the first literal that overflows."""
    line, width, value, _ = part
    at = int(np.argmin(np.isfinite(value)))
    row = int(np.searchsorted(np.cumsum(width), at, side="right"))
    number, k = int(line[row]), at - int(width[:row].sum())
    cell = _cells(block.split(b"\n")[number - before - 1])[k]
    raise FormatError(path, too_large(cell if standing is None else standing(number, k, cell)), number)
