"""The power that is left in a band, and the last step that empties it to rounding."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gauss_newton.conjugate_gradients import solve
from gbnbench.generators.gauss_newton.gram_matrix import gram_product
from gbnbench.generators.gauss_newton.modes import modes_below
from gbnbench.generators.gauss_newton.wave_sums import WaveSums

FORCING = 1e-4  # residual of the step's linear solve
PRODUCTS = 3000


def band_power(x: FloatArray, edge: float) -> FloatArray:
    """Power of one set at one of each pair f, -f with 0 < nu < edge.

    Parameters
    ----------
    x : (n, d) float64
        Points, box sides.
    edge : float
        In nu.

    Returns
    -------
    (m,) float64
    """
    n, d = x.shape
    amplitudes = WaveSums(wrap(x), modes_below(n, d, edge).f).amplitudes()
    return np.asarray(np.abs(amplitudes) ** 2 / n)


def last_step(x: FloatArray, edge: float) -> FloatArray:
    """Take one more Gauss-Newton step: quadratic convergence leaves rounding alone, 1e-29 for 1,024 points.

    Parameters
    ----------
    x : (n, d) float64
        Points of an all but empty band, box sides.
    edge : float
        Of the band, in nu.

    Returns
    -------
    (n, d) float64
        The points themselves where the step leaves more power.
    """
    n, d = x.shape
    below = modes_below(n, d, edge)
    waves = WaveSums(x, below.f)
    scale, side = 1 / (math.sqrt(n) * below.length), math.pow(n, 1 / d)
    y, _ = solve(gram_product(x, below, waves), -waves.amplitudes() * scale, FORCING, PRODUCTS)
    moved = wrap(x + waves.gradient(scale * y, side) / side)
    return moved if band_power(moved, edge).max() < band_power(x, edge).max() else x
