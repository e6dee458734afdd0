"""The ball of frequencies that the energy sums: how far it reaches, and how many frequencies it holds."""

from __future__ import annotations

import math

from gbnbench.core.errors import InputError
from gbnbench.core.integer_frequencies import shell_counts
from gbnbench.generators.gbn import kernel


def square_needed(n: int, d: int, sigma: float, precision: str) -> int:
    """Return |f|^2 beyond which no frequency shows in a gradient of the precision.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.

    Returns
    -------
    int

    Notes
    -----
    The forces of one pair at frequencies left out add up to less than half a rounding of the largest force:
    sum over |f|^2 > s of |f| exp(-b |f|^2), bounded by an integral over the ball's surface.
    """
    b = kernel.decay(kernel.side_of(n, d), sigma)
    surface = math.log(2) + d / 2 * math.log(math.pi) - math.lgamma(d / 2)
    allowed = math.log(kernel.EPS[precision] / 4) + _log_strength(n, d, sigma)
    square = 1
    while True:
        r = math.sqrt(square + 1)
        # a surface r^(d-1) of |f| = r at the next shell, over its decay 2 b r; twice for the lattice
        tail = surface + d * math.log(r) - b * (r * r) - math.log(min(1.0, 2 * b * r)) + math.log(2)
        if tail <= allowed:
            return square
        square += max(1, math.floor(0.02 * square))


def _log_strength(n: int, d: int, sigma: float) -> float:
    """Logarithm of the largest force of one pair over 2 pi mean / L, as the series sum |f| w_f counts it."""
    side = kernel.side_of(n, d)
    mean = d * math.log(math.sqrt(2 * math.pi) * sigma / side)
    return math.log(kernel.largest_force(n, d, sigma)) - mean - math.log(2 * math.pi / side)


def ball_volume(d: int, square: int) -> float:
    """Count the frequencies with |f|^2 <= square, exactly where that is quick.

    Parameters
    ----------
    d : int
        Dimension.
    square : int
        Largest |f|^2.

    Returns
    -------
    float
    """
    if d < 2:
        return 1.0 + 2 * d * math.isqrt(square)
    if square * math.sqrt(square) * d <= 3e5:
        return float(shell_counts(d, square)[1].sum())
    return math.pow(math.pi, d / 2) / math.gamma(d / 2 + 1) * math.pow(math.sqrt(square) + 0.5, d)


def ball_square(n: int, d: int, sigma: float, precision: str, edge: float | None) -> int:
    """Return the largest |f|^2 that is summed.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.
    edge : float or None
        Highest nu that is summed.

    Returns
    -------
    int

    Raises
    ------
    InputError
        If edge is not positive, or so small that no frequency is left.
    """
    if edge is None:
        return square_needed(n, d, sigma, precision)
    if not edge > 0:
        raise InputError(f"edge must be positive, in nu = |f| n^(-1/d); got {edge}")
    side = kernel.side_of(n, d)
    if edge * side < 1 - 1e-12:
        raise InputError(
            f"edge={edge} leaves no frequency of {n} points in {d}D: the lowest is {1 / side:.4g}"
        )
    within = math.floor((edge * side) ** 2 * (1 + 1e-12)) if math.isfinite(edge) else 1 << 60
    return min(within, square_needed(n, d, sigma, precision))
