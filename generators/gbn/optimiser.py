"""Minimisers of the Gaussian Blue Noise energy: Nesterov with adaptive restart, and the paper's descent."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from gbnbench.generators.gbn.field import Field
from gbnbench.generators.gbn.lowband import LowBand
from gbnbench.torus import FloatArray

PATIENCE = 20  # steps over which a rise of the excess energy halves the step
PRECONDITION_ABOVE = 45  # spacings a side; below, 300 gradients bring the lowest modes down by themselves


def largest_curvature(n: int, d: int, sigma: float) -> float:
    """Largest eigenvalue of the energy's Hessian at a uniform density, in spacings.

    Notes
    -----
    max over q != 0 of |q|^2 (2 pi)^(d/2) sigma^d exp(-sigma^2 |q|^2 / 2), q = 2 pi f n^(-1/d): 4.62 for d =
    2, sigma = 1. The official step of 0.25 n^(2/d) / n is right in scale for d = 2 only.
    """
    unit = 2 * math.pi / n ** (1 / d)
    top = max(1, round(2 / (sigma * unit) ** 2))  # |f|^2 of the maximum, on the continuum
    q2 = unit**2 * np.unique(np.clip([1, top - 1, top, top + 1], 1, None))
    curvature = q2 * (2 * math.pi) ** (d / 2) * sigma**d * np.exp(-(sigma**2) * q2 / 2)
    return float(curvature.max())


def step_size(n: int, d: int, sigma: float) -> float:
    """First step of both methods, in squared spacings."""
    return 1.2 / max(largest_curvature(n, d, sigma), 2 / sigma**2)


def _capped(step: FloatArray) -> FloatArray:
    """Shorten the step where its longest displacement exceeds one spacing."""
    longest = math.sqrt(float(np.max(np.sum(step**2, axis=1))))
    return step / longest if longest > 1 else step


def descend(x: FloatArray, field: Field, sigma: float, iterations: int, excess: float = 0.0) -> FloatArray:
    """Take the paper's fixed steps (Algorithm 1), with the step scaled to the dimension.

    Parameters
    ----------
    x : (n, d) float64
        Start, box sides.
    field : Field
        Energy.
    sigma : float
        In spacings.
    iterations : int
        Steps; the paper recommends 10,000.
    excess : float
        Stop once the excess energy is at most this.

    Returns
    -------
    (n, d) float64
        In box sides, not wrapped.
    """
    n, d = x.shape
    side = n ** (1 / d)
    size = step_size(n, d, sigma)
    for _ in range(iterations):
        at = field(x[None])
        if at.excess[0] <= excess:
            break
        x = x - _capped(size * at.gradient[0]) / side
    return x


def accelerate(x: FloatArray, field: Field, sigma: float, gradients: int, excess: float = 0.0) -> FloatArray:
    """Nesterov's method with adaptive restart: 300 gradients do the work of 10,000 steps of descent.

    Parameters and returns are those of ``descend``. Above 45 spacings a side, 2,048 points in the plane, the
    lowest band is preconditioned, since its modes are too slow for any step that the middle band allows. The
    restart is that of O'Donoghue & Candes (2015).
    """
    n, d = x.shape
    side = n ** (1 / d)
    size = step_size(n, d, sigma)
    band = LowBand(n, d, sigma) if side > PRECONDITION_ABOVE else None
    y, momentum = x, 1.0
    recent: deque[float] = deque(maxlen=PATIENCE + 1)
    for _ in range(gradients):
        at = field(y[None])
        slope = at.gradient[0]
        if at.excess[0] <= excess:
            return y
        recent.append(float(at.excess[0]))
        if len(recent) > PATIENCE and recent[-1] > recent[0]:
            size /= 2
            recent.clear()
        step = size * slope
        if band is not None:
            step = step + band.correction(y, slope, size)
        moved = y - _capped(step) / side
        if np.vdot(slope, moved - x) > 0:
            y, momentum = moved, 1.0
        else:
            following = (1 + math.sqrt(1 + 4 * momentum**2)) / 2
            y = moved + (momentum - 1) / following * (moved - x)
            momentum = following
        x = moved
    return x
