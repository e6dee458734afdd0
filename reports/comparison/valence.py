"""Delaunay valence: Voronoi cells coloured by their number of neighbours, and the share of each degree."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from gbnbench.analysis.spatial.delaunay_stars import SHORTEST_EDGE
from gbnbench.core.errors import RefusalError
from gbnbench.core.periodic_delaunay import (
    copies,
    images_in_box,
    overhang,
    voronoi_diagram,
    with_images,
)
from gbnbench.core.sides import Sides, positions
from gbnbench.core.torus import FloatArray, spacing
from gbnbench.reports import captions, layout, style
from gbnbench.reports.comparison import points
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

# ColorBrewer RdBu around a near white six: fewer neighbours blue, more red; safe for the colour-blind.
DEGREE_COLOURS = {4: "#2166ac", 5: "#92c5de", 6: "#f3f3f1", 7: "#f4a582", 8: "#b2182b"}
TWO_RINGS = np.mgrid[-2.0:3.0, -2.0:3.0].reshape(2, -1).T
DEGREE_NAMES = {4: "4 or fewer", 5: "5", 6: "6", 7: "7", 8: "8 or more"}


def colour(degree: int) -> str:
    """Return the colour of a number of neighbours; below 4 and above 8 take the colours of 4 and 8."""
    return DEGREE_COLOURS[min(max(degree, 4), 8)]


def cells(
    x: FloatArray, side: float = 1.0, sides: Sides | None = None
) -> tuple[list[FloatArray], NDArray[np.intp]]:
    """Voronoi cells of the periodic set that touch the corner [0, side]^2, with their numbers of sides.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.
    side : float
        Share of each side of the torus that is drawn, a corner.
    sides : (float, float), optional
        Sides of the torus, of area 1; a square if not given.

    Returns
    -------
    polygons : list of (m, 2) float64
        Corners of each cell, in the unit of the sides; cells of images of a point repeat its degree.
    degrees : (cells,) intp
        Sides of each cell that have length: its neighbours as the table's valence counts them, so that a
        square grid has four.

    Notes
    -----
    A cell is the periodic one if every empty circle around its corners lies within the images that were
    added (``overhang``). Where a narrow border does not suffice a 5 x 5 tiling does: no empty circle is as
    wide.

    Raises
    ------
    RefusalError
        If the points span no plane.
    """
    unit = spacing(len(x), 2)
    near = min(2.5 * unit, 1.0)
    corner = side * np.array(sides or (1.0, 1.0))
    widest = 1.0 if sides is None else 2 * math.hypot(*sides)
    placed = positions(x, sides)
    for margin in sorted({min(8 * unit, widest), widest}):
        if sides is not None:
            tiled, _ = images_in_box(placed, sides, margin)
        else:
            tiled, _ = with_images(x, margin) if margin < 1.0 else copies(x, TWO_RINGS)
        if side < 1.0:
            tiled = tiled[np.all(tiled <= corner + margin, axis=1)]
        diagram = voronoi_diagram(tiled)
        if diagram is None:
            raise RefusalError("these points have no Voronoi diagram")
        near_box = np.flatnonzero(np.all((tiled >= -near) & (tiled <= corner + near), axis=1))
        near_box = near_box[diagram.point_region[near_box] >= 0]  # the twin of a coincident point has no cell
        regions = [diagram.regions[region] for region in diagram.point_region[near_box]]
        drawn = np.array([len(region) >= 3 and -1 not in region for region in regions])
        inside = np.all((tiled[near_box] >= 0) & (tiled[near_box] < corner), axis=1)
        closed = [region for region, good in zip(regions, drawn, strict=True) if good]
        corners_of = np.array([len(region) for region in closed], dtype=np.intp)
        start = np.concatenate([[0], np.cumsum(corners_of)[:-1]])
        corners = diagram.vertices[np.concatenate([np.array(region) for region in closed])]
        following = np.arange(1, len(corners) + 1)
        following[start + corners_of - 1] = start
        edge = np.hypot(*(corners - corners[following]).T)
        radius = np.hypot(*(corners - np.repeat(tiled[near_box[drawn]], corners_of, axis=0)).T)
        bounding = np.repeat(inside[drawn], corners_of)  # corners of the cells whose points lie in the square
        if (
            not np.any(inside & ~drawn)
            and overhang(corners[bounding], radius[bounding], tuple(corner.tolist())) <= margin
        ):
            break
    degrees = np.add.reduceat(np.asarray(edge > SHORTEST_EDGE * unit, dtype=np.intp), start)
    return np.split(corners, start[1:]), degrees


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
        polygons, degrees = cells(source.points[0], side, source.sides)
    except RefusalError as refusal:
        layout.empty(ax, str(refusal))
        return
    layout.frame(ax)
    width, height = source.sides or (1.0, 1.0)
    ax.set_xlim(0, side * width)
    ax.set_ylim(0, side * height)
    ax.set_aspect("equal")
    classes = np.clip(degrees, 4, 8)
    for degree in np.unique(classes):  # one path a colour: a thousand patches would take a second to draw
        mine = [polygon for polygon, k in zip(polygons, classes, strict=True) if k == degree]
        outline = Path(
            np.concatenate([np.vstack([polygon, polygon[:1]]) for polygon in mine]),
            np.concatenate([[Path.MOVETO, *[Path.LINETO] * (len(p) - 1), Path.CLOSEPOLY] for p in mine]),
        )
        ax.add_artist(
            PathPatch(
                outline,
                facecolor=colour(int(degree)),
                edgecolor="#8a94a3",
                linewidth=0.35 if len(polygons) > 400 else 0.7,
                rasterized=len(polygons) > 2 * points.VECTOR,
            )
        )


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
