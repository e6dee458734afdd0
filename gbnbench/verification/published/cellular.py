"""Published figures of sets made by cells: farthest points."""

from __future__ import annotations

import math

from gbnbench.verification.published_figure import PublishedFigure

FPO = "Schlömer, Heck & Deussen, Farthest-point optimized point sets, HPG 2011"

CELLULAR = (
    PublishedFigure(
        "fpo", "min_distance", "at least .925", 0.925, math.inf, "the method stops at this distance", FPO
    ),
    PublishedFigure(
        "fpo", "noise_floor", "7.9e-3", 6.3e-3, 9.9e-3, "a quarter: a few dozen frequencies a set",
        "measured on sets by the authors' method",
    ),
)  # fmt: skip
