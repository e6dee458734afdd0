"""Figure 17: many points, few and many iterations, and the picture found back, beside a cellular method."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.figure import SubFigure

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

PAPER = ("bnot",)
COUNTS = (100, 6000, 100_000)
QUICK_LOOK = "gbn[gradients=50]"  # the work of the paper's 300 iterations of descent


def _sources(options: FigureOptions) -> tuple[str, str, str]:
    most = options.pick(60, 300, 1000)
    return QUICK_LOOK, f"gbn[gradients={most}]", methods_shown(PAPER)[0]


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for a set of few and one of many gradients, and one of a cellular method."""
    return {"sets": request(options, "17", _sources(options), COUNTS)}


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw stipplings above, the image and the pictures found back below.

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
    run, density = data["sets"], data["sets"].density
    sources = sources_of(run, _sources(options))
    titles = [_title(one.label) for one in sources]
    wide = (PAGE - 0.1) / len(sources)
    tall = wide * density.shape[0] / density.shape[1]

    def paint(panel: SubFigure) -> None:
        above, below = panel.subplots(2, len(sources))
        for letter, ax, one, title in zip("abc", above, sources, titles, strict=False):
            dots(ax, one.points[0], density, wide)
            panels.heading(ax, letter, title)
        ink(below[0], density)
        panels.heading(below[0], "a", "the image")
        for ax, one in zip(below[1:], sources[1:], strict=True):
            found_back(ax, one, density)

    few, many = (label.partition("=")[2].rstrip("]") for label in _sources(options)[:2])
    caption = (
        f"Adaptive sampling by {sources[0].n:,} points: (a) GBN after {few} gradients, which do the work of "
        f"about {_steps(few)} steps of descent, the image below; (b) after {many}, about {_steps(many)} "
        f"steps; (c) {titles[-1]}. Below (b, c) the pictures that Algorithm 2 finds back. "
        f"{quality(sources, titles)} {left_out_note(run, PAPER, options, '17')}"
    )
    return Drawing(PAGE, 2 * tall + 0.45, paint, caption)


def _title(label: str) -> str:
    name, bracket, settings = label.partition("[gradients=")
    return f"{title_of(name)}, {settings.rstrip(']')} gradients" if bracket else title_of(label)


def _steps(gradients: str) -> str:
    return f"{int(float(f'{int(gradients) ** 2 / 9:.1g}')):,}"


FIGURE = PaperFigure(
    "17",
    "Many points",
    "100,000 points on an image of 512 x 768 pixels: after 300 iterations, which take about the time of "
    "BNOT, the quality is comparable or better; after 100,000 the picture is found back far better.",
    needs,
    draw,
)
