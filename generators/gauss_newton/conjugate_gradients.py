"""Conjugate gradients for a product known only as a function (Hestenes & Stiefel 1952)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gbnbench.generators.gauss_newton.axis_waves import ComplexArray


def inner(a: ComplexArray, b: ComplexArray) -> float:
    """Return the real inner product, Re(conj(a) b) summed, in an order that no number of threads changes.

    Parameters
    ----------
    a, b : (m,) complex128

    Returns
    -------
    float
    """
    return float(np.sum(a.real * b.real) + np.sum(a.imag * b.imag))


def solve(
    product: Callable[[ComplexArray], ComplexArray], b: ComplexArray, tolerance: float, limit: int
) -> tuple[ComplexArray, int]:
    """Solve product(y) = b until the residual is at most tolerance |b|, or the products are used up.

    Parameters
    ----------
    product : callable
        Linear, symmetric and positive semidefinite in Re(conj(y) z).
    b : (m,) complex128
        Right-hand side.
    tolerance : float
        Of the residual, relative to b.
    limit : int
        Most products.

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
    """Choose the tolerance of the next linear solve by the second choice of Eisenstat & Walker (1996).

    Parameters
    ----------
    now, before : float
        Norm of the residual at this step and at the last; before is inf at the first.
    last : float
        The last tolerance.

    Returns
    -------
    float
        1e-5 to 0.1.
    """
    if not math.isfinite(before):
        return 0.1
    choice = 0.9 * (now / before) ** 2
    safeguard = 0.9 * last**2
    return min(0.1, max(choice, safeguard if safeguard > 0.1 else 0.0, 1e-5))
