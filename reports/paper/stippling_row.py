"""Stipplings of one image in a row: figures 15 and 16."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
from gbnbench.reports.stippling_comparison.panels import dots

COUNTS = (100, 4000, 15_000)


def stippling_row(number: str, title: str, said: str, paper: Sequence[str]) -> PaperFigure:
    """Define a figure of stipplings of one image, ours last.

    Parameters
    ----------
    number, title : str
        Of the figure.
    said : str
        What the paper says of it.
    paper : sequence of str
        Methods that the paper shows beside ours.

    Returns
    -------
    PaperFigure
    """

    def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
        return {"sets": request(options, number, (*methods_shown(paper), "gbn"), COUNTS)}

    def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
        run = data["sets"]
        sources = sources_of(run, (*methods_shown(paper), "gbn"))
        titles = [title_of(one.label) for one in sources]
        wide = (PAGE - 0.1) / len(sources)

        def paint(panel: SubFigure) -> None:
            axes = panel.subplots(1, len(sources), squeeze=False)[0]
            for letter, ax, one, name in zip("abcd", axes, sources, titles, strict=False):
                dots(ax, one.points[0], run.density, wide)
                panels.heading(ax, letter, name)

        letters = ", ".join(f"({letter}) {name}" for letter, name in zip("abcd", titles, strict=False))
        caption = (
            f"Stipplings of one image by {sources[0].n:,} dots of one size, which cover as much as it is "
            f"dark: {letters}. {quality(sources, titles)} {left_out_note(run, paper, options, number)}"
        )
        return Drawing(PAGE, wide * run.density.shape[0] / run.density.shape[1] + 0.25, paint, caption)

    return PaperFigure(number, title, said, needs, draw)
