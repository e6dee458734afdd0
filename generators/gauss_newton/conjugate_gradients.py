"""Conjugate gradients for a product known only as a function (Hestenes & Stiefel 1952)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gbnbench.generators.gauss_newton.wave_sums import ComplexArray


def inner(a: ComplexArray, b: ComplexArray) -> float:
    """Re(conj(a) b) summed, in an order that does not depend on the number of threads."""
    return float(np.sum(a.real * b.real) + np.sum(a.imag * b.imag))


def solve(
    product: Callable[[ComplexArray], ComplexArray], b: ComplexArray, tolerance: float, limit: int
) -> tuple[ComplexArray, int]:
    """Solve product(y) = b to |residual| <= tolerance |b|, or as near as limit products come.

    Returns
    -------
    y : (m,) complex128
    products : int
        How many it took.
    """
    y, rest = np.zeros_like(b), b.copy()
    along = rest.copy()
    square = inner(rest, rest)
    goal = tolerance**2 * square
    for taken in range(limit):
        if square <= goal:
            return y, taken
        forward = product(along)
        curvature = inner(along, forward)
        if curvature <= 0:  # only rounding is left
            return y, taken + 1
        size = square / curvature
        y += size * along
        rest -= size * forward
        following = inner(rest, rest)
        along = rest + following / square * along
        square = following
    return y, limit


def forcing(now: float, before: float, last: float) -> float:
    """Tolerance of the next step's solution: the second choice of Eisenstat & Walker (1996), 1e-5 to 0.1."""
    if not math.isfinite(before):
        return 0.1
    choice = 0.9 * (now / before) ** 2
    safeguard = 0.9 * last**2
    return min(0.1, max(choice, safeguard if safeguard > 0.1 else 0.0, 1e-5))
