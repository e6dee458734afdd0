"""Kernels of the energy by their Fourier transforms: the Gaussian, and those that discrepancies are made of.

The energy of a set is (1/2n) sum over f != 0 of w(2 pi f n^(-1/d)) |F(f)|^2, w being the kernel's transform
and the spacing the unit of length: a squared error of integration in the kernel's reproducing kernel Hilbert
space (Gräf, Potts & Steidl 2012).
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Literal, get_args

import numpy as np

from gbnbench.core.torus import FloatArray

KernelName = Literal["gaussian", "distance", "log", "riesz", "multiquadric", "inverse", "matern", "vonmises"]
KERNELS: tuple[KernelName, ...] = get_args(KernelName)
SINGULAR = ("distance", "log", "riesz")  # at r = 0, or as curved there as a cone; they have no width
NEGLIGIBLE = {
    "matern": 1e-5
}  # share of the largest curvature k**2 w(k) beyond which frequencies are left out
EXPONENTIAL = 1e-10  # of kernels whose transform falls exponentially
SMOOTHNESS = 2.5  # of the Matérn kernel: twice differentiable

Transform = Callable[[FloatArray, int, float], FloatArray]


def gaussian(k: FloatArray, d: int, sigma: float) -> FloatArray:
    """Transform of exp(-r**2 / 2 sigma**2), the kernel of Gaussian Blue Noise.

    Parameters
    ----------
    k : float64
        2 pi nu, a spacing being the unit of length.
    d : int
        Dimension.
    sigma : float
        In spacings.

    Returns
    -------
    float64
    """
    return np.asarray((2 * math.pi) ** (d / 2) * sigma**d * np.exp(-((sigma * k) ** 2) / 2))


def multiquadric(k: FloatArray, d: int, sigma: float) -> FloatArray:
    """Transform of -sqrt(r**2 + sigma**2), a repulsion that is soft near by and constant far away.

    Parameters and returns are those of ``gaussian``; k > 0.
    """
    return _multiquadric(k, d, sigma, 0.5)


def inverse_multiquadric(k: FloatArray, d: int, sigma: float) -> FloatArray:
    """Transform of 1 / sqrt(r**2 + sigma**2), the softened repulsion of charges in space.

    Parameters and returns are those of ``gaussian``; k > 0.
    """
    return _multiquadric(k, d, sigma, -0.5)


def _multiquadric(k: FloatArray, d: int, sigma: float, power: float) -> FloatArray:
    """Size of the transform of (r**2 + sigma**2)**power (Wendland 2005, Theorem 8.15)."""
    from scipy.special import kv

    scale = (2 * math.pi) ** (d / 2) * 2 ** (1 + power) / abs(math.gamma(-power))
    return np.asarray(scale * (k / sigma) ** (-power - d / 2) * kv(d / 2 + power, sigma * k))


def matern(k: FloatArray, d: int, sigma: float) -> FloatArray:
    """Transform of (1 + s + s**2 / 3) exp(-s), s = sqrt(5) r / sigma, the Matérn kernel of smoothness 5/2.

    Parameters and returns are those of ``gaussian``.
    """
    a = 2 * SMOOTHNESS / sigma**2
    scale = 2**d * math.pi ** (d / 2) * math.gamma(SMOOTHNESS + d / 2) / math.gamma(SMOOTHNESS)
    return np.asarray(scale * a**SMOOTHNESS * (a + k**2) ** (-SMOOTHNESS - d / 2))


RADIAL: dict[str, Transform] = {
    "gaussian": gaussian,
    "multiquadric": multiquadric,
    "inverse": inverse_multiquadric,
    "matern": matern,
}


def exponent(kernel: str, power: float) -> float:
    """Return t of a singular kernel, whose transform is k**(-d - t) but for a factor.

    Parameters
    ----------
    kernel : {"distance", "log", "riesz"}
        -r, -log r, r**-power.
    power : float
        Of "riesz".

    Returns
    -------
    float
    """
    return {"distance": 1.0, "log": 0.0, "riesz": -power}[kernel]


def transform(kernel: str, k: FloatArray, d: int, sigma: float, power: float) -> FloatArray:
    """Transform of a kernel, radially; that of a singular one but for its factor.

    Parameters
    ----------
    kernel : str
        One of ``KERNELS``; "vonmises" is taken as the Gaussian, from which it differs where boxes are small.
    k : float64
        2 pi nu, > 0.
    d : int
        Dimension.
    sigma : float
        In spacings; the singular kernels have none.
    power : float
        Of "riesz".

    Returns
    -------
    float64
    """
    if kernel in SINGULAR:
        return np.asarray(k ** (-d - exponent(kernel, power)))
    return RADIAL.get(kernel, gaussian)(k, d, sigma)


def smooth_weights(kernel: str, n: int, d: int, sigma: float) -> FloatArray:
    """Weights of all frequencies that matter to a smooth kernel.

    Parameters
    ----------
    kernel : str
        A name of ``RADIAL``, or "vonmises": the product over the axes of exp(kappa (cos 2 pi x - 1)), kappa =
        (side / 2 pi sigma)**2, as curved at 0 as the Gaussian.
    n, d : int
        Points and dimension.
    sigma : float
        In spacings.

    Returns
    -------
    (fmax + 1,) * d float64
        At f >= 0; that at 0 means nothing.
    """
    side = n ** (1 / d)
    unit = 2 * math.pi / side
    if kernel == "vonmises":
        return _von_mises(side, d, sigma)
    k = np.arange(unit, 60.0 / sigma + 2 * unit, unit)
    fmax = _highest(k**2 * RADIAL[kernel](k, d, sigma), NEGLIGIBLE.get(kernel, EXPONENTIAL)) + 1
    square = sum(np.ix_(*[np.arange(fmax + 1.0) ** 2] * d)) * unit**2
    square[(0,) * d] = unit**2
    return RADIAL[kernel](np.sqrt(square), d, sigma)


def _von_mises(side: float, d: int, sigma: float) -> FloatArray:
    from scipy.special import ive

    kappa = (side / (2 * math.pi * sigma)) ** 2
    f = np.arange(0, math.ceil(60 / sigma * side / (2 * math.pi)) + 3)
    axis = side * ive(f, kappa)
    axis = axis[: _highest(f**2 * axis, EXPONENTIAL) + 1]
    return np.asarray(functools.reduce(np.multiply.outer, [axis] * d))


def _highest(curvature: FloatArray, negligible: float) -> int:
    """Index of the last that is no negligible share of the largest."""
    return int(np.flatnonzero(curvature > negligible * curvature.max())[-1])
