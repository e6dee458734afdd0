"""Periodised Gaussians of points at points of the same set, as far as they reach."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

REACH = 7.5  # widths, beyond which a Gaussian is below 7e-13 and counts as nothing
MOST_PAIRS = 30_000_000  # that are kept, in 16 bytes each; of more, each Gaussian is computed when asked for


class LocalGaussians:
    """Gaussians of one width on the points of a set, each given where it is not nothing.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    width : float
        Standard deviation, in sides of the unit cube.

    Attributes
    ----------
    own : float
        Value of a Gaussian at its own point: 1 but for its images.
    """

    def __init__(self, x: FloatArray, width: float) -> None:
        from scipy.spatial import cKDTree

        n, d = x.shape
        self.x, self.width, self.rows, reach = x, width, None, REACH * width
        self.own = float(_gaussian(np.zeros((1, d)), width)[0])
        ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1) * reach**d
        if reach >= 0.5 or ball * n * n > MOST_PAIRS:
            return
        a, b = cKDTree(x, boxsize=np.ones(d)).query_pairs(reach, output_type="ndarray").T
        point = np.concatenate([a, b, np.arange(n)])
        order = np.argsort(point, kind="stable")
        self.rows = np.concatenate([[0], np.cumsum(np.bincount(point, minlength=n))])
        self.near = np.concatenate([b, a, np.arange(n)])[order]
        self.value = _gaussian(x[point[order]] - x[self.near], width)

    def of(self, point: int) -> tuple[NDArray[np.intp] | slice, FloatArray]:
        """Return the points that the Gaussian of one reaches, itself among them, and its values there.

        Parameters
        ----------
        point : int
            Index of the point.

        Returns
        -------
        points : (m,) intp or slice
            Indices; a slice of all points where it reaches all.
        values : (m,) float64
            Periodised.
        """
        if self.rows is None:
            return slice(None), _gaussian(self.x - self.x[point], self.width)
        row = slice(self.rows[point], self.rows[point + 1])
        return self.near[row], self.value[row]

    def sums(self, points: NDArray[np.intp]) -> FloatArray:
        """Add up the Gaussians of some points at every point: (n,) float64."""
        total = np.zeros(len(self.x))
        for point in points:
            near, value = self.of(point)
            total[near] += value
        return total


def _gaussian(apart: FloatArray, width: float) -> FloatArray:
    """Periodised Gaussian at vectors, (m, d)."""
    apart = apart - np.round(apart)
    most = max(math.ceil(6 * width - 0.5), 0)
    if most == 0:
        return np.asarray(np.exp(np.sum(apart**2, axis=1) / (-2 * width**2)))
    images = [np.exp((apart + turn) ** 2 / (-2 * width**2)) for turn in range(-most, most + 1)]
    return np.asarray(np.prod(np.sum(images, axis=0), axis=1))
