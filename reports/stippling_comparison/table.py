"""Table of a comparison of stipplings, with the best of each column marked, also for a terminal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from gbnbench.analysis.measure_definitions import Definition
from gbnbench.core.footnotes import footnotes
from gbnbench.core.number_text import error_number, number
from gbnbench.core.text_table import aligned
from gbnbench.reports.comparison.table import CPU, Cell
from gbnbench.studies.stippling_comparison.measured_set import MEASURES
from gbnbench.studies.stippling_comparison.stippling_results import StipplingResult, StipplingRun

COLUMNS: tuple[Definition, ...] = (*MEASURES, CPU)


@dataclass(frozen=True)
class StipplingRow:
    """A source with its cells by name of measure, one for each of ``COLUMNS``."""

    source: StipplingResult
    cells: dict[str, Cell]


def rows(run: StipplingRun) -> list[StipplingRow]:
    """Return the table as data, in the run's order.

    Parameters
    ----------
    run : StipplingRun
        The comparison.

    Returns
    -------
    list of StipplingRow
        A row a source; the best of a column is that of one n.
    """
    filled = [StipplingRow(source, _cells(source)) for source in run.sources]
    for n in {source.n for source in run.sources}:
        there = [row for row in filled if row.source.n == n]
        for column in COLUMNS:
            best = _best([row.cells[column.name] for row in there], column)
            for row in there:
                cell = row.cells[column.name]
                row.cells[column.name] = replace(cell, best=cell.text == best)
    return filled


def row_label(source: StipplingResult, run: StipplingRun) -> str:
    """Return the text of the first column.

    Parameters
    ----------
    source : StipplingResult
        Source of the row.
    run : StipplingRun
        The comparison.

    Returns
    -------
    str
        Label of the source in one line, with n where the run has several.
    """
    label = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in source.label)
    return f"{label} n={source.n}" if len({one.n for one in run.sources}) > 1 else label


def terminal_text(run: StipplingRun, width: int) -> str:
    """Return the table for a terminal.

    Parameters
    ----------
    run : StipplingRun
        The comparison.
    width : int
        Characters in a line, for the notes below it.

    Returns
    -------
    str
        A line a source, ``*`` at the best of a column; below it why values are missing.
    """
    table = rows(run)
    lines = [
        [row_label(row.source, run), *(f"{c.text}{'*' if c.best else ' '}" for c in row.cells.values())]
        for row in table
    ]
    missing = [
        (column.title, row.cells[column.name].reason)
        for row in table
        for column in COLUMNS
        if row.cells[column.name].reason
    ]
    head = ["source", *(column.title for column in COLUMNS)]
    starred = any(c.best for row in table for c in row.cells.values())
    told = ["* best of its column among sources of as many points"] if starred else []
    return "\n".join([*aligned(head, lines), *told, *footnotes(missing, width)])


def _cells(source: StipplingResult) -> dict[str, Cell]:
    cells = {}
    for column in COLUMNS:
        if column is CPU:
            value, error = source.cpu_seconds, math.nan
            reason = "no generator made these sets" if math.isnan(value) else ""
        else:
            value, error = source.measures[column.name], source.measures.standard_error[column.name]
            reason = source.measures.reasons.get(column.name, "")
        cells[column.name] = Cell(value, error, number(value), error_number(value, error), reason=reason)
    return cells


def _best(cells: Sequence[Cell], column: Definition) -> str:
    """Text of the best value of a column; empty where fewer than two differ."""
    found = {cell.text: cell.value for cell in cells if not math.isnan(cell.value)}
    if len(found) < 2:
        return ""
    choose = min if column.better == "lower" else max
    return choose(found, key=found.__getitem__)
