"""The cost of a Gauss-Newton solution, estimated before anything is listed: multiplications and additions."""

from __future__ import annotations

import math

from gbnbench.generators.gauss_newton.modes import ball_count, largest_square
from gbnbench.generators.gauss_newton.wave_sums import BLOCK, HELD

TRANSFORM = 5.0  # a real transform's operations over N log2 N, in the time of a matrix product's; measured
LARGEST_GRID = 2**28  # 2 GB; two or three are alive at once
ENTRY, MODE = 250.0, 5000.0  # operations in the time of an entry of the tables, and of a frequency; measured
STEPS, PRODUCTS = 8, 300  # of a typical set
WORK = 5e14  # most operations: some hours; a million points in the plane come to half of it


def wave_sum_operations(n: int, d: int, square: int) -> float:
    """Count the operations of one sum over n points of all waves with |f|**2 <= square.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    square : int
        Largest |f|**2.

    Returns
    -------
    float
    """
    lead = math.ceil(d / 2)
    return 2.0 * n * (ball_count(lead, square) + 2) * (ball_count(d - lead, square) + 2)


def table_entries(n: int, d: int, square: int) -> float:
    """Count the entries of the tables of waves of n points, of all |f|**2 <= square.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    square : int
        Largest |f|**2.

    Returns
    -------
    float
    """
    lead = math.ceil(d / 2)
    return n * (ball_count(lead, square) / 2 + ball_count(d - lead, square) / 2 + 2)


def table_bytes(n: int, d: int, square: int) -> float:
    """Bytes that ``WaveSums`` takes for its tables at most: those of a block, in making, and those it keeps.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    square : int
        Largest |f|**2.

    Returns
    -------
    float
    """
    entries = table_entries(n, d, square)
    block = min(entries, max(BLOCK, 64 / n * entries))
    return 48 * block + (16 * entries if entries <= HELD else 0.0)


def list_operations(n: int, d: int, square: int) -> float:
    """Count what a sum and its gradient take besides products, as operations: tables, and each frequency.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    square : int
        Largest |f|**2.

    Returns
    -------
    float
    """
    entries = table_entries(n, d, square)
    return ENTRY * entries * (1 if entries <= HELD else 2) + MODE * ball_count(d, square) / 2


def convolution_operations(d: int, square: int) -> float:
    """Count the operations of one product with the Gram matrix by convolutions.

    Parameters
    ----------
    d : int
        Dimension.
    square : int
        Largest |f|**2.

    Returns
    -------
    float
        inf where the grid is too large.
    """
    side = 4.0 * math.isqrt(square) + 1
    if d * math.log(side) > math.log(LARGEST_GRID):
        return math.inf
    return 2 * d * TRANSFORM * side**d * math.log2(side**d)


def convolutions_are_cheaper(n: int, d: int, square: int) -> bool:
    """Tell whether convolutions are the cheaper product.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    square : int
        Largest |f|**2.

    Returns
    -------
    bool
    """
    return convolution_operations(d, square) < 4 * wave_sum_operations(n, d, square)


def solver_operations(n: int, d: int, edge: float) -> float:
    """Count the operations of a typical run of ``solve_for_amplitudes``; a slow processor does 1e10 a second.

    Each step sums the amplitudes once and the displacement twice, and for convolutions the amplitudes up to
    twice the edge in single precision.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    edge : float
        In nu.

    Returns
    -------
    float
    """
    square = largest_square(n, d, edge)
    if square == 0:
        return 0.0
    product, step = 4 * wave_sum_operations(n, d, square), 3 * wave_sum_operations(n, d, square)
    if convolution_operations(d, square) < product:
        product = convolution_operations(d, square)
        step += wave_sum_operations(n, d, 4 * square) / 2
    return STEPS * step + PRODUCTS * product


def too_long(n: int, d: int, edge: float) -> str | None:
    """Say why a run would take too long.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    edge : float
        In nu.

    Returns
    -------
    str or None
        The reason; None where it does not.
    """
    operations = solver_operations(n, d, edge)
    if operations <= WORK:
        return None
    return (
        f"n={n} points in d={d} up to nu={edge:.4g} are too much work: {operations:.2g} operations, of "
        f"{WORK:.0e} at most; take fewer points or a lower edge"
    )
