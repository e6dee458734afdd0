"""Voronoi cells of points over a density: masses, centroids and main axes, summed over parts of pixels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density

PARTS_OF_A_CELL = 48  # parts of pixels that a cell has, at least


class CellParts:
    """A density whose pixels are cut into parts where n points are as dense as they are.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.

    Attributes
    ----------
    places : (m, d) float64
        Centres of the parts that have ink, in pixels.
    masses : (m,) float64
        Their shares of n points.
    """

    def __init__(self, density: Density, n: int) -> None:
        d = density.d
        pixels = np.argwhere(density.values > 0)
        ink = density.of_points(n)[tuple(pixels.T)]
        parts = parts_of_pixels(ink, d)
        places, masses = [], []
        for count in np.unique(parts).tolist():
            here = parts == count
            within_pixel = (np.argwhere(np.ones((count,) * d)) + 0.5) / count
            places.append((pixels[here][:, None] + within_pixel).reshape(-1, d))
            masses.append(np.repeat(ink[here] / count**d, count**d))
        self.places, self.masses = np.concatenate(places), np.concatenate(masses)
        self._torus = np.array(density.shape, np.float64) if density.toroidal else None

    def cells(self, x: FloatArray) -> WeightedCells:
        """Give each part to its nearest point.

        Parameters
        ----------
        x : (n, d) float64
            Points within the density, in pixels.

        Returns
        -------
        WeightedCells
        """
        torus = self._torus
        nearest = np.asarray(cKDTree(x, boxsize=torus).query(self.places, workers=-1)[1], np.intp)
        apart = self.places - x[nearest]
        if torus is not None:
            apart -= torus * np.rint(apart / torus)
        return WeightedCells(x, nearest, apart, self.masses)


@dataclass(frozen=True)
class WeightedCells:
    """Sums over the cells of points.

    Attributes
    ----------
    x : (n, d) float64
        The points.
    nearest : (m,) intp
        The point of each part.
    apart : (m, d) float64
        From it to the part.
    weights : (m,) float64
        Masses of the parts.
    """

    x: FloatArray
    nearest: NDArray[np.intp]
    apart: FloatArray
    weights: FloatArray

    @cached_property
    def masses(self) -> FloatArray:
        """(n,) float64: masses of cells."""
        return np.bincount(self.nearest, self.weights, len(self.x)).astype(np.float64)

    @cached_property
    def moves(self) -> FloatArray:
        """(n, d) float64: from each point to its cell's centroid; 0 for a cell without mass."""
        sums = [np.bincount(self.nearest, self.weights * along, len(self.x)) for along in self.apart.T]
        moves: FloatArray = np.stack(sums, axis=1) / np.where(self.masses > 0, self.masses, 1)[:, None]
        return moves

    def main_axes(self) -> tuple[FloatArray, FloatArray]:
        """Give the direction in which each cell is longest, and its standard deviation there.

        Returns
        -------
        directions : (n, d) float64
            Unit vectors.
        deviations : (n,) float64
            In pixels.
        """
        n, d = self.x.shape
        from_centroid = self.apart - self.moves[self.nearest]
        tensor = np.empty((n, d, d))
        for a in range(d):
            for b in range(d):
                products = self.weights * from_centroid[:, a] * from_centroid[:, b]
                tensor[:, a, b] = np.bincount(self.nearest, products, n)
        tensor /= np.where(self.masses > 0, self.masses, 1)[:, None, None]
        values, vectors = np.linalg.eigh(tensor)
        return vectors[:, :, -1], np.sqrt(np.maximum(values[:, -1], 0))


def parts_of_pixels(ink: FloatArray, d: int) -> NDArray[np.int64]:
    """Count the parts of pixels' sides that give a cell of that density parts enough.

    Parameters
    ----------
    ink : (...) float64
        Points a pixel.
    d : int
        Axes.

    Returns
    -------
    (...) int64
    """
    return np.maximum(np.ceil((PARTS_OF_A_CELL * ink) ** (1 / d)), 1).astype(np.int64)
