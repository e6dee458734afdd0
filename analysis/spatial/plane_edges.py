"""Edges of a triangulated torus that are Delaunay's, told by signs that are certain.

An edge is one if the corner beyond it lies outside the circle of the triangle before it. The determinant that
says so is taken in doubles with a bound of its rounding (Shewchuk 1997), and in integers where the bound does
not decide. A corner on the circle, up to what rounding of the coordinates makes of cocircular points, makes
the edge a tie: its Voronoi edge has no length.

References
----------
Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
Computational Geometry 18, 1997.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spatial.exact_plane import ExactPlane, Image, cross
from gbnbench.analysis.spatial.plane_rings import IndexArray, Rings
from gbnbench.core.torus import FloatArray

# Shewchuk's bounds are 4 and 10 units for coordinates rounded once; here they are rounded three times.
CROSS_ERROR = 10 * 2.0**-53
CIRCLE_ERROR = 32 * 2.0**-53
LEAST = 1e-290  # below which products lose digits to underflow
# By how much a point may be off its place: a shift of the set rounds coordinates, and a file has ten digits.
ROUNDED = 2.0**-50  # of a side
PRINTED = 1e-9  # of the distance to the nearest neighbour


class EdgeCheck:
    """Certain signs of the edges and corners of rings.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.
    box : (2,) float64
        Sides of the torus.
    """

    def __init__(self, x: FloatArray, box: FloatArray) -> None:
        self.x, self.box = x, box

    @cached_property
    def plane(self) -> ExactPlane:
        """The points as integers, which most sets never need."""
        return ExactPlane(self.x, self.box)

    def corners_turn_left(self, rings: Rings) -> bool:
        """Tell whether each edge has the next of its ring to its left, by less than half a turn.

        Parameters
        ----------
        rings : Rings
            Edges of the plane.

        Returns
        -------
        bool
        """
        a, b = rings.vector, rings.vector[rings.following]
        one, two = a[:, 0] * b[:, 1], a[:, 1] * b[:, 0]
        turn, error = one - two, CROSS_ERROR * (np.abs(one) + np.abs(two)) + LEAST
        if (turn < -error).any():
            return False
        link = image_of(rings)
        for row in np.flatnonzero(turn <= error).tolist():
            point, after = int(rings.point[row]), int(rings.following[row])
            if cross(self.plane.vector(point, link(row)), self.plane.vector(point, link(after))) <= 0:
                return False
        return True

    def edges(self, rings: Rings) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Sort edges of a triangulation in those of no length, and those that are not Delaunay's.

        Parameters
        ----------
        rings : Rings
            Closed, with triangles between consecutive edges.

        Returns
        -------
        tie : (m,) bool
            The four corners beside the edge lie on one circle, up to rounding.
        wrong : (m,) bool
            The corner beyond is inside the circle.
        """
        twin = rings.twin
        rows = np.flatnonzero(twin < np.arange(len(twin)))  # each edge once
        outside, error, most = self._circles(rings, rows)
        unclear = np.flatnonzero((np.abs(outside) <= error) & (np.abs(outside) + error > most))
        link = image_of(rings)
        for k in unclear.tolist():
            row = int(rows[k])
            point, beside = int(rings.point[row]), (int(rings.preceding[row]), row, int(rings.following[row]))
            a, b, c = (self.plane.vector(point, link(each)) for each in beside)
            outside[k] = self.plane.rounded(self.plane.outside(a, b, c))
        tie, wrong = np.zeros((2, len(twin)), dtype=np.bool_)
        tie[rows] = np.abs(outside) <= most
        wrong[rows] = ~tie[rows] & (outside < 0)
        paired = rows[twin[rows] >= 0]
        tie[twin[paired]], wrong[twin[paired]] = tie[paired], wrong[paired]
        return tie, wrong

    def _circles(self, rings: Rings, rows: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return determinants of some edges, bounds of their errors, and what moving the corners may give."""
        before, after = rings.preceding[rows], rings.following[rows]
        (ax, ay), (bx, by), (cx, cy) = (rings.vector[each].T for each in (before, rows, after))
        aa, bb, cc = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
        outside, error, area = np.zeros(len(rows)), np.full(len(rows), LEAST), []
        for square, ux, uy, vx, vy in ((aa, bx, by, cx, cy), (bb, cx, cy, ax, ay), (cc, ax, ay, bx, by)):
            one, two = ux * vy, uy * vx
            outside += square * (one - two)
            error += square * (np.abs(one) + np.abs(two)) * CIRCLE_ERROR
            area.append(one - two)
        off = PRINTED * rings.nearest + ROUNDED * self.box.max()
        opposite = np.abs(sum(area)) * off[rings.point[rows]]
        for each, far in zip(area, (before, rows, after), strict=True):
            opposite += np.abs(each) * off[rings.index[far]]
        # Circumradii of both triangles, alike where there is a tie: the determinant is an area times
        # (distance^2 - radius^2), whose slope is 2 radius.
        with np.errstate(divide="ignore", invalid="ignore"):
            first = np.sqrt(aa * bb * ((bx - ax) ** 2 + (by - ay) ** 2)) / np.abs(area[2])
            second = np.sqrt(bb * cc * ((cx - bx) ** 2 + (cy - by) ** 2)) / np.abs(area[0])
        return outside, error, np.fmin(first, second) * opposite


def image_of(rings: Rings) -> Callable[[int], Image]:
    """Return the function that gives the end of an edge, by its row, in Python's integers."""

    def image(row: int) -> Image:
        return int(rings.index[row]), int(rings.turn[row, 0]), int(rings.turn[row, 1])

    return image
