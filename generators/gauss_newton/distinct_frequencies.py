"""Frequencies of a list that differ, by a table of their box where they fill much of it."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.integer_frequencies import IntArray

TABLE = 16  # cells of the box for each frequency, up to which there is a table


def distinct_frequencies(f: IntArray) -> tuple[IntArray, IntArray]:
    """Find the frequencies that differ, and where each of a list stands among them.

    Parameters
    ----------
    f : (m, axes) int64
        The list.

    Returns
    -------
    rows : (k, axes) int64
        Those that differ, in rising order, the first axis foremost.
    place : (m,) int64
        For each frequency its row.
    """
    if f.shape[1] == 0:
        return np.zeros((1, 0), np.int64), np.zeros(len(f), np.int64)
    low = f.min(axis=0, initial=0)
    sides = (f.max(axis=0, initial=0) - low + 1).tolist()
    if math.prod(sides) > TABLE * max(len(f), TABLE):
        rows, place = np.unique(f, axis=0, return_inverse=True)
        return rows, place.reshape(-1)
    # Frequencies of a ball fill much of their box: a table of it takes a tenth of the time of sorting.
    cell = np.ravel_multi_index(tuple((f - low).T), sides)
    taken = np.zeros(math.prod(sides), bool)
    taken[cell] = True
    rows = np.stack(np.unravel_index(np.flatnonzero(taken), sides), axis=1) + low
    return rows.astype(np.int64), (np.cumsum(taken) - 1)[cell]
