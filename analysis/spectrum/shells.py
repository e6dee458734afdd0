"""Groups of a cube's frequencies by radius: exact shells of |f|^2, classes of equal digits, and annuli.

Exact shells and classes of digits are those of Ahmed, Ren & Wonka (2022, App. C); annuli are those of PSA
(Schlömer & Deussen 2011).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

# Relative slack of a band's edges: a nu = |f| n^(-1/d) that is exactly an edge may round to either side.
EDGE = 1e-12


@dataclass(frozen=True)
class Shells:
    """A grouping of the frequencies 0 < |f| <= fmax of a cube by radius.

    Attributes
    ----------
    label : ((2*fmax+1)**d,) int32
        Group of each frequency of the flattened cube; ``size`` for DC and the corners beyond fmax.
    radius : (size,) float64
        Mean |f| of each group, ascending.
    count : (size,) int64
        Frequencies in each group, over the whole space, so always even.
    pairs : {2, 1}
        How many of f and -f stand among the values: both in a cube, one in a list of a half space.
    """

    label: NDArray[np.int32]
    radius: FloatArray
    count: NDArray[np.int64]
    pairs: int = 2

    @property
    def size(self) -> int:
        """Number of groups."""
        return len(self.radius)

    def sum(self, values: FloatArray) -> FloatArray:
        """Sum a cube of values, flat or not, over each group: (size,) float64."""
        total = np.bincount(self.label, weights=values.ravel(), minlength=self.size + 1)
        return (total if self.pairs == 2 else 2 * total)[: self.size].astype(np.float64, copy=False)

    def mean(self, values: FloatArray) -> FloatArray:
        """Average a cube of values over each group: (size,) float64."""
        return self.sum(values) / self.count

    def moments(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the mean over each group, and the sum of squared departures over a half space: two (size,)."""
        mean = self.mean(values)
        away = values.ravel() - np.append(mean, 0.0)[self.label]
        return mean, self.sum(away * away) / 2  # over the whole space each pair counts twice


def squared_radius(fmax: int, d: int) -> NDArray[np.int64]:
    """|f|^2 of every frequency of a cube.

    Parameters
    ----------
    fmax, d : int
        Largest harmonic on each axis, and dimension.

    Returns
    -------
    ((2*fmax+1)**d,) int64
        In the order of the flattened cube.
    """
    squares = np.arange(-fmax, fmax + 1, dtype=np.int64) ** 2
    total = np.zeros((1,) * d, np.int64)
    for axis in range(d):
        total = total + squares.reshape([-1 if a == axis else 1 for a in range(d)])
    return total.ravel()


def _group(key: NDArray[np.int64], r2: NDArray[np.int64], fmax: int) -> Shells:
    """Group frequencies of equal key, numbered in ascending order of mean radius."""
    inside = (r2 > 0) & (r2 <= fmax * fmax)
    _, index, count = np.unique(key[inside], return_inverse=True, return_counts=True)
    radius = np.bincount(index, weights=np.sqrt(r2[inside])) / count
    order = np.argsort(radius, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    label = np.full(len(r2), len(order), np.int32)
    label[inside] = rank[index]
    return Shells(label, radius[order], count[order].astype(np.int64))


@lru_cache(maxsize=4)
def exact_shells(fmax: int, d: int) -> Shells:
    """Group frequencies of the same integer |f|^2 (App. C: do not average over annuli).

    Parameters
    ----------
    fmax, d : int
        Largest harmonic on each axis, and dimension.

    Returns
    -------
    Shells
    """
    r2 = squared_radius(fmax, d)
    shells = _group(r2, r2, fmax)
    # The exact radius, not a mean of equal square roots.
    first = np.unique(r2[(r2 > 0) & (r2 <= fmax * fmax)])
    return Shells(shells.label, np.sqrt(first.astype(np.float64)), shells.count)


def listed_shells(square: NDArray[np.int64]) -> Shells:
    """Group the listed frequencies of one half space by their |f|^2.

    Parameters
    ----------
    square : (m,) int64
        |f|^2 of each, at least 1.

    Returns
    -------
    Shells
    """
    present, label, count = np.unique(square, return_inverse=True, return_counts=True)
    radius = np.sqrt(present.astype(np.float64))
    return Shells(label.astype(np.int32), radius, 2 * count.astype(np.int64), pairs=1)


@lru_cache(maxsize=2)
def digit_classes(fmax: int, d: int) -> Shells:
    """Group frequencies whose sorted |digits| agree, which are finer than shells for d > 2 (App. C).

    Parameters
    ----------
    fmax, d : int
        Largest harmonic on each axis, and dimension.

    Returns
    -------
    Shells
    """
    axis = np.abs(np.arange(-fmax, fmax + 1, dtype=np.int64))
    grid = np.stack(np.meshgrid(*[axis] * d, indexing="ij"), axis=-1).reshape(-1, d)
    grid.sort(axis=1)
    key = grid @ (fmax + 1) ** np.arange(d, dtype=np.int64)
    return _group(key, squared_radius(fmax, d), fmax)


@lru_cache(maxsize=4)
def annuli(fmax: int, d: int, width: float) -> Shells:
    """Group frequencies of equal floor(|f| / width), as PSA averages, whose width is 2.

    Parameters
    ----------
    fmax, d : int
        Largest harmonic on each axis, and dimension.
    width : float
        Width of an annulus, cycles per unit length.

    Returns
    -------
    Shells
    """
    r2 = squared_radius(fmax, d)
    # An edge that |f| meets but for rounding belongs to the annulus above it.
    return _group(np.floor(np.sqrt(r2) / width * (1 + EDGE)).astype(np.int64), r2, fmax)


def in_band(nu: FloatArray, low: float, high: float) -> NDArray[np.bool_]:
    """Tell which frequencies lie in a band, both edges included, to whichever side nu was rounded there.

    Parameters
    ----------
    nu : float64
        Frequencies over the principal one, of any shape.
    low, high : float
        Edges of the band.

    Returns
    -------
    bool
        Of the shape of nu.
    """
    return (nu >= low * (1 - EDGE)) & (nu <= high * (1 + EDGE))
