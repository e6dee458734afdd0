"""Which frequencies of a cube share a radius: exact shells of |f|^2, classes of digits, rings and annuli."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray


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
    """

    label: NDArray[np.int32]
    radius: FloatArray
    count: NDArray[np.int64]

    @property
    def size(self) -> int:
        """Number of groups."""
        return len(self.radius)

    def sum(self, values: FloatArray) -> FloatArray:
        """Sum over each group of a cube of values (or a flat one): (size,) float64."""
        total = np.bincount(self.label, weights=values.ravel(), minlength=self.size + 1)
        return total[: self.size].astype(np.float64, copy=False)

    def mean(self, values: FloatArray) -> FloatArray:
        """Mean over each group: (size,) float64."""
        return self.sum(values) / self.count

    def moments(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Mean over each group, and sum of squared departures from it over one half space: two (size,)."""
        mean = self.mean(values)
        away = values.ravel() - np.append(mean, 0.0)[self.label]
        return mean, self.sum(away * away) / 2  # each pair f, -f stands twice in the cube


def squared_radius(fmax: int, d: int) -> NDArray[np.int64]:
    """|f|^2 of every frequency of the cube, flattened: ((2*fmax+1)**d,) int64."""
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
    """Frequencies of the same integer |f|^2 (the paper's App. C: do not average over annuli)."""
    r2 = squared_radius(fmax, d)
    shells = _group(r2, r2, fmax)
    # The exact radius, not a mean of equal square roots.
    first = np.unique(r2[(r2 > 0) & (r2 <= fmax * fmax)])
    return Shells(shells.label, np.sqrt(first.astype(np.float64)), shells.count)


@lru_cache(maxsize=2)
def digit_classes(fmax: int, d: int) -> Shells:
    """Frequencies whose sorted |digits| agree: the finer classes of the paper's App. C for d > 2."""
    axis = np.abs(np.arange(-fmax, fmax + 1, dtype=np.int64))
    grid = np.stack(np.meshgrid(*[axis] * d, indexing="ij"), axis=-1).reshape(-1, d)
    grid.sort(axis=1)
    key = grid @ (fmax + 1) ** np.arange(d, dtype=np.int64)
    return _group(key, squared_radius(fmax, d), fmax)


@lru_cache(maxsize=4)
def annuli(fmax: int, d: int, width: float) -> Shells:
    """Frequencies with floor(|f| / width) equal, as PSA averages (its width is 2)."""
    r2 = squared_radius(fmax, d)
    return _group(np.floor(np.sqrt(r2) / width).astype(np.int64), r2, fmax)


EDGE = (
    1e-12  # relative slack of a band's edges: |f| n^(-1/d) that is exactly an edge may round to either side
)


def in_band(nu: FloatArray, low: float, high: float) -> NDArray[np.bool_]:
    """Whether low <= nu <= high, both edges included whatever nu rounded to."""
    return (nu >= low * (1 - EDGE)) & (nu <= high * (1 + EDGE))
