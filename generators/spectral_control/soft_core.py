"""A soft core: an energy of all pairs that are nearer than a distance, 0 where there are none."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray, wrap

NEVER = 1e-12  # of the core: two points at one place have no direction apart


def soft_core(u: FloatArray, side: float, core: float) -> tuple[float, FloatArray]:
    """Sum (1 - r / core)**2 over pairs nearer than the core, and its gradient.

    Parameters
    ----------
    u : (n, d) float64
        Points, in spacings, on a torus of that side.
    side : float
        Of the box, in spacings.
    core : float
        In spacings, below half the side.

    Returns
    -------
    energy : float
    gradient : (n, d) float64
        Per spacing.

    Examples
    --------
    >>> soft_core(np.array([[0.0], [0.5]]), 10.0, 1.0)
    (0.25, array([[ 1.],
           [-1.]]))
    """
    from scipy.spatial import cKDTree

    x = wrap(u / side)
    pairs = cKDTree(x, boxsize=np.ones(x.shape[1])).query_pairs(core / side, output_type="ndarray")
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    first, second = pairs[:, 0], pairs[:, 1]
    apart = x[first] - x[second]
    apart = (apart - np.rint(apart)) * side
    distance = np.maximum(np.sqrt(np.sum(apart**2, axis=1)), NEVER * core)
    overlap = 1 - distance / core
    force = (-2 * overlap / (core * distance))[:, None] * apart
    gradient = np.zeros(u.shape)
    for a in range(u.shape[1]):
        gradient[:, a] = np.bincount(first, force[:, a], len(u)) - np.bincount(second, force[:, a], len(u))
    return float(np.sum(overlap**2)), gradient
