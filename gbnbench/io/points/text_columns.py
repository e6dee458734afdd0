"""Columns of tables in text: their names, row names and row numbers in front, and chosen ones.

What other programs put around the numbers is taken away, line by line, so that every number keeps its line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import SET_NAMES, choose, fault_of_names, is_axis
from gbnbench.io.points.literals import MISSING, NUMBER
from gbnbench.io.points.text_cells import BLANKS, Line, cells_of, content_line, names_of, unquoted
from gbnbench.io.points.text_dialect import PlainText, plain_text
from gbnbench.io.points.text_layout import ColumnLayout, column_layout
from gbnbench.io.points.text_projection import projected


@dataclass(frozen=True)
class Rows:
    """A text of numbers alone, and what was said of its columns.

    Attributes
    ----------
    names : tuple of str
        Of the columns, in lower case; empty where the file names none.
    data : bytes
        The rows and comments, each in its line; line ends are LF.
    headed : bool
        Whether the names are a line of their own: then lines that start with # part no sets.
    text : PlainText
        Tells what stood in the file in place of a cell.
    kept : tuple of int
        Which columns of the file these are; empty where all are.
    """

    names: tuple[str, ...]
    data: bytes
    headed: bool
    text: PlainText
    kept: tuple[int, ...] = ()

    def cell(self, line: int, k: int, plain: bytes) -> bytes:
        """Return a cell as it stands in the file.

        Parameters
        ----------
        line : int
            1-based.
        k : int
            Column, counted from 0.
        plain : bytes
            The cell, made plain.

        Returns
        -------
        bytes
        """
        return self.text.cell(line, self.kept[k] if k < len(self.kept) else k, plain)


def plain_rows(path: Path, data: bytes, columns: tuple[str, ...] | None, *, counted: bool) -> Rows:
    """Take names, quotes, decimal commas, row names and columns that are not wanted off a table.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole text.
    columns : tuple of str, optional
        The columns wanted.
    counted : bool
        Whether a first line of one or two whole numbers above 1 is a count, never a point.

    Returns
    -------
    Rows

    Raises
    ------
    FormatError
        If a column is no coordinate or there is none of that name, a row has a cell that no name belongs to,
        or it is not sure what a comma means.
    """
    text = plain_text(path, data)
    data = text.data
    first = content_line(data, 0, 1)
    if first is None:
        return Rows((), data, False, text)
    names = _names(text, first)
    if names:
        row = content_line(data, first.end + 1, first.number + 1)
        cells = [] if row is None else text.cells(data[row.start : row.end], len(names))
        if row is not None and _holds_no_number(cells):
            said = f"no number in it, nor in line {first.number}: keep the one line that names the columns"
            raise FormatError(path, said, row.number)
        layout = column_layout(path, names, first, row, cells)
        return _headed(path, text, layout, first, columns)
    names = _names_above(text, first, counted)
    by_number = columns is not None and all(name[:1].isdigit() for name in columns)
    width = len(cells_of(first.text))
    if columns is not None:
        told = () if by_number else names
        kept = _with_sets(names, choose(path, columns, told, width))
        return _kept(path, text, ColumnLayout(names, width), None, kept, chosen=True)
    fault = fault_of_names([name for name in names if name.lower() not in SET_NAMES])
    if fault is not None:
        raise FormatError(
            path,
            f"{fault} (a comment right above the first row names the columns where it has a word for each, "
            "one of them an axis)",
            first.number - 1,
        )
    return Rows(tuple(name.lower() for name in names), unquoted(data), False, text)


def column_names(path: Path, data: bytes) -> tuple[str, ...]:
    """Tell the names of a table's columns.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole text.

    Returns
    -------
    tuple of str
        As they stand in a first line of words, or in a comment right above the first row; empty where there
        are none.

    Raises
    ------
    FormatError
        If it is not sure what a comma means.
    """
    text = plain_text(path, data)
    first = content_line(text.data, 0, 1)
    if first is None:
        return ()
    return _names(text, first) or _names_above(text, first, counted=True)


def _holds_no_number(cells: Sequence[bytes]) -> bool:
    """Whether a line is of names or units too: words alone, none of which stands for a missing number."""
    return not any(cell.lower() in MISSING or any(digit in cell for digit in b"0123456789") for cell in cells)


def _headed(
    path: Path, text: PlainText, layout: ColumnLayout, header: Line, columns: tuple[str, ...] | None
) -> Rows:
    """Read a table that begins with a line of names."""
    names = layout.names
    if columns is not None:
        kept = _with_sets(names, choose(path, columns, names, len(names)))
        return _kept(path, text, layout, header, kept, chosen=True)
    in_front = int(names[0] == "")
    fault = fault_of_names([name for name in names[in_front:] if name.lower() not in SET_NAMES])
    if fault is not None:
        raise FormatError(path, fault, header.number)
    if in_front or layout.trailing:
        return _kept(path, text, layout, header, range(in_front, len(names)), chosen=False)
    rest = text.data[: header.start] + text.data[header.end :]
    return Rows(tuple(name.lower() for name in names), unquoted(rest), True, text)


def _kept(
    path: Path,
    text: PlainText,
    layout: ColumnLayout,
    header: Line | None,
    kept: Sequence[int],
    *,
    chosen: bool,
) -> Rows:
    data = projected(path, text, layout, None if header is None else header.number, kept, chosen=chosen)
    names = tuple(layout.names[k].lower() for k in kept) if layout.names else ()
    return Rows(names, data, header is not None, text, tuple(kept))


def _with_sets(names: Sequence[str], kept: list[int]) -> list[int]:
    """Add the column of set numbers, which frames the sets whether the user names it or not."""
    return [k for k, name in enumerate(names) if name.lower() in SET_NAMES and k not in kept] + kept


def _names(text: PlainText, line: Line) -> tuple[str, ...]:
    """Return the names of a line as they stand in the file."""
    if not names_of(line.text):
        return ()
    if text.separator is None:
        return names_of(line.text)
    return names_of(text.line(line.number), text.separator)


def _names_above(text: PlainText, first: Line, counted: bool) -> tuple[str, ...]:
    """Return the names in a comment right above the first row, as numpy.savetxt writes them.

    A comment is no line of names where it has another number of words than the row has cells, none of them is
    that of an axis, or the row is a count.
    """
    above = text.data[: max(first.start - 1, 0)].rpartition(b"\n")[2].strip(BLANKS)
    if not above.startswith(b"#"):
        return ()
    cells = cells_of(first.text)
    if not all(NUMBER.fullmatch(cell) for cell in cells):
        return ()
    if len(cells) < 3 and all(cell.isdigit() for cell in cells):
        row = content_line(text.data, first.end + 1, first.number + 1)
        alike = row is not None and len(cells_of(row.text)) == len(cells)
        if not alike or (counted and any(len(cell) > 1 or cell > b"1" for cell in cells)):
            return ()
    words = text.line(first.number - 1).lstrip(b"#").strip(BLANKS)
    names = names_of(words, text.separator)
    return names if len(names) == len(cells) and any(map(is_axis, names)) else ()
