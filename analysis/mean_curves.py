"""Curves of a source as means over its sets, from the sums that its pieces have."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray


def mean_rdf(sums: Sequence[NDArray[Any]], realizations: int) -> dict[str, NDArray[Any]]:
    """Average the radial distribution function.

    Parameters
    ----------
    sums : sequence of (2, bins) float64
        Of each piece the bins' left edges, and g summed over its sets.
    realizations : int
        Sets of all pieces.

    Returns
    -------
    dict of arrays
        Columns r, g.
    """
    return {"r": sums[0][0], "g": np.sum([piece[1] for piece in sums], axis=0) / realizations}


def mean_valence(sums: Sequence[NDArray[Any]], realizations: int) -> dict[str, NDArray[Any]]:
    """Average the shares of the points that have each degree.

    Parameters
    ----------
    sums : sequence of (2, k) float64
        Of each piece the degrees that occur, and their shares summed over its sets.
    realizations : int
        Sets of all pieces.

    Returns
    -------
    dict of arrays
        Columns degree, share, from the least degree to the largest.
    """
    low, high = (int(end(end(piece[0]) for piece in sums)) for end in (min, max))
    total = np.zeros(high - low + 1)
    for degree, share in sums:
        total[int(degree[0]) - low :][: len(degree)] += share
    return {"degree": np.arange(low, high + 1, dtype=np.intp), "share": total / realizations}
