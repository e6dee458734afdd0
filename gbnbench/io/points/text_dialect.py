"""The way a text is written: its line ends, what parts its cells, and whether its commas are decimal.

Semicolons, tabs between decimal commas, and Excel's first line ``sep=;`` are made plain, line by line, so
that every number keeps its line; the text as it stood is kept for errors.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.io.points.file_format import without_marks
from gbnbench.io.points.literals import DECIMAL_COMMA, NUMBER, shown
from gbnbench.io.points.text_cells import cells_between, content_line, names_of

_SEPARATOR = re.compile(rb'[ \t]*"?sep=(.)"?[ \t]*(?=\n|$)', re.IGNORECASE)
_COMMA = re.compile(rb"[0-9]+,[0-9]*|,[0-9]+")
_THOUSANDS = re.compile(rb"[1-9][0-9]{0,2},[0-9]{3}")


@dataclass(frozen=True)
class PlainText:
    """A text whose cells are parted by commas or blanks, with decimal points.

    Attributes
    ----------
    data : bytes
        Its lines end in LF.
    original : bytes
        The same lines before commas and semicolons were replaced.
    separator : bytes or None
        What parted the cells there, where anything was replaced.
    """

    data: bytes
    original: bytes
    separator: bytes | None = None

    def line(self, number: int) -> bytes:
        """Return a line as it stands in the file, by its 1-based number."""
        return self.original.split(b"\n", number)[number - 1].strip()

    def cell(self, number: int, k: int, plain: bytes) -> bytes:
        """Return a cell as it stands in the file.

        Parameters
        ----------
        number : int
            1-based, of its line.
        k : int
            Column, counted from 0.
        plain : bytes
            The cell, made plain.

        Returns
        -------
        bytes
        """
        """Return a cell as it stands in the file: that of column k of a line, which became ``plain``."""
        if self.separator is None:
            return plain
        cells = cells_between(self.line(number), self.separator)
        return cells[k] if k < len(cells) else plain


def plain_text(path: Path, data: bytes) -> PlainText:
    """Write decimal points for commas, and commas for what else parts cells.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole text.

    Returns
    -------
    PlainText

    Raises
    ------
    FormatError
        If it is not sure what a comma means, or the first line tells a separator that is not known.
    """
    data = without_marks(data)
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    told: bytes | None = None
    if (match := _SEPARATOR.match(data)) is not None:
        told = match[1]
        if told not in (b";", b",", b"\t"):
            raise FormatError(path, f"{shown(match.group())}: cells are parted by ; or , or tabs", 1)
        data = data[match.end() :]  # its line stays, empty
    first = content_line(data, 0, 1)
    if first is None or told == b",":
        return PlainText(data, data)
    if told is None and b";" in first.text:
        told = b";"
    if told is None or told == b"\t":
        named = names_of(first.text)
        row = content_line(data, first.end + 1, first.number + 1) if named else first
        if row is None or not _is_tabbed(row.text):
            return PlainText(data, data)
        told = b"\t"
    return PlainText(_with_points(path, data), data, told)


def _is_tabbed(line: bytes) -> bool:
    """Whether tabs part a line of several numbers with decimal commas."""
    cells = [cell.strip().strip(b'"') for cell in line.split(b"\t")]
    return (
        len(cells) > 1
        and any(DECIMAL_COMMA.fullmatch(cell) for cell in cells)
        and all(DECIMAL_COMMA.fullmatch(cell) or NUMBER.fullmatch(cell) for cell in cells)
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
