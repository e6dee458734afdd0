"""The toroidal triangulation against empty circles, and the farthest point against a dense search."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.fpo.triangulation import WIDEST, circumcircles, farthest_point, triangulate


def nearest(x: FloatArray, places: FloatArray) -> FloatArray:
    return np.asarray(cKDTree(x, boxsize=[1.0, 1.0]).query(places)[0])


def test_circumcircle_of_a_right_triangle_is_centred_on_its_hypotenuse():
    a, b, c = np.array([[[1.0, 1.0]], [[4.0, 1.0]], [[1.0, 5.0]]])
    centre, squared = circumcircles(a, b, c)
    np.testing.assert_allclose(centre, [[2.5, 3.0]], rtol=1e-15)
    np.testing.assert_allclose(squared, [6.25], rtol=1e-15)
    assert circumcircles(a, b, b)[1] == np.inf


@pytest.mark.parametrize(
    ("shape", "scale"),
    [
        ((1, 2), 1.0),
        ((2, 2), 1.0),
        ((7, 2), 1.0),
        ((150, 2), 1.0),
        ((150, 2), (1.0, 0.0)),
        ((80, 2), (0.02, 0.3)),
    ],
)
def test_farthest_point_is_farther_than_a_dense_grid(shape: tuple[int, int], scale: float):
    x = wrap(0.4 + (np.random.default_rng(5).random(shape) - 0.5) * scale)
    grid = (np.stack(np.meshgrid(*[np.arange(256)] * 2), axis=-1).reshape(-1, 2) + 0.5) / 256
    centre, radius = farthest_point(x)
    assert nearest(x, centre[None])[0] == pytest.approx(radius, abs=1e-14)
    best_on_grid = nearest(x, grid).max()
    assert best_on_grid <= radius + 1e-14
    assert radius - best_on_grid < 2**-0.5 / 256  # half the diagonal of a grid cell


@pytest.mark.parametrize("n", [64, 500])
def test_triangulation_is_closed_and_its_circles_are_empty(n: int):
    x = np.random.default_rng(1).random((n, 2))
    found = triangulate(x)
    assert found is not None
    edges = np.flatnonzero(found.origin >= 0)
    assert len(edges) == 6 * n  # 2 n triangles and 3 n edges: V - E + F = 0
    following = np.where(edges % 4 == 2, edges - 2, edges + 1)
    np.testing.assert_array_equal(found.twin[found.twin[edges]], edges)
    np.testing.assert_array_equal(found.origin[found.twin[edges]], found.origin[following])
    np.testing.assert_array_equal(found.origin[found.leaving], np.arange(n))
    np.testing.assert_allclose(nearest(x, found.centre), np.sqrt(found.squared_radius), atol=1e-13)


def test_triangulation_is_refused_where_gaps_are_wide():
    x = np.random.default_rng(2).random((200, 2))
    hole = np.sum((x - 0.5) ** 2, axis=1) > (1.1 * WIDEST) ** 2
    assert triangulate(x) is not None
    assert triangulate(x[hole]) is None
    assert triangulate(np.stack([np.arange(9) / 9, np.full(9, 0.5)], axis=1)) is None
