"""The flattest square of a density: where a set is looked at as if its density were constant."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gbnbench.core.torus import FloatArray

LEAST_SIDE = 8  # pixels
LEAST_POINTS, MOST_POINTS = 64, 400  # that are enough, a twenty-fifth of all in between
SHARE = 25
GROWTH = 1.15  # of the sides that are tried
EQUAL = 0.01  # variations that are taken for one another: the largest square wins


@dataclass(frozen=True)
class FlatPatch:
    """A square of pixels.

    Attributes
    ----------
    row, column : int
        Its first pixel.
    side : int
        Pixels along each side.
    variation : float
        Standard deviation of the density within it over its mean.
    share : float
        Part of all points that the density expects in it.
    """

    row: int
    column: int
    side: int
    variation: float
    share: float

    def of(self, density: FloatArray) -> FloatArray:
        """Cut the patch out of an array of pixels."""
        return density[self.row : self.row + self.side, self.column : self.column + self.side]

    def points(self, points: FloatArray) -> FloatArray:
        """Take the points within it, their positions from its corner."""
        moved = points - [self.row, self.column]
        inside: FloatArray = moved[((moved >= 0) & (moved < self.side)).all(axis=1)]
        return inside


def flattest_patch(density: FloatArray, n: int) -> FlatPatch | None:
    """Find the square that varies least among those that hold enough points.

    Parameters
    ----------
    density : (rows, columns) float64
        At least 0; its scale is free.
    n : int
        Points in all. Enough is a twenty-fifth of them, but from 64 to 400.

    Returns
    -------
    FlatPatch or None
        None where no square expects enough points.
    """
    least = min(max(n / SHARE, LEAST_POINTS), MOST_POINTS) / n
    total = float(density.sum())
    sums = [np.pad(part.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0))) for part in (density, density**2)]
    found: list[FlatPatch] = []
    for side in _sides(min(density.shape)):
        mass, squares = (
            t[side:, side:] - t[:-side, side:] - t[side:, :-side] + t[:-side, :-side] for t in sums
        )
        enough = mass >= least * total * (1 - 1e-9)
        if not enough.any():
            continue
        mean = mass / side**2
        spread = np.sqrt(np.maximum(squares / side**2 - mean**2, 0))
        variation = np.where(enough, spread / np.maximum(mean, 1e-300), np.inf)
        row, column = np.unravel_index(int(variation.argmin()), variation.shape)
        share = float(mass[row, column]) / total
        found.append(FlatPatch(int(row), int(column), side, float(variation[row, column]), share))
    if not found:
        return None
    flattest = min(patch.variation for patch in found)
    return max((p for p in found if p.variation <= flattest + EQUAL), key=lambda p: p.side)


def _sides(largest: int) -> list[int]:
    steps = math.ceil(math.log(max(largest / LEAST_SIDE, 1)) / math.log(GROWTH))
    return sorted({min(int(LEAST_SIDE * GROWTH**k), largest) for k in range(steps + 1)})
