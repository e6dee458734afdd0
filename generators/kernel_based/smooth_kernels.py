"""Fourier transforms of smooth kernels, as weights of the frequencies of the torus."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.kernel_based.mesh_sums import MeshEnergy

NEGLIGIBLE = 1e-10  # share of the largest curvature k**2 w(k), beyond which frequencies are left out


def gaussian(k: FloatArray, d: int, width: float) -> FloatArray:
    """Transform of exp(-r**2 / 2 width**2), the kernel of Gaussian Blue Noise.

    Parameters
    ----------
    k : float64
        2 pi nu, a spacing being the unit of length.
    d : int
        Dimension.
    width : float
        In spacings.

    Returns
    -------
    float64
    """
    return np.asarray((2 * math.pi) ** (d / 2) * width**d * np.exp(-((width * k) ** 2) / 2))


def multiquadric(k: FloatArray, d: int, width: float) -> FloatArray:
    """Transform of -sqrt(r**2 + width**2), a repulsion that is soft near by and constant far away.

    Parameters and returns are those of ``gaussian``; k > 0.
    """
    return _multiquadric(k, d, width, 0.5)


def inverse_multiquadric(k: FloatArray, d: int, width: float) -> FloatArray:
    """Transform of 1 / sqrt(r**2 + width**2), the softened repulsion of charges in space.

    Parameters and returns are those of ``gaussian``; k > 0.
    """
    return _multiquadric(k, d, width, -0.5)


def _multiquadric(k: FloatArray, d: int, width: float, power: float) -> FloatArray:
    """Size of the transform of (r**2 + width**2)**power (Wendland 2005, Theorem 8.15)."""
    from scipy.special import kv

    scale = (2 * math.pi) ** (d / 2) * 2 ** (1 + power) / abs(math.gamma(-power))
    return np.asarray(scale * (k / width) ** (-power - d / 2) * kv(d / 2 + power, width * k))


RADIAL: dict[str, Callable[[FloatArray, int, float], FloatArray]] = {
    "gaussian": gaussian,
    "multiquadric": multiquadric,
    "inverse": inverse_multiquadric,
}


def smooth_energy(kernel: str, n: int, d: int, width: float) -> MeshEnergy:
    """Open the energy of a smooth kernel on a mesh of all frequencies that matter.

    Parameters
    ----------
    kernel : str
        A name of ``RADIAL``, or "vonmises": the product over the axes of exp(kappa (cos 2 pi x - 1)), kappa =
        (side / 2 pi width)**2, as curved at 0 as the Gaussian.
    n, d : int
        Points and dimension.
    width : float
        In spacings.

    Returns
    -------
    MeshEnergy
        The sum over pairs of the periodised kernel, less that of a uniform density.
    """
    side = n ** (1 / d)
    unit = 2 * math.pi / side
    if kernel == "vonmises":
        return MeshEnergy(_von_mises(side, d, width), n)
    transform = RADIAL[kernel]
    k = np.arange(unit, 60.0 / width + 2 * unit, unit)
    curvature = k**2 * transform(k, d, width)
    fmax = int(np.flatnonzero(curvature > NEGLIGIBLE * curvature.max())[-1]) + 1
    square = sum(np.ix_(*[np.arange(fmax + 1.0) ** 2] * d)) * unit**2
    square[(0,) * d] = unit**2  # which the mesh leaves out
    return MeshEnergy(transform(np.sqrt(square), d, width), n)


def _von_mises(side: float, d: int, width: float) -> FloatArray:
    from scipy.special import ive

    kappa = (side / (2 * math.pi * width)) ** 2
    f = np.arange(0, math.ceil(60 / width * side / (2 * math.pi)) + 3)
    axis = side * ive(f, kappa)
    curvature = f**2 * axis
    axis = axis[: int(np.flatnonzero(curvature > NEGLIGIBLE * curvature.max())[-1]) + 1]
    return np.asarray(functools.reduce(np.multiply.outer, [axis] * d))
