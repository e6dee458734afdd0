"""The kernel of Gaussian Blue Noise on the torus: theta functions as series, scale, largest force.

theta(u) = sum over j of exp(-(u + j L)^2 / 2 sigma^2), L = n^(1/d) spacings a side, is
mean (1 + 2 sum_{f >= 1} w_f cos 2 pi f u / L) with w_f = exp(-2 pi^2 sigma^2 f^2 / L^2) and
mean = sqrt(2 pi) sigma / L (Ahmed, Ren & Wonka 2022, Eq. 22-23; printed there over all f, the identity needs
twice the sum over f >= 1).
"""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import numpy as np

from gbnbench.core.torus import FloatArray

EPS = {"double": 2.0**-53, "float": 2.0**-24}  # largest relative error of one rounding
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803")


def side_of(n: int, d: int) -> float:
    """Return the box's side in spacings.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    float
    """
    return math.pow(n, 1 / d)


def uniform_energy(d: int, sigma: float) -> float:
    """Twice the energy a point of a constant density.

    Parameters
    ----------
    d : int
        Dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float
        (2 pi)^(d/2) sigma^d.
    """
    return math.pow(2 * math.pi, d / 2) * math.pow(sigma, d)


def energy_error(d: int, sigma: float, precision: str) -> float:
    """Typical error of an excess energy, the difference of two nearly equal sums.

    Parameters
    ----------
    d : int
        Dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.

    Returns
    -------
    float
        1e-15 (double) or 1e-7 (float) of the uniform energy.
    """
    return {"double": 1e-15, "float": 1e-7}[precision] * uniform_energy(d, sigma)


def decay(side: float, sigma: float) -> float:
    """Return b of w_f = exp(-b f^2).

    Parameters
    ----------
    side : float
        Of the box, in spacings.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float
    """
    return 2 * (math.pi * sigma / side) ** 2


def weights(side: float, sigma: float, most: int) -> FloatArray:
    """Weights of the series, w_0 to w_most.

    Parameters
    ----------
    side : float
        Of the box, in spacings.
    sigma : float
        Kernel width, in spacings.
    most : int
        Highest harmonic.

    Returns
    -------
    (most + 1,) float64
    """
    return np.exp(-decay(side, sigma) * np.arange(most + 1.0) ** 2)


def degree(side: float, sigma: float, precision: str) -> int:
    """Highest harmonic of theta that its value or its slope can show in the precision.

    Parameters
    ----------
    side : float
        Of the box, in spacings.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.

    Returns
    -------
    int
        At least 1.

    Notes
    -----
    The harmonics left out add up to less than half a rounding of the largest departure from the mean, and so
    do their slopes: about 1.4 L / sigma in double.
    """
    b = decay(side, sigma)
    allowed = EPS[precision] / 4
    most = max(2, math.ceil(math.sqrt(50 / b)) + 2)
    f = np.arange(1.0, most + 1)
    w = np.exp(-b * (f**2 - 1))  # over the first
    value, slope = np.cumsum(w[::-1])[::-1], np.cumsum((f * w)[::-1])[::-1]
    steepest = np.max(np.sin(2 * np.pi * np.outer(np.linspace(0, 0.5, 8 * most + 1), f)) @ (f * w))
    enough = (value <= allowed * value[0]) & (slope <= allowed * steepest)
    return max(1, int(np.argmax(enough))) if enough.any() else most


def polynomial(side: float, sigma: float, order: int, flat: bool) -> FloatArray:
    """Coefficients of theta / mean - 1 in powers of c = cos(2 pi u / L), summed to an order.

    Parameters
    ----------
    side, sigma : float
        In spacings.
    order : int
        Highest harmonic, 1 or more.
    flat : bool
        Whether to count in units of w_1.

    Returns
    -------
    (order + 1,) float64
        Ascending, each rounded once.

    Notes
    -----
    From Chebyshev's T_f(c) = cos(2 pi f u / L), in decimals since the powers of T_f cancel. The sum of their
    sizes stays at theta's largest value up to 18 sigmas a side, so that Horner's scheme loses nothing; beyond
    20 the series' end makes it grow.
    """
    with localcontext() as context:
        context.prec = 40 + 2 * order
        b = 2 * (PI * Decimal(sigma) / Decimal(side)) ** 2
        scale = 2 * b.exp() if flat else Decimal(2)
        total = [Decimal(0)] * (order + 1)
        before, now = [1], [0, 1]  # T_0 and T_1, ascending
        for f in range(1, order + 1):
            w = scale * (-b * f * f).exp()
            for power, c in enumerate(now):
                total[power] += w * c
            following = [0, *(2 * c for c in now)]  # T_(f+1) = 2 c T_f - T_(f-1)
            for power, c in enumerate(before):
                following[power] -= c
            before, now = now, following
        return np.array([float(c) for c in total])


def unit(side: float, sigma: float, d: int, precision: str) -> float:
    """Return the unit in which departures of theta / mean from 1 are counted.

    Parameters
    ----------
    side : float
        Of the box, in spacings.
    sigma : float
        Kernel width, in spacings.
    d : int
        Dimension.
    precision : {"double", "float"}
        Of the arithmetic.

    Returns
    -------
    float
        w_1 where the product of d thetas is 1 plus the sum of their departures to the precision, else 1.
    """
    first = math.exp(-decay(side, sigma))
    return first if 4 * d * first < EPS[precision] / 4 else 1.0


def largest_force(n: int, d: int, sigma: float) -> float:
    """Largest component of the force of one pair, per spacing: max |theta'| times theta(0)^(d-1).

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
    exp(-1/2) / sigma where the box is wide; 4 pi w_1 mean / L times theta(0)^(d-1) where it is narrow.
    """
    side = side_of(n, d)
    if side > 20 * sigma:
        return math.exp(-0.5) / sigma
    order = degree(side, sigma, "double")
    f = np.arange(1, order + 1)
    w = weights(side, sigma, order)[1:]
    mean = math.sqrt(2 * math.pi) * sigma / side
    u = np.linspace(0, 0.5, 64 + 16 * order)
    slope = 4 * math.pi * mean / side * np.max(np.sin(2 * np.pi * np.outer(u, f)) @ (f * w))
    return float(slope) * (mean * float(1 + 2 * w.sum())) ** (d - 1)
