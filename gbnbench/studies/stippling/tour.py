"""Plotter tours: points along a Hilbert curve, the path shortened by 2-opt over near neighbours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.hilbert_start import hilbert_index

NEIGHBOURS = 8  # tried for each point
CELLS = 1 << 15  # of the curve along the longer side
MOST_ROUNDS = 400
SLACK = 1e-9  # of the mean step, which a move has to gain


def tour(points: FloatArray) -> NDArray[np.intp]:
    """Find a short open path through all points.

    Parameters
    ----------
    points : (n, 2) float64
        In any unit.

    Returns
    -------
    (n,) int
        Their order. It starts and ends where the curve does, near the upper corners.

    Notes
    -----
    A move of 2-opt takes two steps out of the path and turns round what lies between. A round finds all moves
    that gain, to one of the eight nearest neighbours, and does those that do not touch one another, the best
    first. It ends when no move gains, or after 400 rounds.
    """
    from scipy.spatial import cKDTree

    n = len(points)
    low, span = points.min(axis=0), float(np.ptp(points, axis=0).max()) or 1.0
    cells = np.minimum((points - low) / span * CELLS, CELLS - 1).astype(np.intp)
    order = np.argsort(hilbert_index(cells), kind="stable").astype(np.intp)
    if n < 4:
        return order
    _, found = cKDTree(points).query(points, k=min(NEIGHBOURS + 1, n))
    near = np.asarray(found, np.intp)[:, 1:]
    least = SLACK * path_length(points[order]) / n
    for _ in range(MOST_ROUNDS):
        moves = _gaining_moves(points, order, near, least)
        if len(moves) == 0:
            break
        touched = np.zeros(n, np.bool_)
        for first, last in moves:  # turn round order[first:last + 1]
            if not touched[max(first - 1, 0) : last + 2].any():
                touched[max(first - 1, 0) : last + 2] = True
                order[first : last + 1] = order[first : last + 1][::-1]
    return order


def path_length(points: FloatArray) -> float:
    """Length of the path through points in their order, in their unit."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _gaining_moves(
    points: FloatArray, order: NDArray[np.intp], near: NDArray[np.intp], least: float
) -> NDArray[np.intp]:
    """First and last places of stretches whose turning shortens the path, the best gain first."""
    n, k = near.shape
    place = np.empty(n, np.intp)
    place[order] = np.arange(n)
    i = np.repeat(np.arange(n), k)
    j = place[near[order]].ravel()
    found = []
    for step in (1, -1):  # the new step joins i and j, and i + step and j + step
        both = (j > i) if step == 1 else (j < i)
        a, b = i[both], j[both]
        a2, b2 = a + step, b + step
        inside = (a2 >= 0) & (b2 >= 0) & (a2 < n) & (b2 < n)
        a, b, a2, b2 = a[inside], b[inside], a2[inside], b2[inside]
        at = points[order]
        gain = _apart(at, a, a2) + _apart(at, b, b2) - _apart(at, a, b) - _apart(at, a2, b2)
        good = gain > least
        first = np.minimum(a, b)[good] + (step == 1)
        last = np.maximum(a, b)[good] - (step == -1)
        found.append(np.column_stack([gain[good], first, last]))
    moves = np.concatenate(found)
    best = moves[np.argsort(-moves[:, 0], kind="stable")]
    return best[:, 1:].astype(np.intp)


def _apart(at: FloatArray, one: NDArray[np.intp], other: NDArray[np.intp]) -> FloatArray:
    gap = at[one] - at[other]
    apart: FloatArray = np.sqrt((gap * gap).sum(axis=1))
    return apart
