"""Figure 2: two settings whose points look alike and whose spectra do not."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.figure import SubFigure

from gbnbench.reports import style
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.paper import gallery_requests, panels, radial_axes, wording
from gbnbench.reports.paper.data import ComparisonRequest, DataRequest
from gbnbench.reports.paper.figure import COLUMN, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_columns import generated_column
from gbnbench.reports.paper.method_styles import stroke

NARROW = "gbn[sigma=0.5,iterations=30]"


def _wide(options: FigureOptions) -> tuple[str, int]:
    gradients = options.pick(60, 1000, 3000)
    return f"gbn[sigma=1.1,gradients={gradients}]", gradients


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for many sets of both settings."""
    count = options.pick(2, 32, 1000)
    return {
        "sets": ComparisonRequest((NARROW, _wide(options)[0]), (gallery_requests.size(options),), (2,), count)
    }


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw points and spectra of two settings, and their radial powers in one plot.

    Parameters
    ----------
    data : mapping
        Data under the names that ``needs`` gives them.
    options : FigureOptions
        Scale, sets of the user and seed.

    Returns
    -------
    Drawing
        The figure, as wide as a column, with its caption.
    """
    text, gradients = _wide(options)
    run, n = data["sets"], gallery_requests.size(options)
    narrow = generated_column(run, NARROW, n, "σ = 0.5, 30 steps")
    wide = generated_column(run, text, n, f"σ = 1.1, {gradients:,} gradients")
    both = (narrow, wide)
    strokes = (style.Stroke(style.FAINT, "-"), stroke("gbn"))
    low = radial_axes.lowest(one.source.radial for one in both)

    def paint(panel: SubFigure) -> None:
        pictures, plot = panel.subfigures(2, 1, squeeze=False, height_ratios=[2.15, 1])[:, 0]
        for k, (above, below, one) in enumerate(zip(*pictures.subplots(2, 2), both, strict=True)):
            panels.scatter(above, one.source, 1.6)
            panels.heading(above, "ab"[k], one.title)
            spectrum.panel(below, one.source, None, ticks=False)
        ax = plot.subplots()
        radial_axes.white(ax)
        for one, line, lift in zip(both, strokes, (4.0, 12.0), strict=True):
            radial = one.source.radial
            radial_axes.curve(ax, radial, line)
            spot = int((radial.nu < 0.12).sum()) - 1 if line is strokes[0] else 0
            ax.text(
                radial.nu[spot], lift * radial.power[spot], one.title, size=7, color=line.colour, va="bottom"
            )
        radial_axes.log_nu(ax, 0.97 * n**-0.5)
        radial_axes.log_power(ax, low, 30)
        ax.set_ylabel("radial power")
        panels.heading(ax, "c", "radial power")

    floor = {one.title: one.source.measures["noise_floor"] for one in both}
    near = [one.source.measures["mean_distance"] for one in both]
    caption = (
        "Two settings of Gaussian Blue Noise whose points look alike and whose spectra do not: "
        f"(a) {narrow.title} of the paper's descent; (b) {wide.title} of Nesterov's method. "
        "Top: a set; middle: the mean spectrum in PSA's grey, white from a power of 16, both dark in the "
        "middle to the eye; (c) radial power on exact shells with white noise at 1. The mean distance to the "
        f"nearest neighbour is {near[0]:.2f} and {near[1]:.2f} of the densest packing's, but the noise floor "
        f"(mean power up to a nu of 0.25) {wording.rounded(floor[narrow.title])} and "
        f"{wording.rounded(floor[wide.title])}. {wording.counted(both)} each, d = 2. The paper's (b) took a "
        f"million steps of descent; k gradients of Nesterov's method do the work of about k^2/9 such steps, "
        f"{gradients:,} of {gradients**2 // 9:,}."
    )
    return Drawing(COLUMN, 5.1, paint, caption)


FIGURE = PaperFigure(
    "2",
    "Two settings that look alike",
    "A kernel of half a spacing after 30 steps and one of 1.1 spacings after a million give sets that look "
    "alike, while their spectra differ by many orders of magnitude: the points alone are no guide to sigma.",
    needs,
    draw,
)
