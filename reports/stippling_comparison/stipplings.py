"""Figure of the points alone, large: the first set of every source."""

from __future__ import annotations

from matplotlib.figure import Figure

from gbnbench.reports import layout, style
from gbnbench.reports.captions import shown
from gbnbench.reports.stippling_comparison import captions, panels
from gbnbench.reports.stippling_comparison.table import row_label
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun

WIDTH = 4.4  # inches of a panel


@style.styled
def figure(run: StipplingRun) -> Figure:
    """Draw the first set of every source as a stippling.

    Parameters
    ----------
    run : StipplingRun
        The comparison.

    Returns
    -------
    Figure
        A panel a source, three in a row.
    """
    rows, columns = run.density.shape
    caption = "First set of each source; dots of one size cover as much as the image is dark. "
    sheet = layout.sheet(
        "Stipplings", caption + captions.settings(run), len(run.sources), WIDTH, [WIDTH * rows / columns],
        columns=3, left=0.2,
    )  # fmt: skip
    for (ax,), source in zip(sheet.cells, run.sources, strict=True):
        panels.dots(ax, source.points[0], run.density, WIDTH)
        ax.set_title(shown(row_label(source, run), 50), loc="left")
    return sheet.figure
