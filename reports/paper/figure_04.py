"""Figure 4: what truncating the kernel in space does to its transform."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure
from matplotlib.ticker import LogLocator, NullLocator

from gbnbench.core.number_text import number
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.kernel_profile import truncated_transform
from gbnbench.reports import style
from gbnbench.reports.paper import panels
from gbnbench.reports.paper.data import DataRequest, TableRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure

CUTOFFS = {"whole": math.inf, "2": 2.0, "1": 1.0}  # sigmas
LABELS = {"whole": "whole", "2": r"cut at $2\sigma$", "1": r"cut at $1\sigma$"}
WHOLE = style.Stroke(style.COLOURS[0], "-")
STROKES = {
    "whole": WHOLE,
    "2": style.Stroke(style.COLOURS[4], style.DASHES[1]),
    "1": style.Stroke(style.COLOURS[1], style.DASHES[3]),
}
REACH, NU = 4.0, 2.0  # sigmas; cycles a sigma
BOTTOM = 1e-9


def transforms(cutoff: str, count: int) -> dict[str, FloatArray]:
    """Compute a Gaussian kernel of width 1 on the line, cut off at some distance, with its Fourier transform.

    Parameters
    ----------
    cutoff : str
        Key of ``CUTOFFS``.
    count : int
        Number of samples.

    Returns
    -------
    dict
        Arrays (count,): ``x`` and ``kernel``, ``nu`` and ``transform``, this over the uncut kernel's
        transform at 0.
    """
    t = CUTOFFS[cutoff]
    x = np.linspace(-REACH, REACH, count)
    nu = np.linspace(0, NU, count)
    return {
        "x": x,
        "kernel": np.where(np.abs(x) <= t, np.exp(-(x**2) / 2), 0.0),
        "nu": nu,
        "transform": truncated_transform(nu, 1.0, t) / math.sqrt(2 * math.pi),
    }


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for three kernels and their transforms."""
    count = options.pick(401, 2001, 2001)
    return {"kernels": TableRequest(transforms, {key: (key, count) for key in CUTOFFS})}


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:  # noqa: ARG001 - as every figure's
    """Draw the kernels, their transforms, and the absolute values of these in log scale.

    Parameters
    ----------
    data : mapping
        Data under the names that ``needs`` gives them.
    options : FigureOptions
        Scale, sets of the user and seed.

    Returns
    -------
    Drawing
        The figure, as wide as the page, with its caption.
    """
    kernels: dict[str, dict[str, FloatArray]] = data["kernels"]

    def paint(panel: SubFigure) -> None:
        axes = panel.subplots(1, 3)
        for key, found in kernels.items():
            look = {"color": STROKES[key].colour, "linestyle": STROKES[key].dash}
            axes[0].plot(found["x"], found["kernel"], label=LABELS[key], **look)
            axes[1].plot(found["nu"], found["transform"], **look)
            axes[2].plot(found["nu"], np.abs(found["transform"]), **look)
        for ax, letter, title in zip(
            axes, "abc", ("kernel", "its transform", "its transform, logarithmic"), strict=True
        ):
            panels.heading(ax, letter, title)
            ax.set_xlabel(r"$x/\sigma$" if letter == "a" else r"frequency, cycles per $\sigma$")
        axes[0].set_ylim(0, 1.4)
        axes[0].set_yticks([0, 0.5, 1])
        axes[1].set_yticks([0, 0.5, 1])
        axes[0].legend(fontsize=6.5, loc="upper left", handlelength=2.6, borderaxespad=0, labelspacing=0.3)
        axes[1].axhline(0, color=style.RULE, linewidth=0.8, zorder=0)
        _logarithmic(axes[2])

    most = {key: float(np.abs(found["transform"][found["nu"] >= 1]).max()) for key, found in kernels.items()}
    caption = (
        "A Gaussian of width sigma (solid), the same cut off at 2 sigma (dashed) and at 1 sigma "
        "(dash-dotted): (a) on the line; (b) their Fourier transforms in one dimension, over the whole "
        "Gaussian's at 0; (c) absolute values of these. The closer the cut, the more of the high "
        "frequencies leaks in: from one cycle a sigma on, the nominal spacing's frequency where sigma is "
        f"one spacing, the whole kernel weighs {number(most['whole'])} at most, that cut at 2 sigma "
        f"{number(most['2'])} and that at 1 sigma {number(most['1'])}. Closed forms: no points, nothing "
        "random."
    )
    return Drawing(PAGE, 1.75, paint, caption)


def _logarithmic(ax: Axes) -> None:
    ax.set_yscale("log")
    ax.set_ylim(BOTTOM, 2)
    ax.yaxis.set_major_locator(LogLocator(numticks=6))
    ax.yaxis.set_minor_locator(NullLocator())


FIGURE = PaperFigure(
    "4",
    "Transforms of truncated kernels",
    "A Gaussian and the same truncated to one and to two sigmas, with their Fourier transforms in linear "
    "and in logarithmic scale. The shorter the support, the more high frequencies leak in; this makes "
    "algorithms of local neighbourhoods settle at patches of regular structure.",
    needs,
    draw,
)
