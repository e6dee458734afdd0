"""First steps of the minimisers: a share of what the largest curvature of the energy allows."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from gbnbench.core.torus import FloatArray

LEAST_FREE, LARGEST_FREE = 0.15, 1.0  # nu of modes that a step must bear

Curvature = Callable[[FloatArray], FloatArray]  # of a mode q of displacements, by |q|^2


def gaussian_curvature(d: int, sigma: float) -> Curvature:
    """Curvature of the energy at a uniform density along its modes.

    Parameters
    ----------
    d : int
        Dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    callable
        |q|^2 (2 pi)^(d/2) sigma^d exp(-sigma^2 |q|^2 / 2) at |q|^2.
    """
    return functools.partial(_curvature, d=d, sigma=sigma)


def _curvature(q2: FloatArray, d: int, sigma: float) -> FloatArray:
    return np.asarray(q2 * (2 * math.pi) ** (d / 2) * sigma**d * np.exp(-(sigma**2) * q2 / 2))


def largest_curvature(n: int, d: int, sigma: float) -> float:
    """Largest eigenvalue of the energy's Hessian at a uniform density, in spacings.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float

    Notes
    -----
    max over q != 0 of |q|^2 (2 pi)^(d/2) sigma^d exp(-sigma^2 |q|^2 / 2), q = 2 pi f n^(-1/d): 4.62 for d =
    2, sigma = 1.
    """
    unit = 2 * math.pi / n ** (1 / d)
    top = max(1, round(2 / (sigma * unit) ** 2))  # |f|^2 of the maximum, on the continuum
    q2 = unit**2 * np.unique(np.clip([1, top - 1, top, top + 1], 1, None))
    return float(gaussian_curvature(d, sigma)(q2).max())


def step_size(n: int, d: int, sigma: float) -> float:
    """First step of both methods, in squared spacings.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float

    Notes
    -----
    Nesterov's method is stable up to 4/3 over the largest curvature. In boxes of a few spacings a side, those
    of high dimension, a set's own curvature exceeds the uniform density's by more than a tenth.
    """
    return stable_step(largest_curvature(n, d, sigma), d, sigma)


def stable_step(curvature: float, d: int, sigma: float) -> float:
    """Return the step for a largest curvature at a uniform density.

    Parameters
    ----------
    curvature : float
        Per squared spacing.
    d : int
        Dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float
        In squared spacings.
    """
    return (1.2 if d <= 3 else 1.0) / max(curvature, 2 / sigma**2)


def mode_step(curvature: Curvature) -> float:
    """First step under any kernel: by the largest curvature of modes that are not preconditioned.

    Parameters
    ----------
    curvature : callable
        Of a mode, at |q|^2.

    Returns
    -------
    float
        In squared spacings.
    """
    nu = np.linspace(LEAST_FREE, LARGEST_FREE, 100)
    return 1.2 / float(curvature((2 * math.pi * nu) ** 2).max())


def authors_step(n: int, d: int) -> float:
    """Return the step of the authors' programs, 0.25 / n for box sides; right in scale for d = 2 only.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    float
        In squared spacings.
    """
    return 0.25 * float(n ** (2 / d)) / n
