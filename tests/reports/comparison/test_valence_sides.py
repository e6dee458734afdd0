"""Voronoi cells of a rectangle, as its picture draws them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.core.sides import as_sides
from gbnbench.reports.comparison.voronoi_cells import cells


def area(polygon: np.ndarray) -> float:
    x, y = polygon.T
    return abs(float(x @ np.roll(y, 1) - y @ np.roll(x, 1))) / 2


@pytest.mark.parametrize("n", [3, 100])
@pytest.mark.parametrize("ratio", [2.0, 0.3, math.sqrt(3)])
def test_cells_of_a_rectangle_have_the_neighbours_that_are_counted(n: int, ratio: float) -> None:
    x = np.random.default_rng(n).random((n, 2))
    sides = as_sides((ratio, 1), 2)
    assert sides is not None
    polygons, degrees = cells(x, sides=sides)
    expected, total = neighbours(x, sides)[0].degree, 0.0
    for polygon, degree in zip(polygons, degrees, strict=True):
        middle = polygon.mean(axis=0)  # a cell is convex and holds it, so its point is the nearest
        if not ((middle >= 0) & (middle < sides)).all():
            continue
        gap = x - middle / sides
        gap -= np.rint(gap)
        assert degree == expected[int(np.argmin(((gap * sides) ** 2).sum(axis=1)))]
        total += area(polygon)
    assert abs(total - 1) < (0.2 if n == 100 else 0.7)  # cells at the border stand inside or outside
