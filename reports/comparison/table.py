"""Table of the measures, with a row for each source and the best of each column marked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from gbnbench.analysis.measure_definitions import DEFINITIONS, Definition, comparable_value
from gbnbench.core.errors import InputError
from gbnbench.core.number_text import error_number, number
from gbnbench.core.sides import sides_text
from gbnbench.reports.source_groups import Group, groups, members
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
class SourceRow:
    """A source with its cells by name of measure, one for each of ``COLUMNS``."""

    source: SourceResult
    cells: dict[str, Cell]


def rows(run: Run, group: Group | None = None) -> list[SourceRow]:
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
    list of SourceRow
        One row for each source.
    """
    filled: list[SourceRow] = []
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
        filled.append(SourceRow(source, cells))
    best = {(place, column.name): _best(filled, place, column) for place in groups(run) for column in COLUMNS}
    return [
        SourceRow(
            row.source,
            {
                name: Cell(**{**vars(cell), "best": cell.text in best[(row.source.n, row.source.d), name]})
                for name, cell in row.cells.items()
            },
        )
        for row in filled
    ]


def _best(filled: Sequence[SourceRow], place: Group, column: Definition) -> set[str]:
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
        Label of the source in one line, with n and d where the run has several, and unequal sides.
    """
    every = groups(run)
    marks = [f"n={source.n}"] if len({n for n, _ in every}) > 1 else []
    marks += [f"d={source.d}"] if len({d for _, d in every}) > 1 else []
    marks += [f"sides {sides_text(source.sides)}"] if source.sides is not None else []
    label = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in source.label)
    return " ".join([label, *marks])


def column_named(name: str) -> Definition:
    """Return the column of this name.

    Raises
    ------
    InputError
        If the table has none of this name.
    """
    for column in COLUMNS:
        if column.name == name:
            return column
    raise InputError(f"the table has no column {name!r}; it has {', '.join(c.name for c in COLUMNS)}")
