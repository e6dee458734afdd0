"""Figure of the points of each source: the first realization in the unit square, x to the right and y up."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gbnbench.reports import captions, layout, style
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

MOST = 16384  # beyond this many points in the plane a panel would be solid ink: a corner is shown instead
VECTOR = 4096  # a PDF holds so many points as vectors, more as a picture


def extent(source: SourceResult) -> tuple[float, ...]:
    """Return the sides of the torus as a picture draws them, the longest being 1."""
    sides = source.sides or (1.0,) * source.d
    return tuple(side / max(sides[:2]) for side in sides)


def window(source: SourceResult) -> float:
    """Return the share of each side that a picture shows, a corner: below 1 for very large plane sets."""
    return 1.0 if source.n <= MOST or source.d > 2 else math.sqrt(4096 / source.n)


def note(source: SourceResult) -> str:
    """Say what part of the set the panel shows; empty where it shows a whole plane set."""
    if source.d == 1:
        return "Points on a line."
    if source.d > 2:
        shown = f" of the first {MOST:,} points" if source.n > MOST else ""
        return f"First two of {source.d} coordinates{shown}."
    side = window(source)
    if side == 1.0:
        return ""
    return (
        f"Lower left corner of side {side:.3g}."
        if source.sides is None
        else f"Lower left corner, {side:.3g} of each side."
    )


def panel(ax: Axes, source: SourceResult) -> None:
    """Draw the first realization: ticks on a line in 1D, the first two coordinates in higher dimensions.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    """
    layout.frame(ax)
    x = source.points[0]
    side = window(source)
    right, *above = (side * length for length in extent(source))
    ax.set_xlim(0, right)
    if source.d == 1:
        ax.set_ylim(0, 1)
        ax.vlines(x[:, 0], 0.35, 0.65, color=style.INK, linewidth=0.7, rasterized=len(x) > VECTOR)
        return
    ax.set_ylim(0, above[0])
    ax.set_aspect("equal")
    x = x[(x[:, 0] <= side) & (x[:, 1] <= side)][:MOST]
    if source.sides is not None:
        x = x * extent(source)
    inches = ax.get_position().width * ax.figure.get_figwidth()  # type: ignore[union-attr]
    size = min(max(0.36 * 72 * inches / math.sqrt(max(len(x), 1)), 0.7), 5.0)
    ax.plot(
        x[:, 0], x[:, 1], "o", markersize=size, markeredgewidth=0, color=style.INK, rasterized=len(x) > VECTOR
    )


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw the first realization of every source.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Draw only the sources of this size and dimension; all sources where not given.

    Returns
    -------
    Figure
        One panel for each source.
    """
    sources = members(run, group)
    notes = " ".join(dict.fromkeys(filter(None, map(note, sources))))
    place = "its rectangle or square" if any(s.sides is not None for s in sources) else "the unit square"
    caption = f"First realization of each source in {place}, x right, y up. {notes} ".replace("  ", " ")
    sheet = layout.sheet(
        "Points", caption + captions.settings(run, group), len(sources), 2.5, [2.5], columns=3, left=0.2
    )
    for (ax,), source in zip(sheet.cells, sources, strict=True):
        panel(ax, source)
        ax.set_title(captions.name(source, run, 30), loc="left")
    return sheet.figure
