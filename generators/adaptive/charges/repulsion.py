"""Forces 1 / r between all points: near ones in pairs, far ones on a mesh (Hockney & Eastwood 1981)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.charges.smoothed_field import SmoothedField
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import shortest

WINDOW = 0.8  # width of the Gaussians that carry charges to nodes and back, and of the field's own, in cells
SPREAD = 3 * WINDOW**2  # variance of all three, in squared cells
CUT = math.sqrt(2 * SPREAD * 11.5)  # cells to where pairs act, exp(-11.5) = 1e-5
REACH = 4  # nodes on either side of a point to which its charge is carried, at least 4 widths
PAIRS = 25.0  # of points, for each, that are wanted
MOST_NODES = 1 << 21
MOST_PAIRS = 40_000_000


class Repulsion:
    """Forces of points on one another.

    Parameters
    ----------
    density : Density
        Of an image, whose domain the points are in.
    n : int
        Points.
    """

    def __init__(self, density: Density, n: int) -> None:
        self._density = density
        shape = np.array(density.shape, np.float64)
        cell = mesh_cell(density, n)
        if density.toroidal:
            self._counts = tuple(np.maximum(np.ceil(shape / cell).astype(int), 1).tolist())
            self._cell, self._first = shape / self._counts, np.zeros(2)
        else:
            self._counts = tuple((np.ceil(shape / cell).astype(int) + 2 * REACH + 1).tolist())
            self._cell, self._first = np.full(2, cell), np.full(2, -REACH * cell)
        self._width = WINDOW * float(self._cell.max())
        self._cut = CUT * float(self._cell.max())
        self._field = SmoothedField(self._counts, self._cell, self._width**2, toroidal=density.toroidal)

    def __call__(self, x: FloatArray) -> FloatArray:
        """Sum the forces.

        Parameters
        ----------
        x : (n, 2) float64
            Points, in pixels.

        Returns
        -------
        (n, 2) float64
            Of unit charges, 1 / r from each other one; to some 1e-4 of a near one's.
        """
        return self._far(x) + self._near(x)

    def _near(self, x: FloatArray) -> FloatArray:
        """Add what the mesh leaves out of near pairs' forces: exp(-r^2 / 2 v) / r."""
        from scipy.spatial import cKDTree

        torus = np.array(self._density.shape, np.float64) if self._density.toroidal else None
        pairs = cKDTree(x, boxsize=torus).query_pairs(self._cut, output_type="ndarray")
        i, j = pairs[:, 0], pairs[:, 1]
        apart = shortest(self._density, x[i] - x[j])
        square = np.maximum(np.einsum("pa,pa->p", apart, apart), 1e-24)
        push = np.exp(square * (-(WINDOW**2) / (2 * SPREAD * self._width**2))) / square
        total = np.empty_like(x)
        for a in range(2):
            force = push * apart[:, a]
            total[:, a] = np.bincount(i, force, len(x)) - np.bincount(j, force, len(x))
        return total

    def _far(self, x: FloatArray) -> FloatArray:
        nodes, weights = self._windows(x)
        charges = np.bincount(nodes.ravel(), weights.ravel(), math.prod(self._counts)).astype(np.float64)
        fields = self._field(charges.reshape(self._counts))
        return np.stack([(field.ravel()[nodes] * weights).sum(axis=1) for field in fields], axis=1)

    def _windows(self, x: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
        """Nodes around each point, and shares of a unit charge: (n, nodes) each."""
        at = (x - self._first) / self._cell
        nearest = np.rint(at).astype(np.intp)
        steps = np.arange(-REACH, REACH + 1)
        index = nearest[:, :, None] + steps
        away = (index - at[:, :, None]) * self._cell[:, None]
        share = np.exp(-(away**2) / (2 * self._width**2))
        share /= share.sum(axis=2, keepdims=True)
        if self._density.toroidal:
            index %= np.array(self._counts)[:, None]
        nodes = index[:, 0, :, None] * self._counts[1] + index[:, 1, None, :]
        weights = share[:, 0, :, None] * share[:, 1, None, :]
        return nodes.reshape(len(x), -1), weights.reshape(len(x), -1)


def mesh_cell(density: Density, n: int) -> float:
    """Choose the side of a cell: as near pairs are few, and nodes not too many.

    Parameters
    ----------
    density : Density
        Of an image.
    n : int
        Points.

    Returns
    -------
    float
        In pixels.
    """
    reached = math.sqrt(2 * PAIRS / math.pi / _crowding(density, n))
    cell = max(reached / CUT, math.sqrt(density.values.size / MOST_NODES))
    return min(cell, min(density.shape) / (2.05 * CUT)) if density.toroidal else cell


def charges_refusal(density: Density, n: int) -> str | None:
    """Say why forces between points would take too long.

    Parameters
    ----------
    density : Density
        Of an image.
    n : int
        Points.

    Returns
    -------
    str or None
        The reason.
    """
    cell = mesh_cell(density, n)
    if density.values.size / cell**2 > 2 * MOST_NODES:
        return (
            f"a torus of {density.shape[0]} x {density.shape[1]} pixels is too narrow for a mesh of charges"
        )
    pairs = min(n / 2, math.pi / 2 * (CUT * cell) ** 2 * _crowding(density, n)) * n
    if pairs > MOST_PAIRS:
        return (
            f"{n:,} points here have {pairs:,.0f} near pairs, where {MOST_PAIRS:,} are the most: fewer points"
        )
    return None


def _crowding(density: Density, n: int) -> float:
    """Mean density at the points, points a squared pixel."""
    rho = density.of_points(n)
    return float((rho**2).sum() / n)
