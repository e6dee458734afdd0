"""Periodic Delaunay neighbours against empty circles and the Voronoi cells of the whole tiling."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.analysis.spatial.delaunay import Neighbours, neighbours, plane_neighbours
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import wrap
from tests.oracles.lattices import grid
from tests.oracles.neighbours import by_empty_circles, by_voronoi, rounded


def by_point(made: Neighbours) -> list[list[tuple[float, ...]]]:
    return [rounded(part) for part in np.split(made.vector, made.indptr[1:-1])]


@pytest.mark.parametrize("n", [2, 3, 4, 7])
def test_few_points_against_empty_circles(n: int) -> None:
    x = np.random.default_rng(n).random((n, 2))
    assert by_point(neighbours(x)[0]) == by_empty_circles(x)


@pytest.mark.parametrize("n", [5, 20, 300])
def test_against_voronoi_of_the_whole_tiling(n: int) -> None:
    x = np.random.default_rng(n).random((n, 2))
    assert by_point(neighbours(x)[0]) == by_voronoi(x, 1 if n > 10 else 2)


def test_clustered_points_need_and_get_a_wide_border() -> None:
    x = wrap(0.95 + 0.08 * np.random.default_rng(1).random((120, 2)))
    assert by_point(neighbours(x)[0]) == by_voronoi(x, 2)


@pytest.mark.parametrize("n", [2, 3, 12, 150])
def test_space_against_voronoi_of_the_whole_tiling(n: int) -> None:
    x = np.random.default_rng(n).random((n, 3))
    assert by_point(neighbours(x)[0]) == by_voronoi(x, 1 if n > 100 else 2)


def test_cycles_turn_once_and_lead_to_their_points() -> None:
    x = np.random.default_rng(3).random((200, 2))
    made = neighbours(x)[0]
    owner = np.repeat(np.arange(200), made.degree)
    away = x[owner] + made.vector - x[made.index]
    assert np.abs(away - np.rint(away)).max() < 1e-12
    for part in np.split(made.vector, made.indptr[1:-1]):
        z = part @ [1, 1j]
        turns = np.angle(np.roll(z, -1) / z)
        assert (turns > 0).all()
        assert turns.sum() == pytest.approx(2 * math.pi)


@pytest.mark.parametrize("shift", [0.0, 0.1, 1 / 3])
@pytest.mark.parametrize(("m", "d"), [(1, 2), (2, 2), (13, 2), (32, 2), (1, 3), (5, 3)])
def test_grid_counts_no_diagonal(m: int, d: int, shift: float) -> None:
    made = neighbours(wrap(grid(m, d) + shift))[0]
    assert made.degree.tolist() == [2 * d] * m**d
    np.testing.assert_allclose(np.abs(made.vector).sum(axis=1), 1 / m)


def test_one_point_is_its_own_neighbour() -> None:
    made = neighbours([[0.3, 0.7]])[0]
    assert made.index.tolist() == [0, 0, 0, 0]
    assert rounded(made.vector) == [(-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (1.0, 0.0)]


def test_points_on_a_line() -> None:
    y = np.array([0.05, 0.2, 0.3, 0.7])
    made = neighbours(np.column_stack([np.full(4, 0.4), y]))[0]
    assert made.degree.tolist() == [4, 4, 4, 4]


@pytest.mark.slow
def test_points_in_a_plane_of_space_have_prisms_as_cells() -> None:
    x = np.random.default_rng(8).random((60, 3))
    x[:, 2] = 0.2
    made = neighbours(x)[0]
    assert made.degree.tolist() == (neighbours(x[:, :2])[0].degree + 2).tolist()


@pytest.mark.parametrize(
    ("cell", "degree"),
    [
        ([(0, 0, 0), (0.5, 0.5, 0.5)], 14),  # body centred: truncated octahedra
        ([(0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5)], 12),  # face centred: rhombic dodecahedra
    ],
)
def test_cubic_lattices(cell: list[tuple[float, float, float]], degree: int) -> None:
    x = wrap((grid(3, 3)[:, None] + np.array(cell) / 3).reshape(-1, 3) + 0.01)
    assert set(neighbours(x)[0].degree.tolist()) == {degree}


def test_refusals_name_the_reason() -> None:
    x = np.random.default_rng(6).random((50, 2))
    with pytest.raises(RefusalError, match="distinct"):
        neighbours(np.concatenate([x, x[:1]]))
    with pytest.raises(RefusalError, match="d = 1"):
        neighbours(x[:, :1])
    with pytest.raises(RefusalError, match="d=4"):
        neighbours(np.random.default_rng(7).random((50, 4)))
    with pytest.raises(RefusalError, match="too near"):
        neighbours(0.5 + 1e-9 * np.random.default_rng(7).random((50, 2)))
    with pytest.raises(RefusalError, match="d=3"):
        plane_neighbours(np.random.default_rng(7).random((50, 3)), "psi6")


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(1, 80), st.sampled_from([2, 3]))
def test_neighbours_do_not_know_the_origin_or_the_order(seed: int, n: int, d: int) -> None:
    rng = np.random.default_rng(seed)
    x = np.round(rng.random((n, d)), 6) % 1  # room for a shift without rounding into another triangulation
    order = rng.permutation(n)
    one, two = by_point(neighbours(x)[0]), by_point(neighbours(wrap(x + rng.random(d))[order])[0])
    assert [len(part) for part in two] == [len(one[k]) for k in order]
    for part, k in zip(two, order, strict=True):
        np.testing.assert_allclose(
            sorted(np.linalg.norm(part, axis=1)), sorted(np.linalg.norm(one[k], axis=1))
        )
