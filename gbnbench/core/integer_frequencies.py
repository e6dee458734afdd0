"""Integer frequencies by squared length: how many there are of each, and one of each pair f, -f in a ball."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray

IntArray = NDArray[np.int64]
MOST_FREQUENCIES = 1 << 22  # of a list: 670 MB in 20 dimensions
LARGEST_SQUARE = 1 << 22  # |f|^2 up to which counts are made in two dimensions and more


def shell_counts(d: int, square: int, most: float = math.inf) -> tuple[IntArray, FloatArray]:
    """Count integer vectors of d components by squared length, from 0 to square.

    Parameters
    ----------
    d : int
        Number of components, >= 1.
    square : int
        Largest squared length, >= 0.
    most : float, optional
        Counting stops, short of d components, as soon as there are more vectors than this.

    Returns
    -------
    squares : (k,) int64
        Squared lengths that occur, ascending.
    counts : (k,) float64
        How many vectors have each: whole numbers, exact below 2^53.

    Raises
    ------
    RefusalError
        If so long a ball holds far more frequencies than are ever listed.

    Examples
    --------
    >>> [row.tolist() for row in shell_counts(2, 5)]
    [[0, 1, 2, 4, 5], [1.0, 4.0, 4.0, 4.0, 8.0]]
    """
    h = np.arange(math.isqrt(square) + 1)
    if d == 1:
        return h * h, np.where(h == 0, 1.0, 2.0)
    if square > LARGEST_SQUARE:
        raise RefusalError(
            f"frequencies up to |f|={math.sqrt(square):.4g} in d={d} are too many; at most "
            f"{MOST_FREQUENCIES} are listed: ask for fewer"
        )
    counts = np.zeros(square + 1)
    counts[h * h] = np.where(h == 0, 1.0, 2.0)
    for _ in range(d - 1):  # one axis more: only squares of its component are added
        if counts.sum() > most:
            break
        occurring = np.flatnonzero(counts)
        longer = counts.copy()
        for side in h[1:].tolist():
            fits = occurring[: np.searchsorted(occurring, square - side * side, side="right")]
            longer[fits + side * side] += 2 * counts[fits]
        counts = longer
    occurring = np.flatnonzero(counts)
    return occurring, counts[occurring]


@lru_cache(maxsize=64)
def half_count(d: int, square: int) -> float:
    """Count the frequencies that ``half_ball`` lists, without listing them.

    Parameters
    ----------
    d : int
        Dimension, >= 1.
    square : int
        Largest |f|^2.

    Returns
    -------
    float
        A whole number, exact below 2^53.
    """
    return float(shell_counts(d, square)[1][1:].sum() / 2)


def half_ball(d: int, square: int) -> IntArray:
    """List the half ball 0 < |f|^2 <= square: of each pair f, -f that whose first nonzero component is > 0.

    Parameters
    ----------
    d : int
        Dimension, >= 1.
    square : int
        Largest |f|^2.

    Returns
    -------
    (m, d) int64
        In lexicographic order.

    Examples
    --------
    >>> half_ball(2, 2).tolist()
    [[0, 1], [1, -1], [1, 0], [1, 1]]
    """
    rows = np.zeros((1, 0), dtype=np.int64)
    spare = np.array([square], dtype=np.int64)  # squared length that further components may add
    side = np.arange(-math.isqrt(square), math.isqrt(square) + 1)
    for _ in range(d):
        fits = (side**2 <= spare[:, None]) & ((rows != 0).any(axis=1, keepdims=True) | (side >= 0))
        row, h = np.nonzero(fits)
        rows = np.column_stack([rows[row], side[h]])
        spare = spare[row] - side[h] ** 2
    return rows[rows.any(axis=1)]


def to_half_space(frequencies: IntArray) -> tuple[IntArray, NDArray[np.bool_]]:
    """Replace f by -f where its first nonzero component is negative, as in ``half_ball``.

    Parameters
    ----------
    frequencies : (m, d) int64
        Any frequencies; 0 stays 0.

    Returns
    -------
    f : (m, d) int64
        Each frequency or its negative.
    negated : (m,) bool
        Which were replaced.
    """
    first = np.take_along_axis(frequencies, (frequencies != 0).argmax(axis=1)[:, None], axis=1)[:, 0]
    negated = first < 0
    return np.where(negated[:, None], -frequencies, frequencies), negated
