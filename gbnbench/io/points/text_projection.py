"""Some columns of a table in text, taken row by row; every row and every comment is checked."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import advised
from gbnbench.io.points.literals import NUMBER, fault_of_cell, shown
from gbnbench.io.points.text_cells import BLANKS, is_quoted_name
from gbnbench.io.points.text_dialect import PlainText
from gbnbench.io.points.text_layout import ColumnLayout

STRUCK = "a point behind a '#': remove one or the other"
# 1-based line, first cell, and whether it alone is quoted
_Front = tuple[int, bytes, bool]


def projected(
    path: Path,
    text: PlainText,
    layout: ColumnLayout,
    header: int | None,
    kept: Sequence[int],
    *,
    chosen: bool,
) -> bytes:
    """Keep some columns of each row.

    Parameters
    ----------
    path : Path
        Named in errors.
    text : PlainText
        The table.
    layout : ColumnLayout
        Its columns.
    header : int or None
        Line of the names, where there is one.
    kept : sequence of int
        The columns, in their order.
    chosen : bool
        Whether the user named them, and so knows of a column in front that the line of names leaves empty.

    Returns
    -------
    bytes
        The rows, parted by blanks, and the comments, each in its line.

    Raises
    ------
    FormatError
        If a row has another width, a cell that is kept is no number, a comment holds a row, or what is left
        out in front numbers or names no rows.
    """
    rows: list[bytes] = []
    front: list[_Front] = []
    whole = False
    for number, raw in enumerate(text.data.split(b"\n"), start=1):
        line = raw.strip(BLANKS)
        if not line or number == header:
            rows.append(b"")
            continue
        if line.startswith(b"#"):
            if _is_row(text.cells(line.lstrip(b"#"), layout.width), layout, kept, whole):
                raise FormatError(path, STRUCK, number)
            rows.append(line)
            continue
        cells = text.cells(raw, layout.width)
        if len(cells) != layout.width:
            said = f"{len(cells)} column{'s' * (len(cells) != 1)} where the lines before have {layout.width}"
            raise FormatError(path, said, number)
        if layout.trailing and cells[-1]:
            said = f"{len(cells)} cells where there are {len(layout.names)} names and an empty end"
            raise FormatError(path, said, number)
        for k in kept:
            if not NUMBER.fullmatch(cells[k]):
                called = repr(layout.names[k]) if layout.names else str(k + 1)
                said = fault_of_cell(text.cell(number, k, cells[k]))
                raise FormatError(path, f"{said}, in column {called}", number)
        rows.append(b" ".join(cells[k] for k in kept))
        whole = all(cells[k].isdigit() for k in kept)
        front.append((number, cells[0], is_quoted_name(line)))
    if layout.trailing and layout.names[0]:
        _refuse_two_meanings(path, front)
    elif layout.in_front or (layout.names and not layout.names[0] and not chosen):
        _check_front(path, front, layout, kept)
    return b"\n".join(rows)


def _is_row(cells: list[bytes], layout: ColumnLayout, kept: Sequence[int], whole: bool) -> bool:
    """Whether a comment holds a row of the table; bare whole numbers do where those of rows are."""
    if len(cells) not in (layout.width, layout.width - layout.trailing):
        return False
    taken = [cells[k] for k in kept]
    return all(NUMBER.fullmatch(cell) for cell in taken) and (
        whole or not all(cell.isdigit() for cell in cells)
    )


def _counts(front: Sequence[_Front]) -> tuple[int, int, bytes] | None:
    """Find the first row that the first column does not count: its line, what would stand, what stands."""
    begin = 0 if front and front[0][1] == b"0" else 1
    for expected, (line, cell, _) in enumerate(front, start=begin):
        if cell != b"%d" % expected:
            return line, expected, cell
    return None


def _check_front(path: Path, front: Sequence[_Front], layout: ColumnLayout, kept: Sequence[int]) -> None:
    """Refuse a first column without a name that neither counts the rows from 0 or 1 nor quotes names."""
    if all(named or not cell for _, cell, named in front):
        return
    wrong = _counts(front)
    if wrong is None:
        return
    line, expected, cell = wrong
    if layout.in_front:  # names could stand over other columns than they seem to
        wanted = "name every column"
    else:
        wanted = f"take the columns wanted, such as {advised([layout.names[k] for k in kept][:3])}"
    raise FormatError(
        path,
        f"the first column has no name and does not number the rows: {shown(cell)} where "
        f"{expected} would stand; {wanted}",
        line,
    )


def _refuse_two_meanings(path: Path, front: Sequence[_Front]) -> None:
    """Refuse rows that end in an empty cell and may begin with the row's number: either may lack a name."""
    if (len(front) > 2 and _counts(front) is None) or (front and all(named for _, _, named in front)):
        raise FormatError(
            path,
            "the first cells number or name the rows and the last are empty: which of the two has no name? "
            "Name every column, or remove the commas at the ends",
            front[0][0],
        )
