"""The table of a comparison in Markdown, with the best of each column in bold."""

from __future__ import annotations

import re
from collections.abc import Sequence

from gbnbench.reports.comparison.table import COLUMNS, MARKS, column_named, row_label, rows
from gbnbench.runs.comparison_result import Run


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
    chosen = [column_named(name) for name in columns] if columns is not None else list(COLUMNS)
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


def _markdown(text: str) -> str:
    return re.sub(r"([\\`*_{}\[\]<>()#+!|~&$])", r"\\\1", text)
