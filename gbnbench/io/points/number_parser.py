"""A parser of text to numbers, at numpy speed, that counts them by line and names the line of a fault."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.file_format import NUMERIC
from gbnbench.io.points.point_sets import IntArray

BLOCK = 1 << 21
NUMBER = re.compile(rb"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")

_COMMENT = re.compile(rb"^[ \t]*#[^\n]*", re.MULTILINE)
_BARE = re.compile(rb"[0-9]+(?![0-9.eE+-])")
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
        How many numbers follow the #, where nothing else does and not all of them are bare; else 0.
    """

    line: IntArray
    width: IntArray
    value: FloatArray
    bare: NDArray[np.bool_]
    comment: IntArray
    hidden: IntArray


def lex(path: Path, data: bytes) -> Lexed:
    """Read every number of a text: separated by blanks, or by one comma each, the lines ended in any fashion.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole text.

    Returns
    -------
    Lexed
        The numbers with the lines that they stand in.

    Raises
    ------
    FormatError
        At the first line that holds anything but numbers, apart from comments.
    """
    parts: list[Tokens] = []
    comment: list[int] = []
    hidden: list[int] = []
    before = 0
    for raw in _blocks(data):
        block = raw.replace(b"\r\n", b"\n").replace(b"\r", b"\n") if b"\r" in raw else raw
        newlines = np.flatnonzero(np.frombuffer(block, np.uint8) == 10)
        if b"#" in block:
            found = list(_COMMENT.finditer(block))
            at = np.searchsorted(newlines, [match.start() for match in found]) + before + 1
            comment += at.tolist()
            hidden += [_numbers_in(match.group()) for match in found]
            block = _COMMENT.sub(b"", block)
        parts.append(_fast(block, before) or _slow(path, block, before))
        before += len(newlines)
    line, width, value, bare = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    return Lexed(line, width, value, bare, np.array(comment, np.int64), np.array(hidden, np.int64))


def shown(token: bytes) -> str:
    """Show a literal in an error: quoted, on one line, cut to 40 characters."""
    text = token.decode("utf-8", "backslashreplace")
    return repr(text if len(text) <= 40 else text[:37] + "...")


def _blocks(data: bytes) -> Iterator[bytes]:
    """Cut a text after line feeds into blocks that stay in the processor's cache."""
    start = 3 if data.startswith(b"\xef\xbb\xbf") else 0
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
    plausible = all(NUMBER.fullmatch(cell) for cell in cells) and not all(cell.isdigit() for cell in cells)
    return len(cells) if plausible else 0


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


def _slow(path: Path, block: bytes, before: int) -> Tokens:
    """Read the same line by line, raising at the first fault."""
    line: list[int] = []
    width: list[int] = []
    value: list[float] = []
    bare: list[bool] = []
    for number, text in enumerate(block.split(b"\n"), start=before + 1):
        if not text.strip():
            continue
        cells = _cells(text)
        for cell in cells:
            if not NUMBER.fullmatch(cell):
                raise FormatError(path, _fault(cell, text), number)
        line.append(number)
        width.append(len(cells))
        value += map(float, cells)
        bare += map(bytes.isdigit, cells)
    return np.array(line, np.int64), np.array(width, np.int64), np.array(value), np.array(bare, np.bool_)


def _fault(cell: bytes, line: bytes) -> str:
    """Say what is wrong with a cell that is no number."""
    if not cell:
        if line.rstrip().endswith(b","):
            return "an empty cell after the last comma: remove it, or take columns, such as --columns 1,2"
        return "an empty cell between commas"
    if b'"' in cell:
        return (
            f"{shown(cell)} is not a number; quotes may hold one, without blanks, commas or parted thousands"
        )
    if re.fullmatch(rb"[0-9]+[ \t]+[+-]?[0-9]+", cell):
        return f"{shown(cell)} is not a number; decimal commas are read where semicolons or tabs part cells"
    return f"{shown(cell)} is not a number"
