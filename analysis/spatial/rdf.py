"""Radial distribution function on the torus, in PSA's bins (Schlömer & Deussen 2011)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.spatial.pair_counts import pair_counts
from gbnbench.analysis.spatial.slabs import Progress
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.sides import Sides, as_sides, shortest_side
from gbnbench.core.torus import FloatArray, as_realizations, densest_spacing

if TYPE_CHECKING:
    import pandas as pd

RANGE = 8.0  # densest spacings
MOST_DIMENSIONS = 8  # beyond, half a side is less than the densest spacing of thousands of points
BINS_PER_POINT = 0.125
MOST_BINS = 10_000_000
CURVE_BINS = 80  # of a curve that is looked at, a tenth of a spacing each


@dataclass(frozen=True)
class RadialDistribution:
    """Density of points around a point over the mean density.

    Attributes
    ----------
    r : (bins,) float64
        Left edge of each bin, in densest spacings.
    g : (bins,) float64
        Mean over realizations; 1 in expectation for uniform random points.
    g_by_set : (realizations, bins) float64
        The same for each set.
    width : float
        Width of a bin, in densest spacings.
    """

    r: FloatArray
    g: FloatArray
    g_by_set: FloatArray
    width: float

    def to_frame(self) -> pd.DataFrame:
        """Columns r, g."""
        import pandas as pd

        return pd.DataFrame({"r": self.r, "g": self.g})


def rdf(
    x: ArrayLike,
    sides: ArrayLike | None = None,
    *,
    reach: float = RANGE,
    bins: int | None = None,
    progress: Progress | None = None,
) -> RadialDistribution:
    """Radial distribution function of each set and their mean.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, d <= 8.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.
    reach : float
        Longest distance, in densest spacings; no pair beyond it is looked at.
    bins : int, optional
        Bins of equal width up to there; by default PSA's, int(0.125 n) over 8 densest spacings.
    progress : callable, optional
        Called with the share done now and then, of large sets.

    Returns
    -------
    RadialDistribution
        Without the bins that end beyond half the shortest side, whose shells do not fit the torus.

    Raises
    ------
    InputError
        If sides are not d lengths, or reach or bins is not positive.
    RefusalError
        If d > 8, where half a side holds not even a spacing, or n is too small for one bin.

    Notes
    -----
    g_i = count_i / [n (n - 1)/2 V_d dx^d ((i + 1)^d - i^d)] over unordered pairs, V_d the volume of the unit
    ball; in 2D the shell is PSA's pi dx^2 (2 i + 1). Pairs are counted exactly, near ones only.
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    lengths = as_sides(sides, d)
    if d > MOST_DIMENSIONS:
        raise RefusalError(f"rdf is of d <= {MOST_DIMENSIONS}, where half a side holds a spacing; got d={d}")
    unit = densest_spacing(n, d)
    if not 0 < reach < math.inf:
        raise InputError(f"reach must be a positive number of densest spacings; got {reach!r}")
    if bins is None:
        planned = int(BINS_PER_POINT * n * (reach / RANGE))
    elif isinstance(bins, bool) or not isinstance(bins, (int, np.integer)) or not 1 <= bins <= MOST_BINS:
        raise InputError(f"bins must be a whole number from 1 to {MOST_BINS:,}; got {bins!r}")
    else:
        planned = int(bins)
    width = reach * unit / max(planned, 1)
    count = min(planned, math.floor(0.5 * shortest_side(lengths) / width))
    if count < 1:
        raise RefusalError(_no_bin(n, d, bins))
    g = pair_density(sets, count, width, lengths, progress)
    mean: FloatArray = g.mean(axis=0)
    return RadialDistribution(np.arange(count, dtype=np.float64) * (width / unit), mean, g, width / unit)


def curve_bins(n: int) -> int | None:
    """Choose bins that show the peaks of few points too, of which PSA's are a spacing wide at n = 64.

    Returns
    -------
    int or None
        As ``rdf`` takes it; None for PSA's, which are as narrow from n = 640 on, or of n < 8 refused.
    """
    return CURVE_BINS if 1 <= int(BINS_PER_POINT * n) < CURVE_BINS else None


def _no_bin(n: int, d: int, bins: int | None) -> str:
    what = f"int({BINS_PER_POINT} n) bins" if bins is None else f"bins={bins}"
    return f"rdf has {what}, none of which fits the torus at n={n}, d={d}"


def pair_density(
    sets: FloatArray,
    bins: int,
    width: float,
    sides: Sides | None = None,
    progress: Progress | None = None,
) -> FloatArray:
    """Radial distribution function in bins of equal width from 0 on.

    Parameters
    ----------
    sets : (realizations, n, d) float64
        Points on the unit torus, n >= 2.
    bins : int
        Number of bins; they end at half the shortest side at most.
    width : float
        Width of a bin; the box has volume 1.
    sides : tuple of d floats, optional
        Sides of volume 1, as ``as_sides`` returns them; a cube if not given.
    progress : callable, optional
        As in ``rdf``.

    Returns
    -------
    (realizations, bins) float64
        g of each set: pairs counted over pairs expected of uniform points; see ``rdf``.

    Raises
    ------
    RefusalError
        If n = 1.
    """
    n, d = sets.shape[1:]
    if n < 2:
        raise RefusalError("pairs need n >= 2; got n=1")
    index = np.arange(bins, dtype=np.float64)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1) * width**d
    shells = sum(math.comb(d, k) * index**k for k in range(d))  # (index + 1)^d - index^d
    expected = n * (n - 1) / 2 * ball * shells
    counts = np.array([pair_counts(points, bins, width, sides, progress) for points in sets])
    return np.asarray(counts / expected)
