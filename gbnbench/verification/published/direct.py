"""Published figures of points placed directly: dart throwing and maximal Poisson-disk sets."""

from __future__ import annotations

import math

from gbnbench.analysis.spatial.distances import nearest_distances
from gbnbench.core.torus import FloatArray
from gbnbench.verification.published_figure import SETS, PublishedFigure

DARTS = "measured on a set by dart throwing, of 1,024 points"
SATURATION = "Torquato, Uche & Stillinger, Random sequential addition of hard spheres, 2006"


def covered_share(x: FloatArray) -> float:
    """Share of the torus in 2D that discs around the points cover, of half the least distance as radius."""
    least = float(nearest_distances(x).min())  # in densest spacings, where they cover pi / sqrt(12)
    return math.pi / math.sqrt(12) * least**2


DIRECT = (
    PublishedFigure(
        "darts", "min_distance", ".750", 0.75, 0.752, "a setting; the nearest pair comes close",
        DARTS, kind=SETS,
    ),
    PublishedFigure(
        "darts", "noise_floor", "6.7e-2", 5.4e-2, 8.0e-2, "a fifth: two hundred frequencies of a set",
        DARTS, kind=SETS,
    ),
    PublishedFigure(
        "darts", "peak", "1.79", 1.6, 2.0, "a tenth: the largest of many rings of a hundred frequencies",
        DARTS, kind=SETS,
    ),
    PublishedFigure(
        "maximalpoisson", covered_share, ".547", 0.535, 0.552,
        "two per cent: the radius gives way for n, and counts at saturation spread by .7 %", SATURATION,
    ),
)  # fmt: skip
