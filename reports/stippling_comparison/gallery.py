"""Figure with all pictures of every source, a column a source, beside those of the image."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from gbnbench.reports import layout, style
from gbnbench.reports.captions import shown
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.stippling_comparison import captions, panels
from gbnbench.reports.stippling_comparison.table import row_label
from gbnbench.studies.stippling_comparison.stippling_results import StipplingResult, StipplingRun

WIDTH = 2.5  # inches of a panel


def difference_scale(run: StipplingRun) -> float:
    """End of the scale of the difference: twice the root mean square of the source at the first quartile.

    Sources differ by a factor of fifty: a scale that holds the worst would leave the others white.
    """
    each = [float(np.sqrt((s.blurred.astype(np.float64) ** 2).mean())) for s in run.sources]
    return 2 * float(np.quantile(each, 0.25, method="lower")) or 1.0


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
    most = difference_scale(run)
    caption = (
        "Rows: points of the first set, dots covering as much as the image is dark; "
        + (
            "the square of the first column, enlarged, dots of half the width; "
            if run.patch is not None
            else ""
        )
        + "the picture found back from the points alone by Algorithm 2, at its best gain; set less density, "
        "both blurred by 16 pixels, over the mean density, red too many, blue too few: the colours end at "
        f"{most:.2g}, twice the root mean square of the source at the first quartile, so that the better "
        "ones are seen, and what is beyond has the last colour; "
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
    _first_column(first, names, run, most)
    for stack, source in zip(others, run.sources, strict=True):
        stack[0].set_title(shown(row_label(source, run), 30), loc="left", weight="bold")
        for ax, name in zip(stack, names, strict=True):
            panel(ax, name, source, run, most, WIDTH)
    return sheet.figure


def panel(
    ax: Axes, name: str, source: StipplingResult, run: StipplingRun, most: float, inches: float
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
    most : float
        As ``difference_scale`` gives it.
    inches : float
        Width of the axes.
    """
    if name == "found back":
        panels.found_back(ax, source, run.density)
    elif name == "difference":
        panels.difference(ax, source, most)
    elif name == "spectrum there":
        panels.local_spectrum(ax, source)
    else:
        panels.dots(ax, source.points[0], run.density, inches, run.patch if name == "close" else None)


def _first_column(stack: list[Axes], names: list[str], run: StipplingRun, most: float) -> None:
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
            _scale(
                ax,
                ScalarMappable(Normalize(-most, most), panels.DIFFERENCE),
                "over the mean density",
                beyond=True,
            )
        else:
            _scale(ax, ScalarMappable(LogNorm(*panels.POWER), spectrum.palette()), "power")


def _scale(ax: Axes, colours: ScalarMappable, title: str, *, beyond: bool = False) -> None:
    """Draw a colour bar in the middle of empty axes, its ends pointed where there are values beyond them."""
    layout.frame(ax)
    for spine in ax.spines.values():
        spine.set_visible(False)
    bar = ax.inset_axes((0.08, 0.5, 0.84, 0.06))
    drawn = ax.figure.colorbar(
        colours, cax=bar, orientation="horizontal", extend="both" if beyond else "neither"
    )
    drawn.set_label(title, size=7)
    drawn.ax.tick_params(labelsize=6.5)
    drawn.ax.minorticks_off()
