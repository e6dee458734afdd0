"""Table of runs side by side: a row for each source and measure, a column for each run."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gbnbench.analysis.measure_definitions import Definition
from gbnbench.reports.comparison import table
from gbnbench.reports.source_groups import Group
from gbnbench.runs.joined_runs import JoinedRuns


@dataclass(frozen=True)
class MeasureRow:
    """One measure of one source in every run.

    Attributes
    ----------
    label : str
        The source.
    measure : Definition
        The measure.
    cells : tuple of Cell or None
        One for each run, with the verdict against the first; None where a run lacks the source.
    """

    label: str
    measure: Definition
    cells: tuple[table.Cell | None, ...]


def measure_rows(joined: JoinedRuns, group: Group) -> list[MeasureRow]:
    """Return the rows for one size and dimension, source by source; measures that no run has are left out.

    Parameters
    ----------
    joined : JoinedRuns
        The runs.
    group : (n, d)
        Size and dimension.

    Returns
    -------
    list of MeasureRow
    """
    cells = {row.source.key: row.cells for row in table.rows(joined.run, group)}
    labels = dict.fromkeys(joined.run.series[key][0] for key in cells)
    found = []
    for label in labels:
        sources = [joined.source(label, *group, number) for number in range(len(joined.runs))]
        for column in table.COLUMNS:
            row = tuple(None if s is None else cells[s.key][column.name] for s in sources)
            if any(cell is not None and not math.isnan(cell.value) for cell in row):
                found.append(MeasureRow(label, column, row))
    return found
