"""A Gaussian wrapped round the unit circle: by its images, and by Jacobi's theta function.

Images serve narrow Gaussians and the theta function wide ones; both hold in between.
"""

from __future__ import annotations

import math

import mpmath


def image_sum(u, width) -> mpmath.mpf:
    """sum_j exp(-(u + j)^2 / (2 width^2)) at mpmath's precision, to 17 digits of its largest value."""
    reach, u, width = math.ceil(9 * width) + 1, mpmath.mpf(u), mpmath.mpf(width)
    return mpmath.fsum(mpmath.exp(-((u + j) ** 2) / (2 * width**2)) for j in range(-reach, reach + 1))


def jacobi(u, width, derivative: int = 0) -> mpmath.mpf:
    """The same sum or its derivative in u: sqrt(2 pi) width theta_3(pi u, exp(-2 pi^2 width^2))."""
    u, width = mpmath.mpf(u), mpmath.mpf(width)
    nome = mpmath.exp(-2 * mpmath.pi**2 * width**2)
    value = mpmath.jtheta(3, mpmath.pi * u, nome, derivative)
    return mpmath.sqrt(2 * mpmath.pi) * width * mpmath.pi**derivative * value
