"""Masses, centroids and energies of power cells, and how masses change with the weights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix


@dataclass(frozen=True)
class MeasuredCells:
    """Power cells of n weighted points, measured by a density whose whole is 1; a uniform one gives areas.

    Attributes
    ----------
    mass : (n,) float64
        Of the cells; they sum to 1. A point that another one's weight hides has 0.
    moment : (n, 2) float64
        Integral of y - x over each cell; the centroid lies at x + moment / mass.
    energy : (n,) float64
        Integral of |y - x|**2 over each cell.
    edges : (m, 2) intp
        Points a and b of cells that share a side; each side is here as (a, b) and as (b, a).
    conductance : (m,) float64
        Mass along each side over twice the distance of its points: -d mass[a] / d weight[b].
    reach : float
        Width of the border whose images may touch the cells.
    """

    mass: FloatArray
    moment: FloatArray
    energy: FloatArray
    edges: NDArray[np.intp]
    conductance: FloatArray
    reach: float

    @property
    def offset(self) -> FloatArray:
        """Centroid of each cell, from its point: (n, 2) float64, nan for a hidden point."""
        with np.errstate(invalid="ignore"):
            return np.asarray(self.moment / self.mass[:, None])

    def laplacian(self) -> csc_matrix:
        """Derive the masses by the weights: (n, n), symmetric, its rows sum to 0."""
        from scipy.sparse import csc_matrix

        n = len(self.mass)
        rows = np.concatenate([self.edges[:, 0], self.edges[:, 0]])
        columns = np.concatenate([self.edges[:, 1], self.edges[:, 0]])
        values = np.concatenate([-self.conductance, self.conductance])
        return csc_matrix((values, (rows, columns)), shape=(n, n))
