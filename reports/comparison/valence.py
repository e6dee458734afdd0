"""Delaunay valence: Voronoi cells coloured by their number of neighbours, and the share of each degree."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from gbnbench.core.errors import RefusalError
from gbnbench.core.sides import Sides
from gbnbench.reports import captions, layout, style
from gbnbench.reports.comparison import points
from gbnbench.reports.comparison.voronoi_cells import cells
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

# ColorBrewer RdBu around a near white six: fewer neighbours blue, more red; safe for the colour-blind.
DEGREE_COLOURS = {4: "#2166ac", 5: "#92c5de", 6: "#f3f3f1", 7: "#f4a582", 8: "#b2182b"}
DEGREE_NAMES = {4: "4 or fewer", 5: "5", 6: "6", 7: "7", 8: "8 or more"}
KEPT_SOURCES = 16  # whose cells are kept: the gallery, the figure and the report show the same


def colour(degree: int) -> str:
    """Return the colour of a number of neighbours; below 4 and above 8 take the colours of 4 and 8."""
    return DEGREE_COLOURS[min(max(degree, 4), 8)]


def panel(ax: Axes, source: SourceResult) -> None:
    """Colour the first realization's cells by valence; in other dimensions say that there is no picture.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        One source of a comparison.
    """
    if source.d != 2:
        layout.empty(ax, "the picture of valence needs d = 2")
        return
    side = points.window(source)
    try:
        outlined = _kept_outlines if source.n <= points.MOST else _outlines
        count, outlines = outlined(source.points[0].tobytes(), side, source.sides)
    except RefusalError as refusal:
        layout.empty(ax, str(refusal))
        return
    layout.frame(ax)
    width, height = source.sides or (1.0, 1.0)
    ax.set_xlim(0, side * width)
    ax.set_ylim(0, side * height)
    ax.set_aspect("equal")
    for degree, outline in outlines.items():
        ax.add_artist(
            PathPatch(
                outline,
                facecolor=colour(degree),
                edgecolor="#8a94a3",
                linewidth=0.35 if count > 400 else 0.7,
                rasterized=count > 2 * points.VECTOR,
            )
        )


def _outlines(x: bytes, side: float, sides: Sides | None) -> tuple[int, dict[int, Path]]:
    """Count the cells of a set of points, and outline each class by one path: a thousand draw slowly."""
    polygons, degrees = cells(np.frombuffer(x).reshape(-1, 2), side, sides)
    classes = np.clip(degrees, 4, 8)
    outlines = {}
    for degree in np.unique(classes):
        mine = [polygon for polygon, k in zip(polygons, classes, strict=True) if k == degree]
        outlines[int(degree)] = Path(
            np.concatenate([np.vstack([polygon, polygon[:1]]) for polygon in mine]),
            np.concatenate([[Path.MOVETO, *[Path.LINETO] * (len(p) - 1), Path.CLOSEPOLY] for p in mine]),
        )
    return len(polygons), outlines


_kept_outlines = lru_cache(maxsize=KEPT_SOURCES)(_outlines)


def histogram_panel(ax: Axes, source: SourceResult) -> None:
    """Draw the share of points of each degree, over all realizations.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        One source of a comparison.
    """
    if source.valence is None:
        layout.empty(ax, f"no Delaunay valence for d = {source.d}")
        return
    degree = source.valence["degree"].to_numpy(dtype=int)
    share = source.valence["share"].to_numpy(dtype=float)
    paint = [colour(int(k)) for k in degree] if source.d == 2 else "#92c5de"
    ax.bar(degree, 100 * share, width=0.8, color=paint, edgecolor="#8a94a3", linewidth=0.5)
    if source.d == 2:
        ax.set_xlim(2.3, 10.7)
        ax.set_xticks(range(3, 11))
        top = float(np.nanmax(share)) if len(share) else 1.0
        for k, s in zip(degree, share, strict=True):
            if s >= 0.005 and 3 <= k <= 10:
                ax.text(
                    k,
                    100 * s + 3 * top,
                    f"{100 * s:.0f}",
                    ha="center",
                    va="bottom",
                    size=6,
                    color=style.FAINT,
                )
    ax.margins(y=0.32)
    ax.set_yticks([])
    ax.spines["left"].set_visible(False)
    ax.tick_params(axis="x", length=0)


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw cells coloured by valence above the histogram of all realizations, one pair for each source.

    Parameters
    ----------
    run : Run
        A comparison.
    group : Group, optional
        The sources to draw; by default all.

    Returns
    -------
    Figure
        With its caption.
    """
    sources = members(run, group)
    flat = any(source.d == 2 for source in sources)
    caption = "Share of points, in percent, with each number of Delaunay neighbours on the torus. "
    if flat:
        caption = (
            "Above: Voronoi cells of the first realization, coloured by number of neighbours, which is the "
            "point's valence in the Delaunay triangulation on the torus. Below: share of points with each "
            "number of neighbours, in percent, all realizations. "
        )
    sheet = layout.sheet(
        "Delaunay valence",
        caption + captions.settings(run, group),
        len(sources),
        2.6,
        [2.6, 0.75] if flat else [1.2],
        columns=3,
        gaps=[0.1] if flat else [],
        left=0.2,
        under=0.3,
        key=0.3 if flat else 0.0,
    )
    for stack, source in zip(sheet.cells, sources, strict=True):
        if flat:
            panel(stack[0], source)
        histogram_panel(stack[-1], source)
        stack[0].set_title(captions.name(source, run, 30), loc="left")
    if flat:
        key(sheet)
    return sheet.figure


def key(sheet: layout.Sheet) -> None:
    """Names of the colours, in a strip above the caption."""
    width, height = sheet.figure.get_size_inches()
    sheet.figure.legend(
        [Patch(facecolor=paint, edgecolor="#8a94a3", linewidth=0.5) for paint in DEGREE_COLOURS.values()],
        list(DEGREE_NAMES.values()),
        loc="lower left",
        bbox_to_anchor=(0.1 / width, sheet.foot / height),
        ncols=5,
        fontsize=7,
        handlelength=1.0,
        columnspacing=1.0,
        handletextpad=0.4,
    )
