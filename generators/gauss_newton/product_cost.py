"""What reaching amplitudes costs, before anything is listed: multiplications and additions of a product."""

from __future__ import annotations

import math

from gbnbench.generators.gauss_newton.modes import ball_count, largest_square

TRANSFORM = 5.0  # a real transform's operations over N log2 N, in the time of a matrix product's; measured
LARGEST_GRID = 2**28  # 2 GB; two or three are alive at once
STEPS, PRODUCTS = 8, 300  # of a typical set
WORK = 5e14  # most operations: some hours; a million points in the plane come to half of it


def wave_sum_operations(n: int, d: int, reach: int) -> float:
    """Operations of one sum over n points of all waves with |f|**2 <= reach."""
    lead = math.ceil(d / 2)
    return 2.0 * n * (ball_count(reach, lead) + 2) * (ball_count(reach, d - lead) + 2)


def convolution_operations(d: int, reach: int) -> float:
    """Operations of one product with the Gram matrix by convolutions; inf where the grid is too large."""
    side = 4.0 * math.isqrt(reach) + 1
    if d * math.log(side) > math.log(LARGEST_GRID):
        return math.inf
    return 2 * d * TRANSFORM * side**d * math.log2(side**d)


def convolutions_are_cheaper(n: int, d: int, reach: int) -> bool:
    """Whether convolutions are the cheaper product."""
    return convolution_operations(d, reach) < 4 * wave_sum_operations(n, d, reach)


def solver_operations(n: int, d: int, edge: float) -> float:
    """Operations of a typical run of ``reach``; 1e10 a second is a slow processor.

    Each step sums the amplitudes once and the displacement twice, and for convolutions the amplitudes up to
    twice the edge in single precision.
    """
    reach = largest_square(n, d, edge)
    if reach == 0:
        return 0.0
    product, step = 4 * wave_sum_operations(n, d, reach), 3 * wave_sum_operations(n, d, reach)
    if convolution_operations(d, reach) < product:
        product = convolution_operations(d, reach)
        step += wave_sum_operations(n, d, 4 * reach) / 2
    return STEPS * step + PRODUCTS * product


def too_long(n: int, d: int, edge: float) -> str | None:
    """Why a run would be too long; None where it is not."""
    operations = solver_operations(n, d, edge)
    if operations <= WORK:
        return None
    return (
        f"n={n} points in d={d} up to nu={edge:.4g} are too much work: {operations:.2g} operations, of "
        f"{WORK:.0e} at most; take fewer points or a lower edge"
    )
