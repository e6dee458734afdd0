"""Table of the measures, with a row for each source and the best of each column marked."""

from __future__ import annotations

import io
import math
import re
import shutil
from collections.abc import Sequence
from dataclasses import dataclass

from rich.console import Console
from rich.table import Table
from rich.text import Text

from gbnbench.analysis.measure_definitions import DEFINITIONS, Definition, comparable_value
from gbnbench.core.errors import InputError
from gbnbench.core.number_text import error_number, number
from gbnbench.reports.style import Group, groups, members
from gbnbench.runs.comparison_result import Run, SourceResult

CPU = Definition(
    "cpu_seconds",
    "CPU s",
    "seconds a set",
    "lower",
    "Mean processor time to make one set; sets read from files have none.",
    "operating system",
)
COLUMNS: tuple[Definition, ...] = (*DEFINITIONS, CPU)
# What a narrow terminal keeps, the first longest.
HEADLINE = (
    "noise_floor", "power_at_1", "peak", "cpu_seconds", "psi6", "min_distance", "evacuated_energy",
    "anisotropy_db", "effective_nyquist", "valence6", "oscillations", "mean_distance",
)  # fmt: skip
MARKS = {"better": "▲", "worse": "▼"}


@dataclass(frozen=True)
class Cell:
    """One number of the table.

    Attributes
    ----------
    value, error : float
        The measure and its standard error; nan where undefined.
    text, error_text : str
        As shown: three significant digits, "–" for undefined; the error is empty where there is none.
    best : bool
        Whether it is the best of its column among the sources of the same n and d. Values that read the same
        tie, and all of them are marked; an undefined value is never best; nothing is marked where fewer than
        two values are defined, or where all tie.
    verdict : {"better", "worse", ""}
        Against the run's baseline.
    reason : str
        Why it is undefined.
    """

    value: float
    error: float
    text: str
    error_text: str
    best: bool = False
    verdict: str = ""
    reason: str = ""

    @property
    def full(self) -> str:
        """Value and standard error, such as ``0.995 ± 0.012`` or ``(1.23 ± 0.05)e-4``."""
        if not self.error_text:
            return self.text
        mantissa, mark, exponent = self.text.partition("e")
        return f"({mantissa} ± {self.error_text})e{exponent}" if mark else f"{self.text} ± {self.error_text}"


@dataclass(frozen=True)
class Row:
    """A source with its cells by name of measure, one for each of ``COLUMNS``."""

    source: SourceResult
    cells: dict[str, Cell]


def rows(run: Run, group: Group | None = None) -> list[Row]:
    """Return the table as data, in the run's order.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Return only the sources of this size and dimension. The best of a column is always that of one n
        and d.

    Returns
    -------
    list of Row
        One row for each source.
    """
    filled: list[Row] = []
    for source in members(run, group):
        cells = {}
        for column in COLUMNS:
            name = column.name
            if name == CPU.name:
                value, error = float(source.cpu_seconds), math.nan
                reason = "no generator made these sets" if math.isnan(value) else ""
            else:
                value = float(source.measures.measured.get(name, math.nan))
                error = float(source.measures.standard_error.get(name, math.nan))
                reason = source.measures.reasons.get(name, "") if math.isnan(value) else ""
            verdict = run.verdicts.get((source.key, name), "")
            cells[name] = Cell(
                value, error, number(value), error_number(value, error), False, verdict, reason
            )
        filled.append(Row(source, cells))
    best = {(place, column.name): _best(filled, place, column) for place in groups(run) for column in COLUMNS}
    return [
        Row(
            row.source,
            {
                name: Cell(**{**vars(cell), "best": cell.text in best[(row.source.n, row.source.d), name]})
                for name, cell in row.cells.items()
            },
        )
        for row in filled
    ]


def _best(filled: Sequence[Row], place: Group, column: Definition) -> set[str]:
    """Text of the best value of a column among the sources of one n and d; empty where there is none."""
    there = [row for row in filled if (row.source.n, row.source.d) == place]
    found = {
        row.cells[column.name].text: comparable_value(
            column.name, row.cells[column.name].value, row.source.realizations
        )
        for row in there
        if not math.isnan(row.cells[column.name].value)
    }
    if len(found) < 2:
        return set()
    choose = min if column.better == "lower" else max
    return {choose(found, key=found.__getitem__)}


