"""Panels of several figures: their headings, points in the unit square, the middle of a spectrum."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm

from gbnbench.reports import layout, style
from gbnbench.reports.comparison import spectrum
from gbnbench.runs.comparison_result import SourceResult

POWER = (1e-12, 10.0)  # what the log10 map reaches in these figures


def heading(ax: Axes, letter: str, title: str) -> None:
    """Write a panel's letter and title above it.

    Parameters
    ----------
    ax : Axes
        Axes of the panel.
    letter : str
        Letter of the panel, without brackets.
    title : str
        Title of the panel.
    """
    ax.set_title(f"({letter}) {title}", loc="left", size=7.5, pad=2.5)


def scatter(ax: Axes, source: SourceResult, inches: float) -> None:
    """Draw the first set of a source in the unit square.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    inches : float
        Approximate width of the axes, which sets the size of the dots.
    """
    x = source.points[0]
    diameter = min(max(0.36 * 72 * inches / math.sqrt(len(x)), 0.55), 4.0)
    ax.plot(
        x[:, 0], x[:, 1], "o", markersize=diameter, markeredgewidth=0, color=style.INK,
        rasterized=len(x) > 4096,
    )  # fmt: skip
    ax.set(xlim=(0, 1), ylim=(0, 1), aspect="equal")
    layout.frame(ax)


def power_map(ax: Axes, source: SourceResult, reach: float, limits: tuple[float, float] = POWER) -> None:
    """Draw the middle of a spectrum in log10.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    reach : float
        Half the side of the square that is shown, in nu.
    limits : (float, float)
        Range of the colour scale.
    """
    spectrum.panel(ax, source, LogNorm(*limits, clip=True), ticks=False)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))


def power_bar(axes: Sequence[Axes], limits: tuple[float, float] = POWER, **where: Any) -> None:
    """Draw the colour bar of ``power_map`` beside axes.

    Parameters
    ----------
    axes : sequence of Axes
        Axes that the bar belongs to.
    limits : (float, float)
        Range of the colour scale.
    **where : any
        Further arguments of ``Figure.colorbar``, such as ``location``.
    """
    figure = axes[0].figure
    low, high = (round(math.log10(limit)) for limit in limits)
    step = max(1, -(-(high - low) // 5))
    bar = figure.colorbar(
        ScalarMappable(LogNorm(*limits), spectrum.palette()), ax=list(axes), aspect=24, pad=0.02,
        ticks=[10.0**k for k in range(0, low - 1, -step)], **where,
    )  # fmt: skip
    bar.outline.set_linewidth(0.4)
    bar.ax.tick_params(labelsize=6.5, length=2, pad=1.5)
    bar.minorticks_off()
