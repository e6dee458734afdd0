"""Neighbours around each point of a torus in the plane, as rings in counterclockwise order."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.double_double import two_sum
from gbnbench.core.torus import FloatArray

IndexArray = NDArray[np.intp]


@dataclass(frozen=True)
class Rings:
    """Directed edges from the points of a set, sorted by point and, in the plane, by angle.

    Attributes
    ----------
    indptr : (n + 1,) intp
        Point i owns rows ``indptr[i]:indptr[i + 1]`` of the others.
    point : (m,) intp
        Start of each edge.
    index : (m,) intp
        The point of which the end is an image.
    turn : (m, d) intp
        Whole sides by which that image is moved.
    vector : (m, d) float64
        From start to end, each coordinate good to 2^-51 of itself.
    """

    indptr: IndexArray
    point: IndexArray
    index: IndexArray
    turn: IndexArray
    vector: FloatArray

    @cached_property
    def following(self) -> IndexArray:
        """Row of the next edge in each ring: (m,)."""
        rows = np.arange(1, len(self.point) + 1, dtype=np.intp)
        rows[self.indptr[1:] - 1] = self.indptr[:-1]
        return rows

    @cached_property
    def preceding(self) -> IndexArray:
        """Row of the edge before in each ring: (m,)."""
        rows = np.empty_like(self.following)
        rows[self.following] = np.arange(len(rows))
        return rows

    @cached_property
    def nearest(self) -> FloatArray:
        """Length of the shortest edge of each point: (n,)."""
        square = np.sum(self.vector**2, axis=1)
        return np.asarray(np.sqrt(np.minimum.reduceat(square, self.indptr[:-1])))

    def of(self, keep: NDArray[np.bool_]) -> Rings:
        """Rings of the edges to keep; each point must keep one."""
        point = self.point[keep]
        count = np.bincount(point, minlength=len(self.indptr) - 1)
        return Rings(starts(count), point, self.index[keep], self.turn[keep], self.vector[keep])

    @cached_property
    def twin(self) -> IndexArray:
        """Row of the same edge seen from its other end, -1 where that end does not have it: (m,)."""
        n, turn = len(self.indptr) - 1, self.turn
        reach = np.abs(turn).max(axis=0)
        code, back = (_number(each + reach, 2 * reach + 1) for each in (turn, -turn))
        codes = int(np.prod(2 * reach + 1))
        if codes >= 2**62 // n**2:  # only few of so many turns occur
            codes, small = _relabelled(np.concatenate([code, back]))
            code, back = small[: len(code)], small[len(code) :]
        there = (self.point * n + self.index) * codes + code
        here = (self.index * n + self.point) * codes + back
        rows = np.full(len(self.point), -1, dtype=np.intp)
        up, down, same = (
            np.flatnonzero(each)
            for each in (self.point < self.index, self.point > self.index, self.point == self.index)
        )
        for ours, theirs in ((up, down), (same, same)):
            one, other = _alike(there[ours], here[theirs])
            rows[ours[one]], rows[theirs[other]] = theirs[other], ours[one]
        return rows


def in_rings(
    x: FloatArray, box: FloatArray, point: IndexArray, index: IndexArray, turn: IndexArray
) -> tuple[Rings, IndexArray]:
    """Sort edges of the plane in rings.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.
    box : (2,) float64
        Sides of the torus.
    point, index : (m,) intp
        Start and end of each edge.
    turn : (m, 2) intp
        Whole sides by which the end is moved.

    Returns
    -------
    rings : Rings
        Each begins at the negative first axis.
    order : (m,) intp
        Which of the given edges each row is.
    """
    vector = edge_vectors(x, box, point, index, turn)
    order = _by_angle(point, np.arctan2(vector[:, 1], vector[:, 0]))
    count = np.bincount(point, minlength=len(x))
    return Rings(starts(count), point[order], index[order], turn[order], vector[order]), order


def edge_vectors(
    x: FloatArray, box: FloatArray, point: IndexArray, index: IndexArray, turn: IndexArray
) -> FloatArray:
    """Vectors of edges, of which near neighbours across the border lose no digit.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    box : (d,) float64
        Sides of the torus.
    point, index : (m,) intp
        Start and end of each edge.
    turn : (m, d) intp
        Whole sides by which the end is moved.

    Returns
    -------
    (m, d) float64
        Each coordinate good to 2^-51 of itself.
    """
    difference, rest = two_sum(x[index], -x[point])
    vector: FloatArray = ((difference + turn) + rest) * box
    return vector


def starts(count: IndexArray) -> IndexArray:
    """Rows at which groups of so many rows begin, and the end: (n,) -> (n + 1,)."""
    return np.concatenate([[0], np.cumsum(count)]).astype(np.intp)


def _by_angle(point: IndexArray, angle: FloatArray) -> IndexArray:
    """Sort by point, then by angle: at once in one number where the angle's leading bits decide."""
    steps = 2.0 ** (61 - int(point.max(initial=0)).bit_length())
    key = point * int(steps) + ((angle / (2 * np.pi) + 0.5) * (steps / 2)).astype(np.intp)
    order = np.argsort(key)
    if (np.diff(key[order]) > 0).all():
        return order
    return np.lexsort((angle, point))


def _alike(a: IndexArray, b: IndexArray) -> tuple[IndexArray, IndexArray]:
    """Places of the numbers that occur in both, each once: a[first] == b[second]."""
    first, second = np.argsort(a), np.argsort(b)
    if len(a) != len(b) or (a[first] != b[second]).any():
        _, first, second = np.intersect1d(a, b, assume_unique=True, return_indices=True)
    return first, second


def _number(turn: IndexArray, sizes: IndexArray) -> IndexArray:
    """Write the digits of each row as one number."""
    value = turn[:, 0]
    for axis in range(1, turn.shape[1]):
        value = value * sizes[axis] + turn[:, axis]
    return value


def _relabelled(values: IndexArray) -> tuple[int, IndexArray]:
    distinct, place = np.unique(values, return_inverse=True)
    return len(distinct), place.astype(np.intp).reshape(-1)
