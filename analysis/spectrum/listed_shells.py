"""Exact shells |f|^2 = 1, 2, 3, ... listed frequency by frequency: what high dimensions can afford.

A cube of d axes holds 3^d frequencies at the least. The shell |f|^2 = 1 holds 2 d, and the first shells about
as many as there are ways to choose |f|^2 axes, times 2^|f|^2: 9,120 on |f|^2 = 3 in d = 20.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.limits import LARGEST_COUNT, LARGEST_NU, MOST_KEPT, default_shell_fmax
from gbnbench.analysis.spectrum.shells import EDGE
from gbnbench.core import integer_frequencies
from gbnbench.core.errors import InputError

MOST_COORDINATES = 1 << 23  # of the frequencies of one half space: 64 MB as they are listed, by default
LARGEST_LIST = 1 << 26  # the same, of shells that were asked for: 512 MB
MOST_TERMS = 4e9  # of one set: half the frequencies times points times dimension, seconds on one core


def shell_sizes(d: int, most: int) -> list[int]:
    """Count the integer frequencies on every shell |f|^2 = 0 ... most, exactly.

    Parameters
    ----------
    d, most : int
        Dimension, and largest |f|^2.

    Returns
    -------
    list of int
        ``most + 1`` numbers: the first coefficients of (1 + 2 q + 2 q^4 + 2 q^9 + ...)^d.

    Examples
    --------
    >>> shell_sizes(2, 5), shell_sizes(20, 3)
    ([1, 4, 4, 0, 4, 8], [1, 40, 760, 9120])
    """
    largest = (2 * math.isqrt(most) + 1) ** d  # no count is larger: beyond 64 bits Python's own integers
    sizes = np.zeros(most + 1, dtype=np.int64 if largest < 1 << 62 else object)
    sizes[0] = 1
    for _ in range(d):
        before = sizes.copy()
        for digit in range(1, math.isqrt(most) + 1):
            sizes[digit * digit :] += 2 * before[: most + 1 - digit * digit]
    counted: list[int] = sizes.tolist()
    return counted


def half_ball(d: int, high: int, low: int = 1) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """List one half space of the frequencies with low <= |f|^2 <= high, shell by shell.

    Parameters
    ----------
    d, high, low : int
        Dimension, and largest and smallest |f|^2, at least 1.

    Returns
    -------
    square : (m,) int64
        |f|^2, ascending.
    frequencies : (m, d) int64
        Of each pair f and -f the one whose first coordinate that is not 0 is positive.
    """
    frequencies = integer_frequencies.half_ball(d, high)
    square = (frequencies * frequencies).sum(axis=1)
    wanted = square >= low
    frequencies, square = frequencies[wanted], square[wanted]
    order = np.argsort(square, kind="stable")
    return square[order], frequencies[order]


def affordable_square(n: int, d: int, realizations: int = 1) -> int:
    """Choose the largest |f|^2 whose shells are listed by default: just beyond nu = 2, or as affordable.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.
    realizations : int
        Number of sets whose powers are kept.

    Returns
    -------
    int
        At least 1: 2 d frequencies are always affordable.
    """
    wanted = (math.floor(LARGEST_NU * math.pow(n, 1 / d) * (1 + EDGE)) + 1) ** 2
    most = 2 * min(MOST_COORDINATES / d, MOST_TERMS / (n * d), MOST_KEPT / realizations)
    return max(1, largest_square(d, int(most), wanted))


def default_shells(n: int, d: int) -> tuple[int, tuple[float, float] | None]:
    """Choose fmax and band for shells: a whole ball, or the first shells where its cube cannot be counted.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.

    Returns
    -------
    fmax : int
        Largest harmonic on each axis.
    band : (float, float) or None
        Smallest and largest |f|.
    """
    fmax = default_shell_fmax(n, d)
    if (2 * fmax + 1) ** d <= LARGEST_COUNT:
        return fmax, None
    most = math.sqrt(affordable_square(n, d))
    return math.ceil(most), (1.0, most)


def listed_count(d: int, low: int, high: int) -> int:
    """Count the frequencies of one half space with low <= |f|^2 <= high, which are to be listed.

    Parameters
    ----------
    d, low, high : int
        Dimension, and smallest and largest |f|^2.

    Returns
    -------
    int

    Raises
    ------
    InputError
        If they are too many to be listed; the text says how far they can be.
    """
    most = 2 * LARGEST_LIST // d
    if (reached := largest_square(d, most, high)) < high:
        found = float(sum(shell_sizes(d, reached + 1)))
        way_out = f"the band 1,{math.sqrt(reached):.6g} can" if reached else "list those you need"
        raise InputError(
            f"shells of |f|^2 up to {high} in d={d} cannot be listed: with |f|^2 = {reached + 1} they are "
            f"{found:.3g} frequencies; {way_out}"
        )
    if d == 1:
        return math.isqrt(high) - math.isqrt(low - 1)
    return sum(shell_sizes(d, high)[low:]) // 2


def largest_square(d: int, most: int, wanted: int) -> int:
    """Find the largest |f|^2, up to what is wanted, within which there are at most so many frequencies.

    Parameters
    ----------
    d, most, wanted : int
        Dimension, frequencies allowed, and |f|^2 beyond which none are wanted.

    Returns
    -------
    int
        0 where even |f|^2 = 1 is too much.
    """
    if d == 1:  # whose shells are few among many numbers: 2 isqrt(s) frequencies have |f|^2 <= s
        return min(wanted, (most // 2 + 1) ** 2 - 1)
    counted = 16  # in high dimensions the first few shells are all there is
    while True:
        sizes = shell_sizes(d, min(counted, wanted))
        within = reached = 0
        for square, size in enumerate(sizes[1:], start=1):
            within += size
            if within > most:
                return reached
            reached = square
        if counted >= wanted:
            return reached
        counted *= 4
