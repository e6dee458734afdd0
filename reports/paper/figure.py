"""Definition of a figure of the paper: the data it needs, the function that draws it, and its page."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from matplotlib.figure import Figure, SubFigure

from gbnbench.io.points import ReadingOptions
from gbnbench.reports import style
from gbnbench.reports.captions import shown
from gbnbench.reports.paper.data import DataRequest

Scale = Literal["tiny", "quick", "full"]  # tiny is for tests
COLUMN, PAGE = 3.33, 7.0  # inches: one column of the journal, and both


@dataclass(frozen=True)
class FigureOptions:
    """Settings of the user for all figures.

    Attributes
    ----------
    scale : {"tiny", "quick", "full"}
        Size of the data: for tests (seconds for a figure), for minutes in all, or the paper's.
    sets : mapping
        Name in lower case of a method of others, such as ``bnot`` -> file or folder of its
        sets.
    seed : int
        Seed of all data.
    reading : ReadingOptions
        How the files of sets are read.
    images : mapping
        Number of a figure of adaptive sampling -> image that it shows, a file or a name, in place of ours.
    """

    scale: Scale
    sets: Mapping[str, str] = field(default_factory=dict)
    seed: int = 0
    reading: ReadingOptions = field(default_factory=ReadingOptions)
    images: Mapping[str, str] = field(default_factory=dict)

    def pick(self, tiny: Any, quick: Any, full: Any) -> Any:
        """Return the value for this scale.

        Parameters
        ----------
        tiny, quick, full : any
            Values for the three scales.

        Returns
        -------
        any
            The one of them that belongs to ``scale``.
        """
        return {"tiny": tiny, "quick": quick, "full": full}[self.scale]


@dataclass(frozen=True)
class Drawing:
    """A figure ready to be painted.

    Attributes
    ----------
    width, height : float
        Size in inches without the caption; the width is ``COLUMN`` or ``PAGE``.
    paint : callable
        Draws into a SubFigure of that size with constrained layout. It uses ``panel.subplots`` or
        ``panel.add_gridspec`` and leaves the placing to matplotlib.
    caption : str
        Whole sentences that explain the figure, with n, d, number of sets and settings of all that it shows.
    """

    width: float
    height: float
    paint: Callable[[SubFigure], None]
    caption: str


@dataclass(frozen=True)
class PaperFigure:
    """A figure of the paper, or one of this package beside them.

    Attributes
    ----------
    name : str
        Name that the user types: the paper's number, or a word for a figure of this package.
    title : str
        Title in a few words.
    paper : str
        Summary of the paper's figure and of what the paper says of it; empty for a figure of this package.
    needs : callable
        FigureOptions -> requests for the data, under names that the figure chooses.
    draw : callable
        (data under the same names, FigureOptions) -> Drawing. It selects, scales and draws; it computes
        nothing.
    """

    name: str
    title: str
    paper: str
    needs: Callable[[FigureOptions], Mapping[str, DataRequest]]
    draw: Callable[[Mapping[str, Any], FigureOptions], Drawing]


SIGNS = {"sigma": "σ", "nu": "ν", "pi": "π", "epsilon": "ε", "psi6": "ψ6"}


def signs(text: str) -> str:
    """Write names of Greek letters and squares in a caption as signs, except within a generator's settings.

    Examples
    --------
    >>> signs("gbn[sigma=0.5] at sigma = 0.5: epsilon exp(4 pi^2 nu^2)")
    'gbn[sigma=0.5] at σ = 0.5: ε exp(4 π² ν²)'
    """
    words = re.sub(r"(?<![\w\[,-])(sigma|nu|pi|epsilon|psi6)(?![\w=])", lambda m: SIGNS[m[1]], text)
    return words.replace("^2", "²")


def compose(drawing: Drawing, heading: str, foot: str, captions: bool = True) -> Figure:
    """Put a drawing and its caption on one page, to be called under ``style.styled``.

    Parameters
    ----------
    drawing : Drawing
        Drawing to paint.
    heading : str
        Text in front of the caption, such as ``Figure 3.``
    foot : str
        Text after the caption: seed, device, version.
    captions : bool
        Whether the caption stands in the picture.

    Returns
    -------
    Figure
        The page.
    """
    if not captions:
        figure = Figure(figsize=(drawing.width, drawing.height), layout="constrained")
        drawing.paint(figure.subfigures(1, 1, squeeze=False)[0, 0])
        return figure
    text = signs(f"{heading} {drawing.caption} {foot}")
    width = max(24, int((drawing.width - 0.16) / 0.0455))
    lines = textwrap.wrap(shown(text, 10_000), width)
    room = 0.1 + 0.122 * len(lines)
    figure = Figure(figsize=(drawing.width, drawing.height + room), layout="constrained")
    top, bottom = figure.subfigures(2, 1, squeeze=False, height_ratios=[drawing.height, room])[:, 0]
    drawing.paint(top)
    bottom.text(
        0.08 / drawing.width, 1.0, "\n".join(lines), size=6.3, color=style.INK, va="top", linespacing=1.22
    )
    return figure
