"""Table of a comparison in HTML, as a notebook shows it."""

from __future__ import annotations

import html

from gbnbench.reports.comparison import table
from gbnbench.runs.comparison_result import Run


def html_table(run: Run) -> str:
    """Return the table in HTML, the best of each column in bold, standard errors as tooltips.

    Parameters
    ----------
    run : Run
        The comparison.

    Returns
    -------
    str
        A ``<table>`` with a row a source.
    """
    heads = "".join(
        f'<th title="{html.escape(column.text)}">{html.escape(column.title)}</th>' for column in table.COLUMNS
    )
    body = []
    for row in table.rows(run):
        cells = [f"<th>{html.escape(table.row_label(row.source, run))}</th>"]
        for column in table.COLUMNS:
            cell = row.cells[column.name]
            tip, text = html.escape(cell.reason or cell.full), html.escape(cell.text)
            cells.append(f'<td title="{tip}">{f"<b>{text}</b>" if cell.best else text}</td>')
        body.append(f"<tr>{''.join(cells)}</tr>")
    return f"<table><thead><tr><th>source</th>{heads}</tr></thead><tbody>{''.join(body)}</tbody></table>"
