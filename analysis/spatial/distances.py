"""Nearest-neighbour distances on the torus over the densest lattice's (Lagae & Dutré 2008; PSA)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from gbnbench.core.errors import RefusalError
from gbnbench.core.sides import as_sides, positions
from gbnbench.core.torus import HERMITE, FloatArray, as_realizations, densest_spacing


def nearest_distances(x: ArrayLike, sides: ArrayLike | None = None) -> FloatArray:
    """Distance from each point to its nearest neighbour on the torus, in densest spacings.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, n >= 2, d <= 8.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    (realizations, n) float64
        Over ``torus.densest_spacing(n, d)``; 1 for every point of the densest lattice.

    Raises
    ------
    InputError
        If sides are not d lengths.
    RefusalError
        If n = 1, or d > 8, where the densest lattice is not known.
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    lengths = as_sides(sides, d)
    unit = densest_spacing(n, d)
    if math.isnan(unit):
        raise RefusalError(
            f"distances are in spacings of the densest lattice, known for d <= {len(HERMITE)}; got d={d}"
        )
    if n < 2:
        raise RefusalError("a distance between points needs n >= 2; got n=1")
    box = np.ones(d) if lengths is None else np.array(lengths)
    placed = positions(sets, lengths)
    nearest = [np.asarray(cKDTree(points, boxsize=box).query(points, k=2)[0])[:, 1] for points in placed]
    return np.array(nearest, dtype=np.float64) / unit


def min_distance(x: ArrayLike, sides: ArrayLike | None = None) -> FloatArray:
    """Smallest toroidal distance between two points of each set, in densest spacings.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, n >= 2, d <= 8.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    (realizations,) float64
        The relative radius of Lagae & Dutré (2008): min over i != j of |x_i - x_j| / densest_spacing(n, d).

    Raises
    ------
    InputError
        As ``nearest_distances``.
    """
    return np.asarray(nearest_distances(x, sides).min(axis=1))


def mean_distance(x: ArrayLike, sides: ArrayLike | None = None) -> FloatArray:
    """Mean toroidal distance to the nearest neighbour of each set, in densest spacings.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, n >= 2, d <= 8.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    (realizations,) float64
        (1/n) sum over i of min over j of |x_i - x_j| / densest_spacing(n, d), as in PSA (Schlömer & Deussen
        2011).

    Raises
    ------
    InputError
        As ``nearest_distances``.
    """
    return np.asarray(nearest_distances(x, sides).mean(axis=1))