def row_label(source: SourceResult, run: Run) -> str:
    """Return the text of the first column.

    Parameters
    ----------
    source : SourceResult
        Source of the row.
    run : Run
        The comparison.

    Returns
    -------
    str
        Label of the source in one line, with n and d where the run has several.
    """
    every = groups(run)
    marks = [f"n={source.n}"] if len({n for n, _ in every}) > 1 else []
    marks += [f"d={source.d}"] if len({d for _, d in every}) > 1 else []
    label = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in source.label)
    return " ".join([label, *marks])


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
    width = width or shutil.get_terminal_size((100, 24)).columns
    table_rows = rows(run)
    names = [row_label(row.source, run) for row in table_rows]
    longest = max([6, *(len(label) for label in names)])
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
            _by_name(name).title, justify="right", min_width=least, max_width=least, no_wrap=False
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
        Lines without trailing blanks.
    """
    width = width or shutil.get_terminal_size((100, 24)).columns
    console = Console(
        file=io.StringIO(), width=width, force_terminal=colour, color_system="standard" if colour else None
    )
    with console.capture() as captured:
        console.print(terminal_table(run, width))
    return "\n".join(line.rstrip() for line in captured.get().rstrip("\n").split("\n"))


def markdown_table(run: Run, columns: Sequence[str] | None = None, *, errors: bool = False) -> str:
    """Return the table in Markdown, with the best of each column in bold.

    Parameters
    ----------
    run : Run
        The comparison.
    columns : sequence of str, optional
        Names of measures, or ``cpu_seconds``; all columns where not given.
    errors : bool
        Show standard errors.

    Returns
    -------
    str
        Lines of the table.
    """
    chosen = [_by_name(name) for name in columns] if columns is not None else list(COLUMNS)
    lines = ["| " + " | ".join(["source", *(_markdown(column.title) for column in chosen)]) + " |"]
    lines.append("|" + "|".join([" :-- ", *[" --: "] * len(chosen)]) + "|")
    for row in rows(run):
        cells = [_markdown(row_label(row.source, run))]
        for column in chosen:
            cell = row.cells[column.name]
            text = cell.full if errors else cell.text
            text = f"**{text}**" if cell.best else text
            cells.append(f"{text} {MARKS[cell.verdict]}" if cell.verdict in MARKS else text)
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _by_name(name: str) -> Definition:
    for column in COLUMNS:
        if column.name == name:
            return column
    raise InputError(f"the table has no column {name!r}; it has {', '.join(c.name for c in COLUMNS)}")


def _without_last(chosen: Sequence[str]) -> list[str]:
    """Drop the column that matters least."""
    least = [name for name in HEADLINE if name in chosen][-1]
    return [name for name in chosen if name != least]


def _markdown(text: str) -> str:
    return re.sub(r"([\\`*_{}\[\]<>()#+!|~&$])", r"\\\1", text)


def _shown(cell: Cell, errors: bool) -> str:
    text = cell.full if errors else cell.text
    return f"{text}{'*' if cell.best else ' '}{MARKS.get(cell.verdict, '')}"


def _cell_text(cell: Cell, errors: bool) -> Text:
    colour = {"better": "green", "worse": "red"}.get(cell.verdict, "")
    return Text(_shown(cell, errors), style=" ".join(filter(None, ["bold" if cell.best else "", colour])))


def _column_width(table_rows: Sequence[Row], name: str, errors: bool) -> int:
    words = [len(word) for word in _by_name(name).title.split()]
    return max([*words, *(len(_shown(row.cells[name], errors)) for row in table_rows)])


def _needs(table_rows: Sequence[Row], chosen: Sequence[str], errors: bool, first: int) -> int:
    """Width of the table with these columns: padding of one on either side, none at the edges."""
    return first + sum(2 + _column_width(table_rows, name, errors) for name in chosen)
