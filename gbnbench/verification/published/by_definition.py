"""Figures that follow from a definition: random points, lattices, Latin hypercubes, Halton's sequence."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.verification.published_figure import THEORY, PublishedFigure

SQUARE = math.sqrt(math.sqrt(3) / 2)  # the square grid's distance in densest spacings
NEAREST = 0.5 * SQUARE  # mean distance to the nearest of independent points, 1 / (2 sqrt(n))
BOXES = (2**5, 3**3)  # along the axes: one for each of as many points of Halton's sequence


def share_of_strips_with_a_point(x: FloatArray) -> float:
    """Share of n equal strips across an axis that hold a point, on the axis on which it is least."""
    n = len(x)
    return min(len(np.unique(np.floor(along * n))) / n for along in x.T)


def share_of_32_by_27_boxes_with_a_point(x: FloatArray) -> float:
    """Share of 32 by 27 equal boxes in the plane that hold a point."""
    return len(np.unique(np.floor(x * BOXES), axis=0)) / math.prod(BOXES)


BY_DEFINITION = (
    PublishedFigure(
        "random", "noise_floor", "1", 0.9, 1.1, "a tenth: four standard errors of 16 sets",
        "white noise: power is 1 at every frequency", kind=THEORY, sets=16,
    ),
    PublishedFigure(
        "random", "mean_distance", f"{NEAREST:.4f}", NEAREST - 0.01, NEAREST + 0.01,
        "five standard errors of 16 sets", "independent points in the plane: 1 / (2 sqrt(n))",
        kind=THEORY, sets=16,
    ),
    PublishedFigure(
        "grid", "min_distance", f"{SQUARE:.6f}", SQUARE - 1e-6, SQUARE + 1e-6, "rounding of a closed form",
        "the square lattice: 1 / sqrt(n)", kind=THEORY, sets=1,
    ),
    PublishedFigure(
        "hexagonal", "min_distance", "1, strained by at most .02", 0.98, 1 + 1e-9,
        "the strain with which a torus takes n points", "the densest lattice", kind=THEORY, sets=1,
    ),
    PublishedFigure(
        "hexagonal", "valence6", "1", 1 - 1e-9, 1 + 1e-9, "rounding", "the densest lattice",
        kind=THEORY, sets=1,
    ),
    *(
        PublishedFigure(
            name, share_of_strips_with_a_point, "1", 1 - 1e-9, 1 + 1e-9, "rounding",
            "Latin hypercubes by their definition", kind=THEORY,
        )
        for name in ("latin", "latinmaximin", "cmj")
    ),
    PublishedFigure(
        "halton", share_of_32_by_27_boxes_with_a_point, "1", 1 - 1e-9, 1 + 1e-9, "rounding",
        "Halton, 1960: radical inverses in 2 and 3, by their construction", kind=THEORY,
        n=math.prod(BOXES),
    ),
    PublishedFigure(
        "stealthy", "noise_floor", "at most 1e-8", -math.inf, 1e-8, "less is no disagreement",
        "Ahmed, Ren & Wonka, Gaussian blue noise, 2022, Supplement B and Fig. 12",
    ),
)  # fmt: skip
