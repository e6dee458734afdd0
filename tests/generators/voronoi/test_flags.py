"""Cells summed over flags against cells cut along their faces, and circumcentres against their distances."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.periodic_delaunay import triangulation, with_images
from gbnbench.generators.voronoi.cell_simplices import face_fans
from gbnbench.generators.voronoi.cells import _moments
from gbnbench.generators.voronoi.flags import cell_moments, circumcentres, flattest


@pytest.mark.parametrize(("k", "d"), [(1, 2), (2, 2), (2, 3), (3, 3), (2, 4), (3, 4), (4, 4)])
def test_circumcentres_are_as_far_from_every_corner_and_in_the_plane(k: int, d: int) -> None:
    corners = np.random.default_rng(k + d).random((50, k + 1, d))
    centre = circumcentres(corners)
    distance = np.linalg.norm(corners - centre[:, None], axis=2)
    assert np.allclose(distance, distance[:, :1], rtol=1e-9)
    sides = corners[:, 1:] - corners[:, :1]
    for side, arm in zip(sides, centre - corners[:, 0], strict=True):
        assert np.linalg.lstsq(side.T, arm, rcond=None)[0] @ side == pytest.approx(arm, rel=1e-8, abs=1e-10)


def test_flat_simplices_are_told_from_regular_ones() -> None:
    square = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]])
    cube = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]])
    assert flattest(square) == 0
    assert flattest(cube) == pytest.approx(1)
    assert flattest(np.concatenate([square, cube])) == 0


def test_sums_over_flags_are_those_of_cells_cut_along_their_faces() -> None:
    x = np.random.default_rng(8).random((60, 3))
    fans = face_fans(x, 1.0)
    assert fans is not None
    faces = _moments(x, *fans)
    tiled, _ = with_images(x, 1.0)
    mesh = triangulation(tiled)
    assert mesh is not None
    simplices = mesh.simplices[(mesh.simplices < 60).any(axis=1)].astype(np.intp)
    volume, first, second = cell_moments(tiled, simplices, 60)
    assert np.allclose(volume, faces.volume, rtol=1e-11)
    assert np.allclose(first, faces.offset * faces.volume[:, None], rtol=0, atol=1e-13)
    assert np.allclose(second, faces.energy, rtol=1e-11)
