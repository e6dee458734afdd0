"""Delaunay neighbours of clusters and lattices against exact integers, in the plane and in space."""

from __future__ import annotations

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.core.errors import RefusalError
from gbnbench.core.sides import as_sides
from gbnbench.core.torus import wrap
from tests.oracles.exact_delaunay import exact_degrees_in_space, exact_neighbours
from tests.oracles.lattices import grid, hexagonal


def cluster(n: int, width: float, seed: int, at: float = 0.4, d: int = 2) -> np.ndarray:
    return wrap(at + width * (np.random.default_rng(seed).random((n, d)) - 0.5))


def thomas(sigma: float, clusters: int = 6, each: int = 6) -> np.ndarray:
    rng = np.random.default_rng(5)
    x = rng.random((clusters, 1, 2)) + sigma * rng.normal(size=(clusters, each, 2))
    return wrap(x.reshape(-1, 2))


def refused(x: np.ndarray, sides: tuple[int, int] | None = None) -> bool:
    try:
        neighbours(x, sides)
    except RefusalError as error:
        return "too near" in str(error)
    return False


def assert_exact(x: np.ndarray, sides: tuple[int, int] = (1, 1)) -> None:
    made = neighbours(x, sides)[0]
    box = np.array(as_sides(sides, 2) or (1.0, 1.0))
    for part, ring in zip(np.split(made.vector, made.indptr[1:-1]), exact_neighbours(x, sides), strict=True):
        exact = np.array(ring) * box
        order = np.argsort(np.arctan2(exact[:, 1], exact[:, 0]))
        np.testing.assert_allclose(part, exact[order], rtol=1e-14)


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-5, 3e-6, 1e-6, 1e-7])
@pytest.mark.parametrize("at", [0.4, 0.0])
@pytest.mark.parametrize("sides", [(1, 1), (4, 1), (1, 3)])
def test_clusters_are_exact_or_refused(width: float, at: float, sides: tuple[int, int]) -> None:
    sets = [cluster(12, width, seed, at) for seed in range(3)]
    answered = [x for x in sets if not refused(x, sides)]
    assert width < 1e-5 or len(answered) == 3
    for x in answered:
        assert_exact(x, sides)


@pytest.mark.parametrize(("width", "seed"), [(1e-5, 2), (5e-6, 0), (5e-6, 1), (3e-5, 3)])
def test_tight_clusters_whose_lifted_coordinates_are_rounded(width: float, seed: int) -> None:
    assert_exact(cluster(50, width, seed))


def test_measures_of_a_tight_cluster() -> None:
    made = gbnbench.measures(cluster(50, 1e-5, 2), 1)
    assert made["valence6"] == 0.18
    assert made["psi6"] == pytest.approx(0.348898, abs=5e-7)


@pytest.mark.parametrize("sigma", [1e-2, 1e-4, 1e-5])
@pytest.mark.parametrize("sides", [(1, 1), (4, 1)])
def test_clusters_scattered_over_the_torus(sigma: float, sides: tuple[int, int]) -> None:
    assert_exact(thomas(sigma), sides)


@pytest.mark.parametrize(("n", "width"), [(1000, 1e-3), (600, 1e-2), (2000, 1e-2)])
def test_clusters_lose_no_edge(n: int, width: float) -> None:
    assert neighbours(cluster(n, width, 1))[0].degree.sum() == 6 * n


def test_edges_short_beside_the_whole_set_count() -> None:
    made = neighbours(cluster(1000, 1e-3, 1))
    assert np.mean(made[0].degree == 6) == 0.254


@pytest.mark.parametrize("width", [1.0, 1e-2, 1e-4, 1e-5])
@pytest.mark.parametrize("place", [0.0, 0.1, 1 / 3])
def test_a_lattice_within_a_cluster_counts_no_diagonal(width: float, place: float) -> None:
    m = 7
    made = neighbours(wrap(place + width * grid(m, 2)))[0]
    inner = np.all((grid(m, 2) > 0) & (grid(m, 2) < (m - 1.5) / m), axis=1)
    assert set(made.degree[inner].tolist()) == {4}


@pytest.mark.parametrize("place", [0.0, 0.1, 1 / 3])
def test_a_lattice_as_ten_digits_is_a_lattice(place: float) -> None:
    assert set(neighbours(wrap(np.round(grid(15, 2) + place, 10)))[0].degree.tolist()) == {4}
    assert set(neighbours(wrap(np.round(hexagonal(26, 15) + place, 10)))[0].degree.tolist()) == {6}


def test_points_beside_both_ends_of_the_sides() -> None:
    last = 1 - 2.0**-53
    ends = [[0.0, 0.0], [last, 0.25], [0.3, last], [0.0, 0.6], [0.7, 0.0], [0.5, 0.4]]
    assert_exact(np.array(ends))
    assert_exact(np.concatenate([ends, np.random.default_rng(4).random((20, 2))]), (4, 1))


@pytest.mark.slow
@pytest.mark.parametrize("width", [0.1, 1e-3, 1e-4])
def test_clusters_in_space_lose_no_edge(width: float) -> None:
    x = cluster(12, width, 0, d=3)
    assert neighbours(x)[0].degree.tolist() == exact_degrees_in_space(x)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_tight_clusters_in_space_are_exact_or_refused(seed: int) -> None:
    x = cluster(20, 1e-5, seed, d=3)
    assert refused(x) or neighbours(x)[0].degree.tolist() == exact_degrees_in_space(x)
