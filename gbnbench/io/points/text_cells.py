"""Cells of a line of text: how they are parted, quoted and named."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass

BLANKS = b" \t\v\f"

# a whole cell, holding a number; a # in front of it strikes out its line
_QUOTED = re.compile(rb'(?<![^\s,#])"([0-9.eE+-]+)"(?![^\s,])')
_LINE = re.compile(rb"[^\n]*")
_WORDS = re.compile(rb'"[^"]*"|\S+')


@dataclass(frozen=True)
class Line:
    """A line that holds more than blanks or a comment."""

    text: bytes
    number: int  # 1-based
    start: int
    end: int


def content_line(data: bytes, start: int, number: int) -> Line | None:
    """Find the first line that is neither blank nor a comment.

    Parameters
    ----------
    data : bytes
        A text whose lines end in LF.
    start, number : int
        Where to begin: the place of a line's first byte, and the line's 1-based number.

    Returns
    -------
    Line or None
        None where there is no further one.
    """
    while start < len(data):
        match = _LINE.match(data, start)
        text = match.group().strip(BLANKS) if match else b""
        end = match.end() if match else len(data)
        if text and not text.startswith(b"#"):
            return Line(text, number, start, end)
        start, number = end + 1, number + 1
    return None


def cells_of(line: bytes) -> list[bytes]:
    """Part a line by commas, else by tabs, else by blanks; quotes hold a cell together and are dropped."""
    if b'"' not in line:
        if b"," in line:
            return [cell.strip() for cell in line.split(b",")]
        return line.split()
    if b"," in line:
        return _quoted_cells(line, ",")
    return [
        cell[1:-1] if len(cell) > 1 and cell[:1] == cell[-1:] == b'"' else cell
        for cell in _WORDS.findall(line)
    ]


def cells_between(line: bytes, separator: bytes) -> list[bytes]:
    """Part a line by the given separator alone; quotes hold a cell together and are dropped.

    Parameters
    ----------
    line : bytes
        Without blanks at its ends.
    separator : bytes
        One character.

    Returns
    -------
    list of bytes
    """
    if b'"' in line:
        return _quoted_cells(line, separator.decode())
    return [cell.strip() for cell in line.split(separator)]


def _quoted_cells(line: bytes, separator: str) -> list[bytes]:
    try:
        (row,) = csv.reader([line.decode("latin-1")], delimiter=separator, skipinitialspace=True)
    except csv.Error:  # a cell beyond its limit of size
        return line.split(separator.encode())
    return [cell.strip().encode("latin-1") for cell in row]


def names_of(line: bytes, separator: bytes | None = None) -> tuple[str, ...]:
    """Return the names that a line holds, or none where it is not a line of names.

    Parameters
    ----------
    line : bytes
        Without blanks at its ends.
    separator : bytes, optional
        What parts its cells, where that is known; else commas, tabs or blanks do.

    Returns
    -------
    tuple of str
        A cell without a name is an empty text.
    """
    if separator is None and b'"' not in line and b"," not in line and b"\t" in line:
        separator = b"\t"
    cells = cells_of(line) if separator is None else cells_between(line, separator)
    if cells[:1] == [b""] and cells[1:] and cells[1:] == [b"%d" % k for k in range(len(cells) - 1)]:
        return ("", *(f"x{k}" for k in range(len(cells) - 1)))  # pandas' index and numbers of columns
    names = tuple(_decoded(cell.strip(b"\"'").strip()) for cell in cells)
    words = [name[:1].isalpha() and name.lower() not in ("nan", "inf", "infinity") for name in names]
    if not any(words) or not all(word or not name for word, name in zip(words, names, strict=True)):
        return ()
    return names


def _decoded(name: bytes) -> str:
    """Read a name as UTF-8, or as what older programs of Windows write."""
    try:
        return name.decode()
    except UnicodeDecodeError:
        return name.decode("latin-1")


def unquoted(data: bytes) -> bytes:
    """Drop the quotes around cells that hold a number and nothing else."""
    return _QUOTED.sub(rb"\1", data) if b'"' in data else data


def is_quoted_name(line: bytes) -> bool:
    """Whether a row begins with a quoted cell and quotes no other, as R's rows do."""
    return line.startswith(b'"') and line.count(b'"') == 2
