"""Moments of Voronoi cells from Delaunay simplices by right-angled simplices (Schläfli)."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray


def circumcentres(corners: FloatArray) -> FloatArray:
    """Circumcentres of simplices within their own planes, of any number of corners.

    Parameters
    ----------
    corners : (m, k, d) float64
        Corners of m simplices, 1 <= k <= d + 1.

    Returns
    -------
    (m, d) float64
        Points at one distance from all corners of a simplex, in its plane.

    Raises
    ------
    numpy.linalg.LinAlgError
        If a simplex is flat.
    """
    sides = corners[:, 1:] - corners[:, :1]
    squares = np.einsum("mia,mia->mi", sides, sides)
    k, d = sides.shape[1:]
    if k == d:  # without the Gram matrix, whose condition is the square of this one's
        return np.asarray(corners[:, 0] + np.linalg.solve(2 * sides, squares[:, :, None])[:, :, 0])
    gram = np.einsum("mia,mja->mij", sides, sides)
    if k == 1:
        share = np.full((len(corners), 1), 0.5)
    elif k == 2:
        product, det = gram[:, 0, 1], gram[:, 0, 0] * gram[:, 1, 1] - gram[:, 0, 1] ** 2
        share = (squares[:, ::-1] * (squares - product[:, None])) / (2 * det)[:, None]
    else:
        share = np.linalg.solve(2 * gram, squares[:, :, None])[:, :, 0]
    return np.asarray(corners[:, 0] + np.einsum("mi,mia->ma", share, sides))


def flattest(corners: FloatArray) -> float:
    """Return the least d! volume / side**d of simplices, (m, d + 1, d), by the sides at the first corner."""
    sides = corners[:, 1:] - corners[:, :1]
    longest = np.sqrt(np.einsum("mia,mia->mi", sides, sides).max(axis=1))
    return float(np.min(np.abs(np.linalg.det(sides)) / longest ** sides.shape[1], initial=np.inf))


def cell_moments(
    tiled: FloatArray, simplices: NDArray[np.intp], n: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Sum volume, first and second moment of the Voronoi cells of the first n points.

    Parameters
    ----------
    tiled : (m, d) float64
        Points of space.
    simplices : (s, d + 1) intp
        Their Delaunay simplices; all that touch the first n points must be there.
    n : int
        Points whose cells are wanted.

    Returns
    -------
    volume : (n,) float64
        Volumes of the cells.
    first : (n, d) float64
        Integral of y - x over each cell.
    second : (n,) float64
        Integral of |y - x|**2 over each cell.

    Notes
    -----
    A cell is the signed sum, over the flags of the simplices about its point (point, edge, triangle, ...), of
    the simplices that join the circumcentres along the flag. Each step of such a path is at right angles to
    those before, so that the volume is the product of the steps over d!; a step counts as negative where the
    circumcentre lies on the far side of the face from the corner that is added.
    """
    d = tiled.shape[1]
    corners = tiled[simplices]
    centre: dict[tuple[int, ...], FloatArray] = {(k,): corners[:, k] for k in range(d + 1)}
    for size in range(2, d + 2):
        for face in combinations(range(d + 1), size):
            centre[face] = circumcentres(corners[:, list(face)])
    step: dict[tuple[tuple[int, ...], int], FloatArray] = {}
    for face, place in centre.items():
        for corner in set(range(d + 1)) - set(face):
            path = centre[tuple(sorted((*face, corner)))] - place
            ahead = _dot(path, corners[:, corner] - place)
            step[face, corner] = np.copysign(np.sqrt(_dot(path, path)), ahead)
    volume, first, second = np.zeros(n), np.zeros((n, d)), np.zeros(n)
    for apex in range(d + 1):
        own = np.flatnonzero(simplices[:, apex] < n)
        sums = _Sums(len(own), d)
        arms = {face: place[own] - corners[own, apex] for face, place in centre.items() if apex in face}
        heights = {key: height[own] for key, height in step.items() if apex in key[0]}
        _climb((apex,), heights, arms, (np.ones(len(own)), np.zeros((len(own), d)), np.zeros(len(own))), sums)
        site = simplices[own, apex]
        volume += np.bincount(site, sums.volume, n) / math.factorial(d)
        second += np.bincount(site, sums.second, n) / (math.factorial(d) * (d + 1) * (d + 2))
        for axis in range(d):
            first[:, axis] += np.bincount(site, sums.first[:, axis], n) / math.factorial(d + 1)
    return volume, first, second


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Scalar products of rows: three times as fast as a sum over a short axis."""
    return np.asarray(np.einsum("ma,ma->m", a, b))


class _Sums:
    """Sums over the flags at one corner of each simplex, before their common factors."""

    def __init__(self, count: int, d: int) -> None:
        self.volume, self.first, self.second = np.zeros(count), np.zeros((count, d)), np.zeros(count)


def _climb(
    face: tuple[int, ...],
    heights: dict[tuple[tuple[int, ...], int], FloatArray],
    arms: dict[tuple[int, ...], FloatArray],
    below: tuple[FloatArray, FloatArray, FloatArray],
    sums: _Sums,
) -> None:
    """Follow all flags from a face upwards; below: product of steps, sum of arms, sum of their squares."""
    product, total, squares = below
    d = total.shape[1]
    if len(face) == d + 1:
        sums.volume += product
        sums.first += product[:, None] * total
        sums.second += product * (squares + _dot(total, total))
        return
    for corner in set(range(d + 1)) - set(face):
        higher = tuple(sorted((*face, corner)))
        arm = arms[higher]
        further = (
            product * heights[face, corner],
            total + arm,
            squares + _dot(arm, arm),
        )
        _climb(higher, heights, arms, further, sums)
