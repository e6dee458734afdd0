"""Resolution of power by the error of its square root, and what a Gaussian filter leaves of it."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

RESOLVED = 0.01  # relative error up to which a power counts as known


def gaussian_response(nu: FloatArray, sigma: float) -> FloatArray:
    """Power response of a Gaussian of unit mass: exp(-(2 pi sigma nu)^2).

    Parameters
    ----------
    nu : (...) float64
        Frequencies |f| n**(-1/d).
    sigma : float
        Width of the Gaussian in spacings, >= 0.

    Returns
    -------
    (...) float64
        Factor of the power at each frequency.

    Raises
    ------
    InputError
        If sigma is not a number of at least 0.
    """
    if not (isinstance(sigma, (int, float, np.number)) and 0 <= sigma < math.inf):
        raise InputError(f"sigma must be a width of at least 0, in spacings; got {sigma!r}")
    response: FloatArray = np.exp(-((2 * math.pi * sigma * nu) ** 2))
    return response


def resolvable_power(rms: float) -> float:
    """Smallest power that is known to 1% if its square root is off by rms: about (200 rms)^2."""
    return (rms * (1 + math.sqrt(1 + RESOLVED)) / RESOLVED) ** 2
