"""Images of points on the torus, circumcentres, and the certificate that a margin suffices."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.periodic_delaunay import (
    circumcentre,
    copies,
    overhang,
    triangulation,
    voronoi_diagram,
    with_images,
)
from gbnbench.core.torus import wrap


def test_images_are_those_of_the_full_tiling_within_the_margin():
    x = np.random.default_rng(1).random((40, 3))
    tiled, owner = with_images(x, 0.3)
    shifts = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    full = (x[None] + shifts[:, None]).reshape(-1, 3)
    inside = ((full >= -0.3) & (full < 1.3)).all(axis=1)
    assert sorted(map(tuple, tiled)) == sorted(map(tuple, full[inside]))
    assert np.array_equal(tiled[:40], x)
    assert np.allclose(wrap(tiled), x[owner], atol=1e-15)


def test_copies_repeat_the_set_in_the_order_of_the_shifts():
    x = np.array([[0.25, 0.5], [0.75, 0.0]])
    tiled, owner = copies(x, [(0, 0), (1, -1)])
    assert tiled.tolist() == [[0.25, 0.5], [0.75, 0.0], [1.25, -0.5], [1.75, -1.0]]
    assert owner.tolist() == [0, 1, 0, 1]


def test_overhang_is_how_far_a_ball_sticks_out_of_the_box():
    centre, radius = np.array([[0.5, 0.5], [0.9, 0.25], [0.5, -0.125]]), np.array([0.25, 0.25, 0.5])
    assert overhang(centre[:1], radius[:1]) == -0.25
    assert overhang(centre[:2], radius[:2]) == pytest.approx(0.15)
    assert overhang(centre, radius) == 0.625
    assert overhang(centre[:2], radius[:2], side=0.5) == pytest.approx(0.65)
    assert overhang(centre[:0], radius[:0]) == -np.inf


def test_circumcentres_are_as_far_from_all_corners():
    a, b = np.random.default_rng(2).random((2, 50, 2)) - 0.5
    centre = circumcentre(a, b)
    radius = np.linalg.norm(centre, axis=1)
    np.testing.assert_allclose(np.linalg.norm(centre - a, axis=1), radius, rtol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(centre - b, axis=1), radius, rtol=1e-9)
    assert not np.isfinite(circumcentre(a, 2 * a)).any()


@pytest.mark.parametrize("diagram", [triangulation, voronoi_diagram])
def test_points_on_a_line_have_neither_triangulation_nor_diagram(diagram):
    line = np.stack([np.arange(9) / 9, np.full(9, 0.5)], axis=1)
    assert diagram(line) is None
    assert diagram(np.random.default_rng(3).random((9, 2))) is not None
