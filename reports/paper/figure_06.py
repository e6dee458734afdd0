"""Figure 6: the energy's kernel folded over the torus, by the number of points an axis."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import SubFigure

from gbnbench.core.number_text import number
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.kernel_profile import energy_profile
from gbnbench.reports.paper.data import DataRequest, TableRequest
from gbnbench.reports.paper.figure import COLUMN, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.radial_axes import family

POINTS = (1, 2, 4, 8, 16, 32, 64)  # an axis
SIGMA = 1.0


def profile(points: int, count: int) -> dict[str, FloatArray]:
    """Compute the energy of two points against their distance along an axis.

    Parameters
    ----------
    points : int
        Points along an axis of the box.
    count : int
        Number of samples.

    Returns
    -------
    dict
        Arrays (count,): ``u``, the distance in box sides, and ``energy`` over its value at 0.
    """
    u = np.linspace(-0.5, 0.5, count)
    return {"u": u, "energy": energy_profile(u * points, float(points), SIGMA)}


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for one profile for each number of points."""
    count = options.pick(201, 2001, 2001)
    return {"profiles": TableRequest(profile, {str(points): (points, count) for points in POINTS})}


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:  # noqa: ARG001 - as every figure's
    """Draw all energy profiles in one plot.

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
    profiles: dict[str, dict[str, FloatArray]] = data["profiles"]
    colours = family(len(profiles))[::-1]

    def paint(panel: SubFigure) -> None:
        ax = panel.subplots()
        for (points, found), colour in zip(profiles.items(), colours, strict=True):
            ax.plot(found["u"], found["energy"], color=colour, linewidth=1.2, label=points)
        ax.set_xlim(-0.5, 0.5)
        ax.set_ylim(-0.015, 1.04)
        ax.set_xlabel("distance along an axis, box sides")
        ax.set_ylabel("energy over its largest")
        ax.legend(
            title="points\nan axis", title_fontsize=6.5, fontsize=6.5, loc="center left",
            bbox_to_anchor=(1.0, 0.5), handlelength=1.6, labelspacing=0.35, alignment="left",
        )  # fmt: skip

    drop = {points: 1 - float(found["energy"][0]) for points, found in profiles.items()}
    caption = (
        "Profile of the energy between two points on the torus, a Gaussian of sigma = 1 spacing summed "
        "over all its periodic images, against their distance along one axis; the kernel in d dimensions "
        "is a product of d of these. The box has as many spacings a side as points an axis. With 64 it is "
        f"a Gaussian; with 4, a raised cosine whose least value is {drop['4']:.2f} below its largest; with "
        f"2 it drops by {number(drop['2'])} and with 1 by {number(drop['1'])}, which no eye sees. "
        "High-dimensional sets are made on such flat profiles. Closed forms, no points and nothing random."
    )
    return Drawing(COLUMN, 2.2, paint, caption)


FIGURE = PaperFigure(
    "6",
    "Energy profiles",
    "Profiles of the energy kernel along one axis for several nominal numbers of points an axis; in d "
    "dimensions they are multiplied. Few points an axis give an almost flat kernel, more a raised cosine and "
    "at last a Gaussian.",
    needs,
    draw,
)
