"""Nearest-neighbour distances on the torus over the densest lattice's (Lagae & Dutré 2008; PSA)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import HERMITE, FloatArray, as_realizations, densest_spacing


def nearest_distances(x: ArrayLike) -> FloatArray:
    """Distance from each point to its nearest neighbour on the torus, in densest spacings.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, n >= 2, d <= 8.

    Returns
    -------
    (realizations, n) float64
        Over ``torus.densest_spacing(n, d)``; 1 for every point of the densest lattice.

    Raises
    ------
    RefusalError
        If n = 1, or d > 8, where the densest lattice is not known.
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    unit = densest_spacing(n, d)
    if math.isnan(unit):
        raise RefusalError(
            f"distances are in spacings of the densest lattice, known for d <= {len(HERMITE)}; got d={d}"
        )
    if n < 2:
        raise RefusalError("a distance between points needs n >= 2; got n=1")
    box = np.ones(d)
    nearest = [np.asarray(cKDTree(points, boxsize=box).query(points, k=2)[0])[:, 1] for points in sets]
    return np.array(nearest, dtype=np.float64) / unit


def min_distance(x: ArrayLike) -> FloatArray:
    """Smallest toroidal distance between two points of each set, in densest spacings: (realizations,).

    Lagae & Dutré (2008) call it the relative radius: min over i != j of |x_i - x_j| / densest_spacing(n, d).

    Raises
    ------
    RefusalError
        As ``nearest_distances``.
    """
    return np.asarray(nearest_distances(x).min(axis=1))


def mean_distance(x: ArrayLike) -> FloatArray:
    """Mean toroidal distance to the nearest neighbour of each set, in densest spacings: (realizations,).

    (1/n) sum over i of min over j of |x_i - x_j| / densest_spacing(n, d), as in PSA (Schlömer & Deussen
    2011).

    Raises
    ------
    RefusalError
        As ``nearest_distances``.
    """
    return np.asarray(nearest_distances(x).mean(axis=1))
