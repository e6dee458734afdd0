"""The cells of a table's rows under its names: from the left, or after a cell that names the row."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.io.points.literals import NUMBER
from gbnbench.io.points.text_cells import Line, is_quoted_name


@dataclass(frozen=True)
class ColumnLayout:
    """The columns of a table.

    Attributes
    ----------
    names : tuple of str
        As they stand in the file, empty for a column in front without a name; no names at all where the file
        has none.
    width : int
        Cells of each row.
    trailing : bool
        Whether the last cell of each row is empty and no column: a separator stands at the end of the line.
    in_front : bool
        Whether rows have a cell in front that the line of names lacks, as R writes them.
    """

    names: tuple[str, ...]
    width: int
    trailing: bool = False
    in_front: bool = False


def column_layout(
    path: Path, names: tuple[str, ...], header: Line, row: Line | None, cells: list[bytes]
) -> ColumnLayout:
    """Tell which name belongs to which cell.

    Parameters
    ----------
    path : Path
        Named in errors.
    names : tuple of str
        Of the line of names.
    header : Line
        That line.
    row : Line or None
        The first row.
    cells : list of bytes
        Its cells.

    Returns
    -------
    ColumnLayout

    Raises
    ------
    FormatError
        If the row has more cells than there are names, and they neither end in an empty one nor begin with a
        number or a name of the row.
    """
    if row is None or len(cells) < len(names):
        return ColumnLayout(names, len(names))
    if len(cells) == len(names):
        if len(names) > 1 and names[-1] == cells[-1].decode("latin-1") == "":
            return ColumnLayout(names[:-1], len(cells), trailing=True)
        return ColumnLayout(names, len(names))
    if len(cells) == len(names) + 1:
        if not cells[-1]:
            return ColumnLayout(names, len(cells), trailing=True)
        if names[0] and (cells[0] in (b"0", b"1") or _is_row_name(row.text, cells[0])):
            return ColumnLayout(("", *names), len(cells), in_front=True)
    raise FormatError(
        path,
        f"{len(cells)} cells where line {header.number} has {len(names)} names: name every column "
        "(one in front is left out where it counts the rows from 0 or 1, or has quoted names)",
        row.number,
    )


def _is_row_name(row: bytes, cell: bytes) -> bool:
    """Whether a row begins with a quoted name, which a number with a fraction is not."""
    return is_quoted_name(row) and (cell.isdigit() or not NUMBER.fullmatch(cell))
