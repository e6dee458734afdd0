"""Slabs of a large set across its first axis, which are worked on one by one with what lies around them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

WHOLE = 1 << 20  # points of the largest set that is not cut
SLAB_POINTS = 1 << 19  # points of a slab of an even set
CUTS = 1 << 16  # places of the first axis where a slab may end
ROWS = 1 << 20  # of the set that are looked at together
WIDEST = 1 - 1e-9  # of a slab with its surroundings, which must not meet themselves around the torus

Progress = Callable[[float], None]


@dataclass(frozen=True)
class Slab:
    """The points of a set whose first coordinate lies in a range, and those within a distance of them.

    Attributes
    ----------
    low, high : float
        Ends of the range, which holds the first.
    around : float
        How far the surroundings reach beyond it on either side, along the first axis.
    rows : (k,) intp
        Rows of the set whose points are the slab's own.
    points : (m, d) float64
        Its own points in this order, then those around it, as they stand in the set.
    turns : (m,) float64
        Whole sides by which a point's first coordinate is to be moved to lie in the slab or beside it.
    """

    low: float
    high: float
    around: float
    rows: NDArray[np.intp]
    points: FloatArray
    turns: FloatArray


def slab_ends(x: FloatArray) -> list[tuple[float, float]]:
    """Cut the first axis in slabs of about ``SLAB_POINTS`` points each, however uneven the set is.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.

    Returns
    -------
    list of (low, high)
        From 0 to 1, each beginning where the one before ends, at multiples of 1 / ``CUTS``.

    Examples
    --------
    >>> slab_ends(np.arange(1 << 20)[:, None] / (1 << 20))
    [(0.0, 0.5), (0.5, 1.0)]
    """
    held = np.zeros(CUTS, np.int64)
    for begin in range(0, len(x), ROWS):
        held += np.bincount((x[begin : begin + ROWS, 0] * CUTS).astype(np.intp), minlength=CUTS)
    before = np.cumsum(held)
    count = -(-len(x) // SLAB_POINTS)
    wanted = np.arange(1, count) * (len(x) / count)
    cuts = np.unique(np.searchsorted(before, wanted) + 1)
    ends = [0, *(int(cut) for cut in cuts if cut < CUTS), CUTS]
    return [(low / CUTS, high / CUTS) for low, high in pairwise(ends)]


def slab(x: FloatArray, low: float, high: float, around: float) -> Slab:
    """Gather a slab and its surroundings, reading the set in blocks.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus; may be mapped from a file.
    low, high : float
        Ends of the slab.
    around : float
        How far the surroundings reach; the whole is at most ``WIDEST`` wide.

    Returns
    -------
    Slab
    """
    rows, own, beside, turns = [], [], [], []
    for begin in range(0, len(x), ROWS):
        block = x[begin : begin + ROWS]
        first = block[:, 0]
        inside = (first >= low) & (first < high)
        rows.append(begin + np.flatnonzero(inside))
        own.append(block[inside])
        if around > 0:
            near = np.flatnonzero(~inside & _within(first, low, high, around))
            beside.append(block[near])
            turns.append(_turns(first[near], low, high))
    zeros = np.zeros(sum(map(len, own)))
    return Slab(
        *(low, high, around, np.concatenate(rows)),
        np.concatenate([*own, *beside]),
        np.concatenate([zeros, *turns]),
    )


def _within(first: FloatArray, low: float, high: float, around: float) -> NDArray[np.bool_]:
    """Tell which coordinates lie at most so far behind the low end or ahead of the high one."""
    ahead, behind = first - high, low - first
    return np.asarray((ahead - np.floor(ahead) < around) | (behind - np.floor(behind) <= around))


def _turns(first: FloatArray, low: float, high: float) -> FloatArray:
    """Whole sides that bring a coordinate outside to the nearer end."""
    middle = (low + high) / 2
    return np.asarray(-np.rint(first - middle))


def slabs(x: FloatArray, around: float, progress: Progress | None = None) -> Iterator[Slab]:
    """Gather one slab of a set after another.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    around : float
        How far the surroundings of each reach.
    progress : callable, optional
        Called with the share done before the first and after each.

    Yields
    ------
    Slab
        Every point of the set is one slab's own; slabs without any are passed over.
    """
    ends = slab_ends(x)
    if progress is not None:
        progress(0.0)
    for k, (low, high) in enumerate(ends):
        made = slab(x, low, high, max(0.0, min(around, (WIDEST - (high - low)) / 2)))
        if len(made.rows):
            yield made
        if progress is not None:
            progress((k + 1) / len(ends))
