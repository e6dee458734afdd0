"""Blocks of coordinates so small that they stay in cache from one step of a calculation to the next."""

from __future__ import annotations

from collections.abc import Iterator

CACHED = 1 << 15  # coordinates of a block


def block_shape(sets: int, n: int, d: int) -> tuple[int, int]:
    """Give the sets and the points of the largest block: whole sets where these are small.

    Parameters
    ----------
    sets, n, d : int
        Number of sets, points of a set, and dimension.

    Returns
    -------
    sets, points : int
    """
    return max(1, min(sets, CACHED // (n * d))), max(1, min(n, CACHED // d))


def cached_blocks(sets: int, n: int, d: int) -> Iterator[tuple[slice, slice]]:
    """Cut an array of sets in blocks that stay in cache.

    Parameters
    ----------
    sets, n, d : int
        Number of sets, points of a set, and dimension.

    Yields
    ------
    sets, points : slice
        Those of a block, in order.
    """
    most, points = block_shape(sets, n, d)
    for begin in range(0, sets, most):
        for first in range(0, n, points):
            yield slice(begin, min(begin + most, sets)), slice(first, min(first + points, n))
