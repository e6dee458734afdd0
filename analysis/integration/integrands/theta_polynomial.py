"""The periodised Gaussian (Jacobi's theta function) as a polynomial in cos 2 pi u."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.torus import FloatArray

NEAREST = 0.0577  # widths up to which the nearest image alone is theta to 2^-54 of its largest value
NEGLIGIBLE = 2.0**-55  # what the harmonics left out may add up to, over theta's largest value


def theta_polynomial(width: float) -> FloatArray:
    """Theta over its mean as a polynomial in cos 2 pi u.

    Parameters
    ----------
    width : float
        Box sides, at least ``NEAREST``.

    Returns
    -------
    (degree + 1,) float64
        Ascending; the degree is 24 at ``NEAREST``, 11 for 1/8 (512 points in 3D), 1 from 0.8 on.

    Notes
    -----
    theta(u) = mean (1 + 2 sum over h >= 1 of exp(-2 pi^2 width^2 h^2) cos 2 pi h u), mean = sqrt(2 pi) width,
    by Chebyshev's T_h(cos 2 pi u) = cos 2 pi h u, whose coefficients are integers. They alternate in sign:
    the sum of their sizes stays below 1.3 times theta's largest value, so that little is lost.
    """
    decay = 2 * math.pi**2 * width**2
    weights = [1.0] + [2 * math.exp(-decay * h * h) for h in range(1, 60)]
    largest = math.fsum(weights)
    degree = 1
    while math.fsum(weights[degree + 1 :]) > NEGLIGIBLE * largest:
        degree += 1
    terms: list[list[float]] = [[] for _ in range(degree + 1)]
    before, now = [0, 1], [1]  # T_-1 = T_1 and T_0, ascending
    for h in range(degree + 1):
        for power, coefficient in enumerate(now):
            terms[power].append(weights[h] * coefficient)
        following = [0, *(2 * c for c in now)]  # T_(h+1) = 2 c T_h - T_(h-1)
        for power, c in enumerate(before):
            following[power] -= c
        before, now = now, following
    return np.array([math.fsum(term) for term in terms])


def circle(x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cosine and sine of 2 pi x, the nearest quarter turn taken off exactly."""
    quarter = np.rint(4 * x)
    angle = (2 * math.pi) * (x - quarter / 4)
    cosine, sine = np.cos(angle), np.sin(angle)
    odd, half = quarter % 2 == 1, quarter % 4 >= 2
    c = np.where(odd, -sine, cosine)
    s = np.where(odd, cosine, sine)
    return np.where(half, -c, c), np.where(half, -s, s)
