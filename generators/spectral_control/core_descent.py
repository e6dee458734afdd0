"""An empty band and a hard core at once: soft-core stealthy ground states (Kim & Torquato 2025)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gbnbench.core.torus import FloatArray, densest_spacing, wrap
from gbnbench.generators.spectral_control.limited_memory_bfgs import minimise
from gbnbench.generators.spectral_control.named_profiles import StepProfile
from gbnbench.generators.spectral_control.ring_cost import RingCost, rings_below

MARGIN = 1.01  # of the core: the last steps to the empty band move points by far less
STEPS = 1500
ENOUGH = 1e-13  # cost a point, the rounding of single-precision waves


def descend_to_core(
    x: FloatArray, edge: float, core: float, progress: Callable[[int, float], None] | None = None
) -> FloatArray:
    """Bring points near an empty band and apart by at least a core.

    Parameters
    ----------
    x : (n, d) float64
        Start, box sides.
    edge : float
        Of the band, in nu.
    core : float
        Least distance, in spacings.
    progress : callable, optional
        Called with steps done, of at most 1500, and the cost.

    Returns
    -------
    (n, d) float64
        Where the descent of the band's power and a soft core a hundredth wider ended; that need not be at 0.
    """
    n, d = x.shape
    side = math.pow(n, 1 / d)
    cost = RingCost(rings_below(n, d, StepProfile(edge), edge), MARGIN * core)
    return wrap(minimise(cost, side * x, STEPS, ENOUGH, progress).x / side)


def widest_core(d: int) -> float:
    """Bound the least distance that points can keep, in spacings: of the densest packing for d <= 3.

    Parameters
    ----------
    d : int
        Dimension.

    Returns
    -------
    float
        Beyond 3D that of balls that fill space, which none reach.

    Examples
    --------
    >>> [round(widest_core(d), 3) for d in (1, 2, 3, 4)]
    [1.0, 1.075, 1.122, 1.342]
    """
    if d <= 3:
        return densest_spacing(1, d)
    return 2 * math.exp((math.lgamma(d / 2 + 1) - d / 2 * math.log(math.pi)) / d)


def least_distance(x: FloatArray) -> float:
    """Distance of the nearest two points on the torus, in spacings.

    Parameters
    ----------
    x : (n, d) float64
        Points, box sides; two or more.

    Returns
    -------
    float

    Examples
    --------
    >>> least_distance(np.array([[0.0, 0.0], [0.75, 0.0], [0.0, 0.5], [0.5, 0.5]]))
    0.5
    """
    from scipy.spatial import cKDTree

    n, d = x.shape
    nearest = np.asarray(cKDTree(x, boxsize=np.ones(d)).query(x, k=2)[0])
    return float(nearest[:, 1].min()) * math.pow(n, 1 / d)
