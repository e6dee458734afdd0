"""Squares of the L2 discrepancies on the line, as sums of squares over sorted points (Warnock 1972)."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.spatial.discrepancy_kernels import Discrepancy
from gbnbench.core.double_double import two_product, two_sum
from gbnbench.core.torus import FloatArray

UNITS = 64  # roundings of 2^-53 that a value passes through, rounded up
# Square of each discrepancy as shares of A and of V.
SHARES: dict[Discrepancy, tuple[float, float]] = {
    "CD": (1.0, 0.0),
    "WD": (0.0, 2.0),
    "MD": (0.5, 1.0),
    "L2-star": (1.0, 0.0),
    "L2-periodic": (0.0, 2.0),
    "diaphony": (0.0, 4 * math.pi**2),
}


def line_squares(x: FloatArray, kind: Discrepancy) -> tuple[float, float]:
    """Square of a discrepancy of points on the line, and the bound of its error.

    Parameters
    ----------
    x : (n, 1) float64
        Points in [0, 1).
    kind : Discrepancy
        Which.

    Returns
    -------
    square, error : float
        The error is some 1e-14 of the square.

    Notes
    -----
    Let D(t) be the share of points below t less t, and e_i = x_(i) - (2 i - 1) / (2 n) over the sorted
    points. Then (Warnock 1972)

        A = integral of D^2 = 1 / (12 n^2) + (1/n) sum e_i^2,
        V = integral of (D - mean D)^2 = 1 / (12 n^2) + (1/n) sum (e_i - mean e)^2.

    On the line the centred kernel of the star and of the centred discrepancy is that of A, that of the
    wrap-around and of the periodic one is B2(t) = t^2 - t + 1/6, whose mean over pairs is 2 V, and that of
    the mixture is half of each. Nothing cancels: terms are squares, and e_i is taken before it is rounded.
    """
    n = len(x)
    ordered = np.sort(x[:, 0])
    product, rest = two_product(2.0 * n, ordered)
    whole, more = two_sum(product, 1 - 2.0 * np.arange(1, n + 1, dtype=np.float64))
    departure = whole + (more + rest)  # 2 n e_i
    about_zero = 1 + 3 * math.fsum(departure**2) / n
    about_mean = 1 + 3 * math.fsum((departure - math.fsum(departure) / n) ** 2) / n
    corner, torus = SHARES[kind]
    square = (corner * about_zero + torus * about_mean) / (12 * n**2)
    # A departure rounds in proportion to itself, not to its distance from the mean.
    return square, UNITS * 2.0**-53 * (corner + torus) * about_zero / (12 * n**2)
