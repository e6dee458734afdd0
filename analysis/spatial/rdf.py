"""Radial distribution function on the torus, in PSA's bins (Schlömer & Deussen 2011)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.sides import Sides, as_sides, shortest_side
from gbnbench.core.torus import FloatArray, as_realizations, densest_spacing

if TYPE_CHECKING:
    import pandas as pd

RANGE = 8.0  # densest spacings
MOST_DIMENSIONS = 8  # beyond, half a side is less than the densest spacing of thousands of points
BINS_PER_POINT = 0.125
# Pairs worked on at once: a few arrays of this many doubles stay in a core's cache.
BLOCK = 1 << 16
# A distance that falls short of an edge by this part of a bin lies on it, but for the coordinates' rounding:
# every distance of a grid of 100 x 100 points is an edge of PSA's bins, and few are rounded upwards.
ON_EDGE = 1e-9
# Windows are wider than the longest distance by this much, so that rounding loses no pair.
SLACK = 1e-12


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
    """

    r: FloatArray
    g: FloatArray
    g_by_set: FloatArray

    def to_frame(self) -> pd.DataFrame:
        """Columns r, g."""
        import pandas as pd

        return pd.DataFrame({"r": self.r, "g": self.g})


def rdf(x: ArrayLike, sides: ArrayLike | None = None) -> RadialDistribution:
    """Radial distribution function of each set and their mean.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, d <= 8.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    RadialDistribution
        int(0.125 n) bins over 0..8 densest spacings, without those that end beyond half the shortest side,
        whose shells do not fit the torus.

    Raises
    ------
    InputError
        If sides are not d lengths.
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
    planned = int(BINS_PER_POINT * n)
    width = RANGE * unit / max(planned, 1)
    bins = min(planned, math.floor(0.5 * shortest_side(lengths) / width))
    if bins < 1:
        raise RefusalError(
            f"rdf has int({BINS_PER_POINT} n) bins, none of which fits the torus at n={n}, d={d}"
        )
    g = pair_density(sets, bins, width, lengths)
    mean: FloatArray = g.mean(axis=0)
    return RadialDistribution(np.arange(bins, dtype=np.float64) * (width / unit), mean, g)


def pair_density(sets: FloatArray, bins: int, width: float, sides: Sides | None = None) -> FloatArray:
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
    return np.asarray(np.array([pair_counts(points, bins, width, sides) for points in sets]) / expected)


def pair_counts(x: FloatArray, bins: int, width: float, sides: Sides | None = None) -> NDArray[np.int64]:
    """Unordered pairs of one set by toroidal distance.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    bins : int
        Equal bins from 0 on, closed on the left, distances that fall short of an edge by 1e-9 of a bin
        included; farther pairs are not counted.
    width : float
        Width of a bin, > 0; bins * width is half the shortest side at most.
    sides : tuple of d floats, optional
        Sides of volume 1, as ``as_sides`` returns them; a cube if not given.

    Returns
    -------
    (bins,) int64
        Exact counts.

    Raises
    ------
    InputError
        If the bins reach beyond half the shortest side.

    Notes
    -----
    Points are cut in strips at least as wide as the longest distance and sorted along another axis, so that
    only pairs within a window are examined. Memory does not grow with their number.
    """
    reach = bins * width
    box = (1.0,) * x.shape[1] if sides is None else sides
    if not 0 < reach <= 0.5 * min(box) * (1 + 1e-12):
        raise InputError(
            f"bins must end within (0, {0.5 * min(box):.6g}], where a ball fits the torus; got {reach!r}"
        )
    per_length = 1 / width
    if math.isclose(per_length, round(per_length), rel_tol=1e-12):
        per_length = round(per_length)  # so that a distance which is exactly an edge begins its bin
    counts = np.zeros(bins + 1, dtype=np.int64)
    for rows, columns, drop in _windows(x, reach / box[0], reach / box[-1]):
        squared = np.zeros((len(rows), len(columns)))
        for axis, side in enumerate(box):
            step = rows[:, axis, None] - columns[None, :, axis]
            step -= np.rint(step)
            if sides is not None:
                step *= side
            step *= step
            squared += step
        if drop is not None:
            squared[drop] = np.inf
        np.sqrt(squared, out=squared)
        squared *= per_length
        squared += ON_EDGE
        np.minimum(squared, bins, out=squared)
        counts += np.bincount(squared.astype(np.intp).ravel(), minlength=bins + 1)
    return counts[:bins]


def _windows(
    x: FloatArray, across: float, reach: float
) -> Iterator[tuple[FloatArray, FloatArray, NDArray[np.bool_] | None]]:
    """Blocks of rows against columns that together hold every near pair once; a mask marks repeats.

    The longest distance is a share ``across`` of the first side and ``reach`` of the last.
    """
    x = x[np.argsort(x[:, -1], kind="stable")]
    strips = int(1 / (across + SLACK)) if x.shape[1] > 1 else 1
    if strips < 3:  # a strip must not meet its neighbour on both sides
        strips = 1
    label = np.minimum((x[:, 0] * strips).astype(np.intp), strips - 1)
    cells = [x[label == strip] for strip in range(strips)]
    for strip, cell in enumerate(cells):
        yield from _within(cell, reach)
        if strips > 1:
            yield from _between(cell, cells[(strip + 1) % strips], reach)


def _row_blocks(height: FloatArray, window: float) -> Iterator[tuple[int, int]]:
    """Ranges of rows such that a block against its window of columns holds about BLOCK pairs."""
    rows = max(1, BLOCK // max(int(len(height) * window), 32))
    for start in range(0, len(height), rows):
        yield start, min(start + rows, len(height))


def _within(
    cell: FloatArray, reach: float
) -> Iterator[tuple[FloatArray, FloatArray, NDArray[np.bool_] | None]]:
    """Pairs of one strip: each point with those after it, around the torus."""
    around = np.concatenate([cell, cell])
    height = np.concatenate([cell[:, -1], cell[:, -1] + 1])
    for start, stop in _row_blocks(cell[:, -1], reach):
        end = int(np.searchsorted(height, height[stop - 1] + reach + SLACK, side="right"))
        drop = np.arange(start + 1, end)[None, :] <= np.arange(start, stop)[:, None]
        if height[end - 1] - height[start] >= 0.5:  # the way back is shorter, and counted there
            drop |= height[None, start + 1 : end] - height[start:stop, None] >= 0.5
        yield cell[start:stop], around[start + 1 : end], drop


def _between(
    cell: FloatArray, other: FloatArray, reach: float
) -> Iterator[tuple[FloatArray, FloatArray, NDArray[np.bool_] | None]]:
    """Pairs of a point in one strip and a point in the next."""
    around = np.concatenate([other, other, other])
    height = np.concatenate([other[:, -1] - 1, other[:, -1], other[:, -1] + 1])
    for start, stop in _row_blocks(cell[:, -1], 2 * reach):
        low = int(np.searchsorted(height, cell[start, -1] - reach - SLACK, side="left"))
        high = int(np.searchsorted(height, cell[stop - 1, -1] + reach + SLACK, side="right"))
        yield cell[start:stop], other if high - low > len(other) else around[low:high], None
