"""Figure 10: adaptive sampling of an image, and the image found back from the points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from matplotlib.figure import SubFigure
from scipy import ndimage

from gbnbench.reports.paper import panels
from gbnbench.reports.paper.data import DataRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.stippling_requests import (
    left_out_note,
    methods_shown,
    quality,
    request,
    sources_of,
    title_of,
)
from gbnbench.reports.stippling_comparison.panels import dots, found_back, ink

PAPER = ("bnot", "kdm")
COUNTS = (100, 2500, 10_000)
BLUR = 0.5  # of the input, in mean spacings: the width of Algorithm 2's kernels


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for a set of each method."""
    return {"sets": request(options, "10", (*methods_shown(PAPER), "gbn"), COUNTS)}


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw the image, points above and pictures found back below.

    Parameters
    ----------
    data : mapping
        Data under the names that ``needs`` gives them.
    options : FigureOptions
        Scale, images of the user and seed.

    Returns
    -------
    Drawing
        The figure, as wide as the page, with its caption.
    """
    run = data["sets"]
    sources = sources_of(run, (*methods_shown(PAPER), "gbn"))
    titles = [title_of(one.label) for one in sources]
    n, density = sources[0].n, run.density
    columns = len(sources) + 1
    wide = (PAGE - 0.1) / columns
    tall = wide * density.shape[0] / density.shape[1]

    def paint(panel: SubFigure) -> None:
        above, below = panel.subplots(2, columns)
        ink(above[0], density)
        ink(below[0], ndimage.gaussian_filter(density, BLUR * math.sqrt(density.size / n), mode="reflect"))
        panels.heading(above[0], "a", "input, blurred below")
        for k, (one, title) in enumerate(zip(sources, titles, strict=True)):
            dots(above[k + 1], one.points[0], density, wide)
            found_back(below[k + 1], one, density)
            panels.heading(above[k + 1], "bcde"[k], title)

    letters = ", ".join(f"({letter}) {title}" for letter, title in zip("bcde", titles, strict=False))
    caption = (
        f"Adaptive sampling of an image by {n:,} points: (a) the image, below it blurred by half the mean "
        f"spacing; {letters}. "
        "Above the points, dots covering as much as the image is dark; below the picture that Algorithm 2 "
        f"finds back from the points alone (15 iterations). {quality(sources, titles)} "
        f"{left_out_note(run, PAPER, options, '10')}"
    )
    return Drawing(PAGE, 2 * tall + 0.3, paint, caption)


FIGURE = PaperFigure(
    "10",
    "Adaptive sampling",
    "A density map sampled by BNOT, KDM and the paper's method, and reconstructed by Algorithm 2: theirs is "
    "much less noisy, and the samples follow the feature lines.",
    needs,
    draw,
)
