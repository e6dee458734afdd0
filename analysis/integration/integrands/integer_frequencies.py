"""Integer frequencies by length: how many there are of each |f|^2, and half a ball of them."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray

MOST_DIMENSIONS = 20  # as far as every family's numbers are proven
MOST_FREQUENCIES = 1 << 22  # of a list: 670 MB in 20 dimensions
LONGEST = 1 << 22  # |f|^2 of shells counted in two dimensions and more


def beyond_dimensions(what: str, d: int) -> str | None:
    """Say why there is no such integrand in d dimensions, else None."""
    if 1 <= d <= MOST_DIMENSIONS:
        return None
    return f"{what} are for d = 1 to {MOST_DIMENSIONS}; got d={d}"


def shells(d: int, square: int) -> tuple[NDArray[np.int64], FloatArray]:
    """Count integer vectors of d components by squared length, from 0 to square.

    Returns
    -------
    squares : (k,) int64
        Squared lengths that are met, ascending.
    counts : (k,) float64
        How many vectors have each: whole numbers, exact below 2^53.

    Raises
    ------
    RefusalError
        If so long a ball holds far more frequencies than are ever listed.

    Examples
    --------
    >>> [row.tolist() for row in shells(2, 5)]
    [[0, 1, 2, 4, 5], [1.0, 4.0, 4.0, 4.0, 8.0]]
    """
    h = np.arange(math.isqrt(square) + 1)
    if d == 1:
        return h * h, np.where(h == 0, 1.0, 2.0)
    if square > LONGEST:
        raise RefusalError(
            f"frequencies up to |f|={math.sqrt(square):.4g} in d={d} are too many; at most "
            f"{MOST_FREQUENCIES} are listed: ask for fewer"
        )
    counts = np.zeros(square + 1)
    counts[h * h] = np.where(h == 0, 1.0, 2.0)
    for _ in range(d - 1):
        met = np.flatnonzero(counts)
        longer = counts.copy()
        for side in h[1:].tolist():
            fits = met[: np.searchsorted(met, square - side * side, side="right")]
            longer[fits + side * side] += 2 * counts[fits]
        counts = longer
    met = np.flatnonzero(counts)
    return met, counts[met]


@lru_cache(maxsize=64)
def half_count(d: int, square: int) -> float:
    """How many frequencies ``half_ball`` has."""
    return float(shells(d, square)[1][1:].sum() / 2)


def check_count(
    what: str,
    d: int,
    count: float,
    way_out: str = "leave out a larger share",
    most: int = MOST_FREQUENCIES,
) -> None:
    """Refuse a list of more frequencies than asked for, or than memory should hold.

    Raises
    ------
    RefusalError
        If count is above most.
    """
    if count > most:
        raise RefusalError(
            f"{what} in d={d} has {count:.0f} frequencies, one of each pair f, -f; "
            f"at most {most} are listed: {way_out}"
        )


def check_share(share: float, refusal: str | None) -> None:
    """Refuse a share that is none, or a dimension that there is a reason to refuse.

    Raises
    ------
    InputError
        If share is not between 0 and 1, or there is a refusal.
    """
    if refusal is not None:
        raise RefusalError(refusal)
    if not 0 < share < 1:
        raise InputError(f"share must be of the energy to leave out, 0 < share < 1; got {share}")


def half_ball(d: int, square: int) -> NDArray[np.int64]:
    """One of each pair f, -f with 0 < |f|^2 <= square, the first component that is not 0 being positive.

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
    spare = np.array([square], dtype=np.int64)  # of the squared length
    side = np.arange(-math.isqrt(square), math.isqrt(square) + 1)
    for _ in range(d):
        fits = (side**2 <= spare[:, None]) & ((rows != 0).any(axis=1, keepdims=True) | (side >= 0))
        row, h = np.nonzero(fits)
        rows = np.column_stack([rows[row], side[h]])
        spare = spare[row] - side[h] ** 2
    return rows[rows.any(axis=1)]


def halved(frequencies: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Turn frequencies to the half space of ``half_ball``.

    Returns
    -------
    f : (m, d) int64
        f or -f, 0 staying 0.
    turned : (m,) bool
        Which are -f.
    """
    first = np.take_along_axis(frequencies, (frequencies != 0).argmax(axis=1)[:, None], axis=1)[:, 0]
    turned = first < 0
    return np.where(turned[:, None], -frequencies, frequencies), turned
