"""Tables in text made plain: names, quotes, semicolons and decimal commas, row names, and chosen columns.

What other programs put around the numbers is taken away, line by line, so that every number keeps its line.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import SET_NAMES, choose, fault_of_names
from gbnbench.io.points.number_parser import NUMBER, shown

_BLANKS = b" \t\v\f"
_QUOTED = re.compile(rb'(?<![^\s,])"([0-9.eE+-]+)"(?![^\s,])')  # a whole cell, holding a number
_DECIMAL_COMMA = re.compile(rb"[+-]?[0-9]*,[0-9]+(?:[eE][+-]?[0-9]+)?")
_COMMA = re.compile(rb"[0-9]*,[0-9]*")
_THOUSANDS = re.compile(rb"[1-9][0-9]{0,2},[0-9]{3}")
_LINE = re.compile(rb"[^\n]*")
_WORDS = re.compile(rb'"[^"]*"|\S+')


@dataclass(frozen=True)
class _Line:
    """A line that holds more than blanks or a comment."""

    text: bytes
    number: int  # 1-based
    start: int
    end: int


def plain_rows(path: Path, data: bytes, columns: tuple[str, ...] | None) -> tuple[tuple[str, ...], bytes]:
    """Take names, quotes, decimal commas, row names and columns that are not wanted off a table.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole text.
    columns : tuple of str, optional
        The columns wanted.

    Returns
    -------
    names : tuple of str
        Of the columns that remain, in lower case; empty where the file names none.
    data : bytes
        The text of the rows and comments, each in its line; line ends are LF.

    Raises
    ------
    FormatError
        If a column is no coordinate or there is none of that name, or it is not sure what a comma means.
    """
    data = data.removeprefix(b"\xef\xbb\xbf")
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    first = _content_line(data, 0, 1)
    if first is None:
        return (), data
    second = _content_line(data, first.end + 1, first.number + 1)
    rows = second if _names(first.text) else first
    if b";" in first.text or (rows is not None and _is_tabbed(rows.text)):
        data = _with_points(path, data)
        first = _content_line(data, 0, 1)
        assert first is not None  # noqa: S101 - no line was removed
        second = _content_line(data, first.end + 1, first.number + 1)
    names = _names(first.text)
    width = len(_cells(first.text if not names or second is None else second.text))
    if names and names[0] and width == len(names) + 1:  # R names the columns, not that of the row names
        names = ("", *names)
    numbered = bool(names) and names[0] == ""
    width = len(names) or width
    if columns is not None:
        kept = choose(path, columns, names, width)
        kept = [k for k, name in enumerate(names) if name.lower() in SET_NAMES and k not in kept] + kept
        return _projected(path, data, first if names else None, names, kept, width, numbered=False)
    if not names:
        return (), _unquoted(data)
    lower = tuple(name.lower() for name in names)
    fault = fault_of_names([name for name in lower[numbered:] if name not in SET_NAMES])
    if fault is not None:
        raise FormatError(path, fault, first.number)
    if numbered:
        return _projected(path, data, first, lower, range(1, len(names)), width, numbered=True)
    return lower, _unquoted(data[: first.start] + data[first.end :])


def _content_line(data: bytes, start: int, number: int) -> _Line | None:
    """Find the first line from a place on that is neither blank nor a comment."""
    while start < len(data):
        match = _LINE.match(data, start)
        text = match.group().strip(_BLANKS) if match else b""
        end = match.end() if match else len(data)
        if text and not text.startswith(b"#"):
            return _Line(text, number, start, end)
        start, number = end + 1, number + 1
    return None


def _cells(line: bytes) -> list[bytes]:
    """Part a line by commas, else by tabs, else by blanks; quotes hold a cell together and are dropped."""
    if b'"' not in line:
        if b"," in line:
            return [cell.strip() for cell in line.split(b",")]
        return line.split()
    if b"," in line:
        try:
            (row,) = csv.reader([line.decode("latin-1")], skipinitialspace=True)
        except csv.Error:  # a cell beyond its limit of size
            return line.split(b",")
        return [cell.strip().encode("latin-1") for cell in row]
    return [
        cell[1:-1] if len(cell) > 1 and cell[:1] == cell[-1:] == b'"' else cell
        for cell in _WORDS.findall(line)
    ]


def _names(line: bytes) -> tuple[str, ...]:
    """Return the names that a line holds, or none where it is not a line of names."""
    cells = _cells(line)
    if b'"' not in line and b"," not in line and b"\t" in line:
        cells = [cell.strip() for cell in line.split(b"\t")]
    cells = [cell.strip(b"\"'").strip() for cell in cells]
    words = [cell[:1].isalpha() and cell.lower() not in (b"nan", b"inf", b"infinity") for cell in cells]
    if not any(words) or not all(word or not cell for word, cell in zip(words, cells, strict=True)):
        return ()
    return tuple(cell.decode("utf-8", "backslashreplace") for cell in cells)


def _is_tabbed(line: bytes) -> bool:
    """Whether tabs part a line of several numbers with decimal commas."""
    cells = line.split(b"\t")
    numbers = [cell.strip() for cell in cells]
    return (
        len(cells) > 1
        and any(_DECIMAL_COMMA.fullmatch(cell) for cell in numbers)
        and all(_DECIMAL_COMMA.fullmatch(cell) or NUMBER.fullmatch(cell) for cell in numbers)
    )


def _with_points(path: Path, data: bytes) -> bytes:
    """Write decimal points for commas, and commas for semicolons, where it is sure what commas mean."""
    at = _COMMA.search(data)
    if at is not None and all(_THOUSANDS.fullmatch(match.group()) for match in _COMMA.finditer(data)):
        raise FormatError(
            path,
            f"{shown(at.group())} may have a decimal comma or parted thousands: write decimal points",
            data.count(b"\n", 0, at.start()) + 1,
        )
    return data.replace(b",", b".").replace(b";", b",")


def _unquoted(data: bytes) -> bytes:
    return _QUOTED.sub(rb"\1", data) if b'"' in data else data


def _projected(
    path: Path, data: bytes, header: _Line | None, names: Sequence[str], kept: Sequence[int], width: int,
    *, numbered: bool,
) -> tuple[tuple[str, ...], bytes]:  # fmt: skip
    """Keep some columns of each row, and check that what is left out in front numbers or names the rows."""
    rows: list[bytes] = []
    numbers: list[tuple[int, bytes, bool]] = []
    for number, raw in enumerate(data.split(b"\n"), start=1):
        line = raw.strip(_BLANKS)
        if not line or line.startswith(b"#") or (header is not None and number == header.number):
            rows.append(line if line.startswith(b"#") else b"")
            continue
        cells = _cells(line)
        if len(cells) != width:
            said = f"{len(cells)} column{'s' * (len(cells) != 1)} where the lines before have {width}"
            raise FormatError(path, said, number)
        for k in kept:
            if not NUMBER.fullmatch(cells[k]):
                called = repr(names[k]) if names else str(k + 1)
                said = f"{shown(cells[k])} is not a number" if cells[k] else "an empty cell"
                raise FormatError(path, f"{said}, in column {called}", number)
        rows.append(b" ".join(cells[k] for k in kept))
        numbers.append((number, cells[0], line.startswith(b'"') and line.count(b'"') == 2))
    if numbered and not all(named for _, _, named in numbers):
        _check_numbered(path, numbers, [names[k] for k in kept])
    return tuple(names[k].lower() for k in kept) if names else (), b"\n".join(rows)


def _check_numbered(path: Path, numbers: Sequence[tuple[int, bytes, bool]], kept: Sequence[str]) -> None:
    """Refuse a first column without a name that does not count the rows from 0 or 1."""
    begin = 0 if numbers[0][1] == b"0" else 1
    for expected, (line, cell, _) in enumerate(numbers, start=begin):
        if cell != b"%d" % expected:
            raise FormatError(
                path,
                f"the first column has no name and does not number the rows: {shown(cell)} where "
                f"{expected} would stand; take the columns wanted, such as --columns {','.join(kept[:3])}",
                line,
            )
