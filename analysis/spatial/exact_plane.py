"""Points of a torus in the plane as integers: turns to the left, and circles that hold a point."""

from __future__ import annotations

import math

from gbnbench.core.torus import FloatArray

Image = tuple[int, int, int]  # a point, and the whole sides by which it is moved
Vector = tuple[int, int]


class ExactPlane:
    """Exact geometry of points whose coordinates are doubles.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.
    box : (2,) float64
        Sides of the torus, taken to be just these doubles.

    Notes
    -----
    Coordinates are fractions of the sides in units of one power of two, so that differences are integers and
    the sides enter as weights of their squares.
    """

    def __init__(self, x: FloatArray, box: FloatArray) -> None:
        ratios: list[tuple[int, int]] = [value.as_integer_ratio() for value in x.ravel().tolist()]
        self.unit: int = max(below for _, below in ratios)  # powers of two all
        self.points: list[int] = [above * (self.unit // below) for above, below in ratios]
        sides: list[tuple[int, int]] = [side.as_integer_ratio() for side in box.tolist()]
        part = max(below for _, below in sides)
        self.weight: list[int] = [(above * (part // below)) ** 2 for above, below in sides]
        # A determinant of circles is of degree four in the coordinates: two in a square, two in an area.
        self.scale: int = self.unit**4 * part**2
        self.area: float = math.prod(box.tolist())

    def vector(self, point: int, image: Image) -> Vector:
        """Take the vector from a point to an image.

        Parameters
        ----------
        point : int
            Where it starts.
        image : Image
            Where it ends.

        Returns
        -------
        Vector
            In fractions of the sides, in units of ``1 / unit``.
        """
        other, right, up = image
        return (
            self.points[2 * other] - self.points[2 * point] + right * self.unit,
            self.points[2 * other + 1] - self.points[2 * point + 1] + up * self.unit,
        )

    def outside(self, a: Vector, b: Vector, c: Vector) -> int:
        """Tell on which side of a circle a point is.

        Parameters
        ----------
        a, b : Vector
            Points of the circle, which passes the origin too; b lies to the left of a.
        c : Vector
            The point.

        Returns
        -------
        int
            Positive outside, negative inside, 0 on the circle.
        """
        east, north = self.weight
        aa = east * a[0] * a[0] + north * a[1] * a[1]
        bb = east * b[0] * b[0] + north * b[1] * b[1]
        cc = east * c[0] * c[0] + north * c[1] * c[1]
        return aa * cross(b, c) + bb * cross(c, a) + cc * cross(a, b)

    def rounded(self, outside: int) -> float:
        """Round what ``outside`` returns to a double, in lengths to the fourth."""
        return outside / self.scale * self.area


def cross(a: Vector, b: Vector) -> int:
    """Cross product.

    Parameters
    ----------
    a, b : Vector
        In one unit.

    Returns
    -------
    int
        Positive where b lies to the left of a.
    """
    return a[0] * b[1] - a[1] * b[0]
