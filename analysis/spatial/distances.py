"""Nearest-neighbour distances on the torus over the densest lattice's (Lagae & Dutré 2008; PSA)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from gbnbench.analysis.spatial.slabs import WHOLE, WIDEST, Progress, slab, slabs
from gbnbench.core.errors import RefusalError
from gbnbench.core.sides import Sides, as_sides, positions
from gbnbench.core.torus import (
    HERMITE,
    FloatArray,
    as_realizations,
    densest_spacing,
    displacement,
    spacing,
)

NEAR = 1e-9  # box sides; a distance below which the tree's rounding may exceed 1e-7 of it
CANDIDATES = 8  # of a near point at first; four times as many where the last may still be the nearest
ROUNDED = 2.0**-50  # box sides; what the tree's distances may be off by on one axis
BLOCK = 2**20  # candidates looked at together
AROUND = 8.0  # spacings around a slab; where a nearest neighbour is farther, it is looked for in more


def nearest_distances(
    x: ArrayLike, sides: ArrayLike | None = None, *, progress: Progress | None = None
) -> FloatArray:
    """Distance from each point to its nearest neighbour on the torus, in densest spacings.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, n >= 2, d <= 24.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.
    progress : callable, optional
        Called now and then with the share done, of sets of more than ``slabs.WHOLE`` points.

    Returns
    -------
    (realizations, n) float64
        Over ``torus.densest_spacing(n, d)``; 1 for every point of the densest lattice.

    Raises
    ------
    InputError
        If sides are not d lengths.
    RefusalError
        If n = 1, or d > 24, where no densest lattice is tabulated; from d = 9 on it is the densest known.

    Notes
    -----
    A k-d tree names candidates. Larger sets have a tree for each slab and what lies around it, so that memory
    does not grow with n beyond the result. The distances are the same bits, unless several neighbours are
    equally near up to rounding, of which either tree may name another.
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    lengths = as_sides(sides, d)
    unit = densest_spacing(n, d)
    if math.isnan(unit):
        raise RefusalError(
            f"distances are in spacings of the densest lattice, here for d <= {len(HERMITE)}; got d={d}"
        )
    if n < 2:
        raise RefusalError("a distance between points needs n >= 2; got n=1")
    cut = n > WHOLE
    each = [_in_slabs(points, lengths, progress) if cut else _nearest(points, lengths) for points in sets]
    return np.array(each) / unit


def _nearest(points: FloatArray, sides: Sides | None, of: NDArray[np.intp] | None = None) -> FloatArray:
    """Distance from each point, or from some, to its nearest neighbour, in box sides."""
    box = np.ones(points.shape[1]) if sides is None else np.array(sides)
    rows = np.arange(len(points)) if of is None else of
    return _by_tree(points, positions(points, sides), box, box, rows)


def _in_slabs(points: FloatArray, sides: Sides | None, progress: Progress | None) -> FloatArray:
    """Distance from each point to its nearest neighbour, slab by slab: (n,)."""
    n, d = points.shape
    box = np.ones(d) if sides is None else np.array(sides)
    open_box = np.concatenate([[0.0], box[1:]])  # a slab does not close around the first axis
    found = np.empty(n)
    for part in slabs(points, AROUND * spacing(n, d) / box[0], progress):
        while True:
            placed = positions(part.points, sides)
            placed = placed + part.turns[:, None] * np.eye(d)[0] * box[0]
            own = np.arange(len(part.rows))
            nearest = _by_tree(part.points, placed, box, open_box, own)
            if (nearest < part.around * box[0] * (1 - ROUNDED)).all():
                break
            wider = 4 * part.around
            if part.high - part.low + 2 * wider > WIDEST:
                nearest = _nearest(points, sides, part.rows)
                break
            part = slab(points, part.low, part.high, wider)
        found[part.rows] = nearest
    return found


def _by_tree(
    points: FloatArray, placed: FloatArray, box: FloatArray, periods: FloatArray, of: NDArray[np.intp]
) -> FloatArray:
    """Distance from some points to their nearest neighbours, in box sides: as many.

    The tree's own distances are rounded to 1e-16 of the box where the neighbour lies across the border, so
    it only names candidates; more of them where that rounding might hide which is the nearest.
    """
    n, d = points.shape
    if n < 2:
        return np.full(len(of), np.inf)
    tree = cKDTree(placed, boxsize=periods)
    nearest = _shortest(points, box, of, np.asarray(tree.query(placed[of], k=2)[1]))
    near = np.flatnonzero(nearest < NEAR)
    count = min(n, CANDIDATES)
    while len(near):
        unsure = []
        for block in np.array_split(near, math.ceil(len(near) * count / BLOCK)):
            told, candidates = tree.query(placed[of[block]], k=count)
            nearest[block] = _shortest(points, box, of[block], np.asarray(candidates))
            # Coincident points are nearest of all, however many.
            beyond = np.asarray(told)[:, -1] > nearest[block] + ROUNDED * math.sqrt(d) * box.max()
            unsure.append(block[~beyond & (nearest[block] > 0)])
        near = np.concatenate(unsure) if count < n else near[:0]
        count = min(n, 4 * count)
    return nearest


def _shortest(
    points: FloatArray, box: FloatArray, of: NDArray[np.intp], candidates: NDArray[np.intp]
) -> FloatArray:
    """Shortest distance from each of some points to its candidates, itself left out."""
    between = displacement(points[candidates], points[of][:, None]) * box
    distance = np.sqrt(np.sum(between**2, axis=-1))
    distance[candidates == of[:, None]] = np.inf
    return np.asarray(distance.min(axis=1))


def min_distance(x: ArrayLike, sides: ArrayLike | None = None) -> FloatArray:
    """Smallest toroidal distance between two points of each set, in densest spacings.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, n >= 2, d <= 24.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    (realizations,) float64
        The relative radius of Lagae & Dutré (2008): min over i != j of |x_i - x_j| / densest_spacing(n, d).

    Raises
    ------
    InputError
        As ``nearest_distances``.
    """
    return np.asarray(nearest_distances(x, sides).min(axis=1))


def mean_distance(x: ArrayLike, sides: ArrayLike | None = None) -> FloatArray:
    """Mean toroidal distance to the nearest neighbour of each set, in densest spacings.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, n >= 2, d <= 24.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    (realizations,) float64
        (1/n) sum over i of min over j of |x_i - x_j| / densest_spacing(n, d), as in PSA (Schlömer & Deussen
        2011).

    Raises
    ------
    InputError
        As ``nearest_distances``.
    """
    return np.asarray(nearest_distances(x, sides).mean(axis=1))
