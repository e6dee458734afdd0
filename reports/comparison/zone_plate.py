"""Figure of zone plates: a chirp sampled at the points and rebuilt by a filter."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gbnbench.reports import captions, layout, style
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult


def panel(ax: Axes, source: SourceResult, *, exact: bool = False) -> None:
    """Draw the zone plate of a source, or say that there is none.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    exact : bool
        Draw pixel for pixel, for axes of at least that many pixels.
    """
    if source.zone_plate is None:
        layout.empty(ax, "a zone plate needs d = 2")
        return
    ax.imshow(
        source.zone_plate,
        cmap="gray",
        vmin=0,
        vmax=1,
        origin="lower",
        extent=(0, 1, 0, 1),
        interpolation="none" if exact else "antialiased",
    )
    layout.frame(ax)


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw the zone plate of the first realization of every source, with one pattern, filter and grey scale.

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
    pixels = max((len(s.zone_plate) for s in sources if s.zone_plate is not None), default=0)
    side = min(max(pixels / style.DPI, 2.6), 4.2)  # about a pixel of the plate to one of the PNG
    caption = (
        "One chirp, its frequency growing from the lower left corner, sampled at the first realization of "
        "each source and rebuilt by the same filter. Fringes around the corner are the signal and their "
        "grain is low-frequency noise; whatever shows farther out is aliasing. "
    )
    sheet = layout.sheet(
        "Zone plates", caption + captions.settings(run, group), len(sources), side, [side],
        columns=3, left=0.2,
    )  # fmt: skip
    for (ax,), source in zip(sheet.cells, sources, strict=True):
        panel(ax, source, exact=True)
        ax.set_title(captions.name(source, run, 30), loc="left")
    return sheet.figure
