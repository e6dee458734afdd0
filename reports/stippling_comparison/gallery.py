"""Figure with all pictures of every source, a column a source, beside those of the image."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, SymLogNorm
from matplotlib.figure import Figure

from gbnbench.reports import layout, style
from gbnbench.reports.captions import shown
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.stippling_comparison import captions, panels
from gbnbench.reports.stippling_comparison.table import row_label
from gbnbench.studies.stippling_comparison.stippling_results import StipplingResult, StipplingRun

WIDTH = 2.5  # inches of a panel


def difference_scale(run: StipplingRun) -> SymLogNorm:
    """Choose the colours of the difference for good and bad sources, which differ by a factor of fifty.

    Parameters
    ----------
    run : StipplingRun
        The comparison.

    Returns
    -------
    SymLogNorm
        In proportion up to the root mean square of the source at the first quartile, by logarithms beyond,
        up to twice that of the worst.
    """
    each = [float(np.sqrt((s.blurred.astype(np.float64) ** 2).mean())) for s in run.sources]
    linear = float(np.quantile(each, 0.25, method="lower")) or 1.0
    most = 2 * max(linear, *each)
    return SymLogNorm(linear, vmin=-most, vmax=most)


@style.styled
def figure(run: StipplingRun) -> Figure:
    """Draw points, a close look, the picture found back, the difference and the local spectrum of each.

    Parameters
    ----------
    run : StipplingRun
        The comparison.

    Returns
    -------
    Figure
        A column a source, the first the image's.
    """
    rows, columns = run.density.shape
    tall = WIDTH * rows / columns
    names = ["points", "found back", "difference"]
    heights = [tall, tall, tall]
    if run.patch is not None:
        names[1:1] = ["close"]
        heights[1:1] = [WIDTH]
        names.append("spectrum there")
        heights.append(WIDTH)
    scale = difference_scale(run)
    caption = (
        "Rows: points of the first set, dots covering as much as the image is dark; "
        + (
            "the square of the first column, enlarged, dots of half the width; "
            if run.patch is not None
            else ""
        )
        + "the picture found back from the points alone by Algorithm 2, at its best gain; set less density, "
        "both blurred by 16 pixels, over the mean density, red too many, blue too few, colours in "
        f"proportion up to {scale.linthresh:.2g}, the root mean square of the source at the first quartile, "
        "and by logarithms beyond, so that good and bad ones are both seen; "
        + (
            "power of the points less the density in the square, log10, 0 in the middle. "
            if run.patch
            else ""
        )
        + f"{captions.patch_text(run)} {captions.settings(run)}"
    )
    sheet = layout.sheet(
        "Side by side", caption, len(run.sources) + 1, WIDTH, heights, columns=12,
        gaps=[0.1] * (len(heights) - 1), left=0.35, between=0.12, under=0.1,
    )  # fmt: skip
    first, *others = sheet.cells
    _first_column(first, names, run, scale)
    for stack, source in zip(others, run.sources, strict=True):
        stack[0].set_title(shown(row_label(source, run), 30), loc="left", weight="bold")
        for ax, name in zip(stack, names, strict=True):
            panel(ax, name, source, run, scale, WIDTH)
    return sheet.figure


def panel(
    ax: Axes, name: str, source: StipplingResult, run: StipplingRun, scale: SymLogNorm, inches: float
) -> None:
    """Draw one picture of a source.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    name : {"points", "close", "found back", "difference", "spectrum there"}
        Which.
    source : StipplingResult
        Whose.
    run : StipplingRun
        The comparison.
    scale : SymLogNorm
        As ``difference_scale`` gives it.
    inches : float
        Width of the axes.
    """
    if name == "found back":
        panels.found_back(ax, source, run.density)
    elif name == "difference":
        panels.difference(ax, source, scale)
    elif name == "spectrum there":
        panels.local_spectrum(ax, source)
    else:
        panels.dots(ax, source.points[0], run.density, inches, run.patch if name == "close" else None)


def _first_column(stack: list[Axes], names: list[str], run: StipplingRun, scale: SymLogNorm) -> None:
    """Draw the image, its square, and the scales of colour."""
    about = run.manifest["settings"]["density"]
    stack[0].set_title(shown(about["name"], 30), loc="left", weight="bold")
    for ax, name in zip(stack, names, strict=True):
        ax.set_ylabel(name)
        if name == "points":
            panels.ink(ax, run.density, patch=run.patch)
        elif name == "close" and run.patch is not None:
            panels.ink(ax, run.patch.of(run.density))
        elif name == "found back":
            panels.ink(ax, run.density)
        elif name == "difference":
            linear, top = float(scale.linthresh), float(scale.vmax or 1)
            ends = (-top, -linear, 0.0, linear, top)
            _scale(ax, ScalarMappable(scale, panels.DIFFERENCE), "over the mean density", ends)
        else:
            _scale(ax, ScalarMappable(LogNorm(*panels.POWER), spectrum.palette()), "power")


def _scale(ax: Axes, colours: ScalarMappable, title: str, ticks: Sequence[float] | None = None) -> None:
    """Draw a colour bar in the middle of empty axes."""
    layout.frame(ax)
    for spine in ax.spines.values():
        spine.set_visible(False)
    bar = ax.inset_axes((0.08, 0.5, 0.84, 0.06))
    drawn = ax.figure.colorbar(colours, cax=bar, orientation="horizontal")
    if ticks is not None:
        drawn.set_ticks(ticks, labels=[f"{tick:.2g}" for tick in ticks])
    drawn.set_label(title, size=7)
    drawn.ax.tick_params(labelsize=6.5)
    drawn.ax.minorticks_off()
