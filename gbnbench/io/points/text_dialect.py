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
from gbnbench.io.points.text_cells import BLANKS, cells_between, cells_of, content_line, names_of

TAB = b"\t"

_QUOTES = re.compile(rb'"[^"]*"')
_SEPARATOR = re.compile(rb'[ \t]*"?sep=(.)"?[ \t]*(?=\n|$)', re.IGNORECASE)
_OTHER_COMMENTS = re.compile(rb"%|//|!|;(?=[ \t])|/\*|\*")
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
        What parted the cells there, where anything was replaced, or a tab where that alone parts cells.
    """

    data: bytes
    original: bytes
    separator: bytes | None = None

    def line(self, number: int) -> bytes:
        """Return a line as it stands in the file, by its 1-based number."""
        line = self.original.split(b"\n", number)[number - 1].rstrip()
        return line.lstrip(b" " if self.separator == TAB else BLANKS)

    def cells(self, line: bytes, width: int) -> list[bytes]:
        """Part a line of ``data``; where tabs part cells, blanks and commas are of the cells.

        Parameters
        ----------
        line : bytes
            Without its end.
        width : int
            Cells that rows have; further ones behind tabs that end the line are dropped where they are empty.

        Returns
        -------
        list of bytes
        """
        if self.separator != TAB:
            return cells_of(line.strip(BLANKS))
        cells = cells_between(line, TAB)
        return cells if any(cells[width:]) else cells[:width]

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
        If it is not sure what a comma means, the first line tells a separator that is not known, or it is a
        comment of another language.
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
    if (mark := _OTHER_COMMENTS.match(first.text)) is not None:
        said = f"begins with {shown(mark.group())}, and comments begin with '#' here: write that or remove it"
        raise FormatError(path, said, first.number)
    row = content_line(data, first.end + 1, first.number + 1)
    bare = _QUOTES.sub(b"", first.text)
    # where commas part the rows of a table a name may hold a semicolon
    if told is None and b";" in bare and not (b"," in bare and row is not None and b";" not in row.text):
        told = b";"
    if told is None or told == TAB:
        if row is not None and _is_tabbed_table(data[first.start : first.end], data[row.start : row.end]):
            cells = cells_between(row.text, TAB)
            commas = [cell for cell in cells if _COMMA.fullmatch(cell.lstrip(b"+-"))]
            decimal = commas and all(DECIMAL_COMMA.fullmatch(cell) for cell in commas)
            return PlainText(_with_points(path, data) if decimal else data, data, TAB)
        row = row if names_of(first.text) else first
        if row is None or not _is_tabbed(row.text):
            return PlainText(data, data)
        told = TAB
    return PlainText(_with_points(path, data), data, told)


def _is_tabbed_table(header: bytes, row: bytes) -> bool:
    """Whether tabs alone part the names of a table and the cells of its first row; one may stand in front.

    Several tabs that only line columns up make more cells than there are names, some of them empty.
    """
    header = header.strip(b" ").rstrip()
    names = names_of(header, TAB)
    if len(names) < 2 or b"," in _QUOTES.sub(b"", header):
        return False
    cells = cells_between(row.strip(b" "), TAB)
    while len(cells) > len(names) and not cells[-1]:
        cells.pop()
    return len(cells) == len(names) or (len(cells) == len(names) + 1 and all(cells))


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
