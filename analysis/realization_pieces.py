"""The pieces in which the realizations of a source are measured, fixed by the request and by nothing else.

Sums over a source are taken within each piece and then over the pieces in their order, so that the same
bits come out however many workers there are, and whichever of them finishes first.
"""

from __future__ import annotations

SETS = 16  # most sets of a piece; a power of two
POINTS = 65_536  # most points of a piece of several sets
GROUPS = 64  # most groups of sets whose powers are kept frequency by frequency


def piece_size(n: int) -> int:
    """Give the number of sets of n points in a piece, a power of two: 16, or fewer where they are large."""
    size = SETS
    while size > 1 and size * n > POINTS:
        size //= 2
    return size


def pieces(n: int, realizations: int) -> list[tuple[int, int]]:
    """Cut the realizations of a source in pieces.

    Parameters
    ----------
    n, realizations : int
        Points of a set, and number of sets.

    Returns
    -------
    list of (first, count)
        The first realization of each piece, and how many it has; in order.

    Examples
    --------
    >>> pieces(1024, 40)
    [(0, 16), (16, 16), (32, 8)]
    >>> pieces(100_000, 2)
    [(0, 1), (1, 1)]
    """
    size = piece_size(n)
    return [(first, min(size, realizations - first)) for first in range(0, realizations, size)]


def group_size(realizations: int) -> int:
    """Give the number of sets in a group: the smallest power of two with which there are 64 groups at most.

    The power of each group is kept at every frequency, for the standard error of measures that need them all:
    of each set up to 64 sets, of pairs up to 128, and so on.
    """
    size = 1
    while size * GROUPS < realizations:
        size *= 2
    return size


def kept_groups(realizations: int) -> int:
    """Count the groups of a number of sets, the last of which may have fewer than the others."""
    return -(-realizations // group_size(realizations))
