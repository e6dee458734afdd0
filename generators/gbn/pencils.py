"""Which points of a bounded domain can lie within the cut-off of which: sorted pencils of cells, d <= 3.

The domain is cut into pencils along its first axis; points are sorted by pencil and by column within it, so
that the neighbours of a few consecutive points are one run of consecutive points in each pencil near by.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from gbnbench.torus import FloatArray

ACROSS = 3  # pencils in one cut-off: fewer sum too many pairs beyond it, more make runs too short
MOST_COLUMNS = 4096  # along a pencil


@dataclass(frozen=True)
class Runs:
    """Groups of consecutive points of one sorted set, and what each must be summed over.

    Attributes
    ----------
    order : (n,) intp
        Sorts the set.
    first : (groups,) int64
        The sorted index at which a group begins.
    slot : (n,) int64
        group * lanes + lane of each sorted point.
    runs : (groups, each, 2) int64
        Half-open ranges of sorted points; empty ones where a pencil would lie outside the domain.
    """

    order: NDArray[np.intp]
    first: NDArray[np.int64]
    slot: NDArray[np.int64]
    runs: NDArray[np.int64]


def all_pairs(n: int, lanes: int) -> Runs:
    """Every group over every point."""
    first = np.arange(0, n, lanes, dtype=np.int64)
    runs = np.tile(np.array([0, n], np.int64), (len(first), 1, 1))
    return Runs(np.arange(n), first, np.arange(n, dtype=np.int64), runs)


def pair_share(d: int, reach: float) -> float:
    """Share of all pairs that pencils would sum over, about; above 1 where they are no use."""
    height = reach / ACROSS
    if d > 3:
        return math.inf
    return min(1.0, 2 * reach) * min(1.0, (2 * ACROSS + 1) * height) ** (d - 1)


def pencils(x: FloatArray, reach: float, lanes: int) -> Runs:
    """Sort one set into pencils.

    Parameters
    ----------
    x : (n, d) float64
        Points of the unit box, d <= 3.
    reach : float
        Cut-off in box sides.
    lanes : int
        Points of a group; none straddles two pencils.
    """
    n, d = x.shape
    high = max(1, math.floor(ACROSS / reach))  # pencils across, no thinner than reach / ACROSS
    columns = min(MOST_COLUMNS, max(1, round(n ** (1 / d))))
    column = np.minimum((x[:, 0] * columns).astype(np.int64), columns - 1)
    pencil = np.zeros(n, np.int64)
    for a in range(1, d):
        pencil = pencil * high + np.minimum((x[:, a] * high).astype(np.int64), high - 1)
    key = pencil * columns + column
    order = np.argsort(key, kind="stable")
    count = high ** (d - 1)
    start = np.zeros(count * columns + 1, np.int64)
    np.cumsum(np.bincount(key, minlength=count * columns), out=start[1:])
    begins = start[::columns]  # of each pencil, and the end
    groups = -(-np.diff(begins) // lanes)
    before = np.concatenate([[0], np.cumsum(groups)])
    owner = np.repeat(np.arange(count), groups)
    first = begins[owner] + (np.arange(len(owner)) - before[owner]) * lanes
    last = np.minimum(first + lanes, begins[owner + 1]) - 1
    sorted_pencil = pencil[order]
    slot = np.arange(n) - begins[sorted_pencil] + before[sorted_pencil] * lanes

    low, top = column[order[first]], column[order[last]]
    at = (
        np.stack(np.unravel_index(owner, (high,) * (d - 1))) if d > 1 else np.empty((0, len(owner)), np.int64)
    )
    listed = []
    spread = math.ceil(reach * high)
    for offset in product(range(-spread, spread + 1), repeat=d - 1):
        gap = sum((max(abs(o) - 1, 0) / high) ** 2 for o in offset)
        if gap >= reach**2:
            continue
        away = math.floor(math.sqrt(reach**2 - gap) * columns) + 1
        beside = at + np.array(offset, np.int64).reshape(-1, 1)
        inside = ((beside >= 0) & (beside < high)).all(axis=0)
        row = np.zeros(len(owner), np.int64)
        for axis in beside:
            row = row * high + np.clip(axis, 0, high - 1)
        begin = start[row * columns + np.maximum(low - away, 0)]
        end = start[row * columns + np.minimum(top + away, columns - 1) + 1]
        listed.append(np.stack([begin, np.where(inside, end, begin)], axis=1))
    return Runs(order, first, slot, np.stack(listed, axis=1))
