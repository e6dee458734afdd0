"""Sixfold order of Delaunay neighbours: bond order (Heck et al. 2013; PSA), psi6 (Halperin & Nelson 1978)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.analysis.spatial.delaunay import Neighbours, plane_neighbours
from gbnbench.analysis.spatial.plane_rings import IndexArray
from gbnbench.core.torus import FloatArray


def bond_order(x: ArrayLike | Sequence[Neighbours], sides: ArrayLike | None = None) -> FloatArray:
    """Bond-orientational order Q6 of each set, as PSA measures it.

    Parameters
    ----------
    x : (n, 2) or (realizations, n, 2) float64, or what ``delaunay.neighbours`` returned
        Points on the unit torus.
    sides : (2,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a square if not given. Neighbours bring their own.

    Returns
    -------
    (realizations,) float64
        In [0, 1]; 1 on the hexagonal lattice, near 0.36 for random points.

    Raises
    ------
    InputError
        If sides are not two lengths.
    RefusalError
        If d is not 2, or two points of a set coincide.

    Notes
    -----
    Q6 = sum over points of |sum over its neighbours of exp(6 i theta)| / total number of neighbours, theta
    being the direction of the edge between consecutive Delaunay neighbours of the point (Heck, Schlömer &
    Deussen 2013, as in PSA).
    """
    values = [bond_sums(each).sum() / len(each.vector) for each in plane_neighbours(x, "bond order", sides)]
    return np.array(values, dtype=np.float64)


def bond_sums(each: Neighbours) -> FloatArray:
    """|sum of exp(6 i theta)| at every point, theta the direction of an edge between its neighbours: (n,)."""
    bond = _complex(each.vector)
    edge = bond[_following(each.indptr)] - bond
    return np.asarray(np.abs(each.sum_over_points(_sixfold(edge))))


def psi6(x: ArrayLike | Sequence[Neighbours], sides: ArrayLike | None = None) -> FloatArray:
    """Sixfold order psi6 of each set: mean over points of |mean over neighbours of exp(6 i theta)|.

    Parameters
    ----------
    x : (n, 2) or (realizations, n, 2) float64, or what ``delaunay.neighbours`` returned
        Points on the unit torus.
    sides : (2,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a square if not given. Neighbours bring their own.

    Returns
    -------
    (realizations,) float64
        In [0, 1]; 1 on the hexagonal lattice, 0 on the square one.

    Raises
    ------
    InputError
        If sides are not two lengths.
    RefusalError
        If d is not 2, or two points of a set coincide.

    Notes
    -----
    theta is the direction from the point to its Delaunay neighbour (Halperin & Nelson 1978).
    """
    values = [np.mean(psi_of_points(each)) for each in plane_neighbours(x, "psi6", sides)]
    return np.array(values, dtype=np.float64)


def psi_of_points(each: Neighbours) -> FloatArray:
    """|mean of exp(6 i theta)| at every point, theta the direction of a neighbour: (n,)."""
    return np.asarray(np.abs(each.sum_over_points(_sixfold(_complex(each.vector)))) / each.degree)


def _complex(vector: FloatArray) -> NDArray[np.complex128]:
    return vector[:, 0] + 1j * vector[:, 1]


def _sixfold(z: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """exp(6 i angle of z), without the angle."""
    unit = z / np.abs(z)
    cube = unit * unit * unit
    return cube * cube


def _following(indptr: IndexArray) -> IndexArray:
    """Row of the next neighbour in each point's cycle."""
    rows = np.arange(1, indptr[-1] + 1, dtype=np.intp)
    rows[indptr[1:] - 1] = indptr[:-1]
    return rows
