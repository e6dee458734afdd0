"""The table of a comparison for a terminal, with as many columns as fit into a line."""

from __future__ import annotations

import io
import shutil
from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from gbnbench.core.footnotes import footnotes
from gbnbench.core.readable_text import display_width
from gbnbench.reports.comparison.table import COLUMNS, MARKS, Cell, SourceRow, column_named, row_label, rows
from gbnbench.reports.source_groups import Group, groups
from gbnbench.runs.comparison_result import Run

# What a narrow terminal keeps, the first longest.
HEADLINE = (
    "noise_floor", "power_at_1", "peak", "cpu_seconds", "psi6", "min_distance", "evacuated_energy",
    "anisotropy_db", "effective_nyquist", "valence6", "oscillations", "mean_distance",
)  # fmt: skip


NARROWEST = 30  # characters in a line, below which a table is no table


def terminal_table(run: Run, width: int | None = None) -> Table:
    """Return the table for a terminal, with as many columns as fit into a line.

    Parameters
    ----------
    run : Run
        The comparison.
    width : int, optional
        Characters in a line; the width of this terminal where not given.

    Returns
    -------
    rich.table.Table
        One row for each source. It shows all measures with standard errors where they fit, otherwise without,
        and otherwise the main ones alone; the caption says what is left out. ``*`` marks the best of a
        column.
    """
    width = max(width or shutil.get_terminal_size((100, 24)).columns, NARROWEST)
    table_rows = rows(run)
    names = [row_label(row.source, run) for row in table_rows]
    longest = max([6, *map(display_width, names)])
    first = min(longest, max(14, width // 4))
    every = [column.name for column in COLUMNS]
    errors, chosen = True, every
    if _needs(table_rows, every, True, first) > width:
        errors = False
        while _needs(table_rows, chosen, False, first) > width and len(chosen) > 1:
            kept = [name for name in HEADLINE if name in chosen]
            chosen = [n for n in every if n in kept] if len(chosen) == len(every) else _without_last(chosen)
    told = []
    if any(cell.best for row in table_rows for cell in row.cells.values()):
        told.append("* best of its column" + (" at its n and d" if len(groups(run)) > 1 else ""))
    if run.verdicts:
        told.append("▲ better, ▼ worse than the baseline")
    if len(chosen) < len(every):
        told.append(f"{len(every) - len(chosen)} more measures in report.html and the saved table")
    elif not errors:
        told.append("standard errors in report.html and the saved table")
    table = Table(
        caption="; ".join(told) or None, caption_justify="left", box=None, pad_edge=False, padding=(0, 1)
    )
    table.add_column("source", min_width=first, max_width=first, no_wrap=True, overflow="ellipsis")
    for name in chosen:
        least = _column_width(table_rows, name, errors)
        table.add_column(
            column_named(name).title, justify="right", min_width=least, max_width=least, no_wrap=False
        )
    before: Group | None = None
    for row, label in zip(table_rows, names, strict=True):
        place = (row.source.n, row.source.d)
        if before is not None and place != before:
            table.add_section()
        before = place
        table.add_row(Text(label), *[_cell_text(row.cells[name], errors) for name in chosen])
    return table


def terminal_text(run: Run, width: int | None = None, *, colour: bool = False) -> str:
    """Return ``terminal_table`` as text.

    Parameters
    ----------
    run : Run
        The comparison.
    width : int, optional
        Characters in a line; the width of this terminal where not given.
    colour : bool
        Include the escape codes of terminal colours.

    Returns
    -------
    str
        Lines without trailing blanks; below the table the reasons of missing values.
    """
    width = max(width or shutil.get_terminal_size((100, 24)).columns, NARROWEST)
    console = Console(
        file=io.StringIO(), width=width, force_terminal=colour, color_system="standard" if colour else None
    )
    with console.capture() as captured:
        shown = terminal_table(run, width)
        console.print(shown)
    table = [line.rstrip() for line in captured.get().rstrip("\n").split("\n")]
    return "\n".join(
        [*table, *footnotes(_missing(run, {str(column.header) for column in shown.columns}), width)]
    )


def _missing(run: Run, shown: set[str]) -> Iterator[tuple[str, str]]:
    """Titles and reasons of the missing values in the columns that are shown."""
    for row in rows(run):
        for name, cell in row.cells.items():
            title = column_named(name).title
            if cell.reason and title in shown:
                yield title, cell.reason


def _without_last(chosen: Sequence[str]) -> list[str]:
    """Drop the column that matters least."""
    least = [name for name in HEADLINE if name in chosen][-1]
    return [name for name in chosen if name != least]


def _shown(cell: Cell, errors: bool) -> str:
    text = cell.full if errors else cell.text
    return f"{text}{'*' if cell.best else ' '}{MARKS.get(cell.verdict, '')}"


def _cell_text(cell: Cell, errors: bool) -> Text:
    colour = {"better": "green", "worse": "red"}.get(cell.verdict, "")
    return Text(_shown(cell, errors), style=" ".join(filter(None, ["bold" if cell.best else "", colour])))


def _column_width(table_rows: Sequence[SourceRow], name: str, errors: bool) -> int:
    words = [len(word) for word in column_named(name).title.split()]
    return max([*words, *(len(_shown(row.cells[name], errors)) for row in table_rows)])


def _needs(table_rows: Sequence[SourceRow], chosen: Sequence[str], errors: bool, first: int) -> int:
    """Width of the table with these columns: padding of one on either side, none at the edges."""
    return first + sum(2 + _column_width(table_rows, name, errors) for name in chosen)
