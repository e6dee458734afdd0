"""What a figure of the paper is here: what it asks for, and how it is drawn from what it is given."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from matplotlib.figure import Figure, SubFigure

from gbnbench.reports import style
from gbnbench.reports.paper.data import DataRequest

Scale = Literal["tiny", "quick", "full"]  # tiny is for tests
COLUMN, PAGE = 3.33, 7.0  # inches: one column of the journal, and both


@dataclass(frozen=True)
class Ask:
    """What the user asked of all figures.

    Attributes
    ----------
    scale : {"tiny", "quick", "full"}
        Counts for tests (seconds a figure), for minutes in all, or the paper's.
    sets : mapping
        Name of a method that has no generator here, in lower case such as ``bnot`` -> its file or folder.
    seed : int
        Of everything.
    """

    scale: Scale
    sets: Mapping[str, str] = field(default_factory=dict)
    seed: int = 0

    def pick(self, tiny: Any, quick: Any, full: Any) -> Any:
        """One of three by scale."""
        return {"tiny": tiny, "quick": quick, "full": full}[self.scale]


@dataclass(frozen=True)
class Drawing:
    """A figure ready to be painted.

    Attributes
    ----------
    width, height : float
        Inches, without the caption; ``COLUMN`` or ``PAGE`` wide.
    paint : callable
        Draws into a SubFigure of that size whose layout is constrained: use ``panel.subplots`` or
        ``panel.add_gridspec`` and leave the placing to matplotlib.
    caption : str
        What is seen, with n, d, sets and settings of everything in it; whole sentences.
    """

    width: float
    height: float
    paint: Callable[[SubFigure], None]
    caption: str


@dataclass(frozen=True)
class PaperFigure:
    """One figure.

    Attributes
    ----------
    name : str
        What the user types: the paper's number, or a word for our own.
    title : str
        A few words.
    paper : str
        What the paper's figure shows and says, in our words; empty for our own.
    needs : callable
        Ask -> what it is drawn from, by names of its own choice.
    draw : callable
        (data by the same names, ask) -> Drawing. Computes nothing: it selects, scales and draws.
    """

    name: str
    title: str
    paper: str
    needs: Callable[[Ask], Mapping[str, DataRequest]]
    draw: Callable[[Mapping[str, Any], Ask], Drawing]


SIGNS = {"sigma": "σ", "nu": "ν", "pi": "π", "epsilon": "ε", "psi6": "ψ6"}


def signs(text: str) -> str:
    """Set the words for Greek letters, and squares, as signs; not those within a generator's settings.

    Examples
    --------
    >>> signs("gbn[sigma=0.5] at sigma = 0.5: epsilon exp(4 pi^2 nu^2)")
    'gbn[sigma=0.5] at σ = 0.5: ε exp(4 π² ν²)'
    """
    words = re.sub(r"(?<![\w\[,-])(sigma|nu|pi|epsilon|psi6)(?![\w=])", lambda m: SIGNS[m[1]], text)
    return words.replace("^2", "²")


def compose(drawing: Drawing, heading: str, foot: str, captions: bool = True) -> Figure:
    """Put a drawing and its caption on one page; call it under ``style.styled``.

    Parameters
    ----------
    drawing : Drawing
        What is painted.
    heading : str
        In bold before the caption, such as ``Figure 3.``
    foot : str
        After the caption: seed, device, version.
    captions : bool
        Without, the drawing alone is painted, for a text that brings its own caption.
    """
    if not captions:
        figure = Figure(figsize=(drawing.width, drawing.height), layout="constrained")
        drawing.paint(figure.subfigures(1, 1, squeeze=False)[0, 0])
        return figure
    text = signs(f"{heading} {drawing.caption} {foot}")
    width = max(24, int((drawing.width - 0.16) / 0.0455))
    lines = textwrap.wrap(style.shown(text, 10_000), width)
    room = 0.1 + 0.122 * len(lines)
    figure = Figure(figsize=(drawing.width, drawing.height + room), layout="constrained")
    top, bottom = figure.subfigures(2, 1, squeeze=False, height_ratios=[drawing.height, room])[:, 0]
    drawing.paint(top)
    bottom.text(
        0.08 / drawing.width, 1.0, "\n".join(lines), size=6.3, color=style.INK, va="top", linespacing=1.22
    )
    return figure
