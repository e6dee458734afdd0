"""Spatial measures on rectangles and boxes: copies of a known set, lattices, and brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial import Delaunay

from gbnbench.analysis.spatial.bond_order import bond_order, psi6
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spatial.distances import mean_distance, min_distance, nearest_distances
from gbnbench.analysis.spatial.edge_density import edge_density
from gbnbench.analysis.spatial.pair_counts import pair_counts
from gbnbench.analysis.spatial.rdf import pair_density, rdf
from gbnbench.analysis.spatial.valence import valence, valence6
from gbnbench.analysis.spatial.zone_plate import zone_plate
from gbnbench.core.errors import InputError
from gbnbench.core.sides import as_sides
from tests.oracles.stretched import hexagonal_rectangle, repeated

TIMES = [(2, 1), (1, 3), (5, 1), (3, 2), (2, 1, 1), (1, 2, 3)]


def points(times: tuple[int, ...], n: int = 90) -> np.ndarray:
    return np.random.default_rng(len(times)).random((n, len(times)))


@pytest.mark.parametrize("times", TIMES)
def test_distances_are_those_of_the_set_that_was_repeated(times: tuple[int, ...]) -> None:
    x = points(times)
    long = repeated(x, times)
    np.testing.assert_allclose(
        nearest_distances(long, times)[0], np.tile(nearest_distances(x)[0], math.prod(times)), rtol=1e-12
    )
    assert min_distance(long, times) == pytest.approx(min_distance(x), rel=1e-12)
    assert mean_distance(long, times) == pytest.approx(mean_distance(x), rel=1e-12)


@pytest.mark.parametrize("times", TIMES)
def test_neighbours_are_those_of_the_set_that_was_repeated(times: tuple[int, ...]) -> None:
    x = points(times)
    short, long = neighbours(x)[0], neighbours(repeated(x, times), times)[0]
    copies = math.prod(times)
    np.testing.assert_array_equal(long.degree, np.tile(short.degree, copies))
    lengths = [np.sort(np.linalg.norm(each.vector, axis=1)) for each in (short, long)]
    # Lengths are over the root of the volume: copies^(1/d) larger in the short torus.
    np.testing.assert_allclose(
        lengths[1] * copies ** (1 / len(times)), np.repeat(lengths[0], copies), rtol=1e-9
    )


@pytest.mark.parametrize("times", [t for t in TIMES if len(t) == 2])
def test_order_is_that_of_the_set_that_was_repeated(times: tuple[int, int]) -> None:
    x = points(times)
    long = repeated(x, times)
    np.testing.assert_allclose(psi6(long, times), psi6(x), rtol=1e-12)
    np.testing.assert_allclose(bond_order(long, times), bond_order(x), rtol=1e-12)
    np.testing.assert_array_equal(valence(long, times).share, valence(x).share)
    assert abs(psi6(long) - psi6(x)) > 1e-3  # called a square, it is another set


@pytest.mark.parametrize("times", TIMES)
def test_pairs_are_those_of_the_set_that_was_repeated(times: tuple[int, ...]) -> None:
    x = points(times, 300)
    long, copies, unit = repeated(x, times), math.prod(times), math.prod(times) ** (-1 / len(times))
    sides = as_sides(times, len(times))
    counts = pair_counts(x, 40, 0.499 / 40)
    np.testing.assert_array_equal(pair_counts(long, 40, 0.499 / 40 * unit, sides), copies * counts)
    g = pair_density(long[None], 40, 0.499 / 40 * unit, sides)
    # Pairs expected of n uniform points are n(n-1)/2, of all copies kn(kn-1)/2.
    n = len(x)
    np.testing.assert_allclose(
        g, pair_density(x[None], 40, 0.499 / 40) * copies * (n - 1) / (copies * n - 1), rtol=1e-12
    )


@pytest.mark.parametrize("sides", [(1.7, 1.0), (1.0, 9.3), (1.0, 2.2, 0.4)])
def test_any_ratio_against_brute_force(sides: tuple[float, ...]) -> None:
    d = len(sides)
    x = np.random.default_rng(5).random((150, d))
    box = np.array(sides) / math.prod(sides) ** (1 / d)
    gap = x[:, None] - x[None]
    gap -= np.rint(gap)
    distance = np.sqrt(((gap * box) ** 2).sum(axis=-1))
    np.fill_diagonal(distance, np.inf)
    unit = min_distance(x, sides)[0] / distance.min()  # one over the densest spacing
    np.testing.assert_allclose(nearest_distances(x, sides)[0], distance.min(axis=1) * unit, rtol=1e-12)
    reach = 0.5 * box.min()
    expected = np.histogram(distance[np.triu_indices(150, 1)], bins=30, range=(0, reach))[0]
    np.testing.assert_array_equal(pair_counts(x, 30, reach / 30, as_sides(sides, d)), expected)


@pytest.mark.parametrize("sides", [(1.7, 1.0), (1.0, 6.0), (1.0, 1.6, 0.8)])
@pytest.mark.parametrize("n", [3, 60])
def test_neighbours_against_a_whole_tiling(sides: tuple[float, ...], n: int) -> None:
    d = len(sides)
    x = np.random.default_rng(n).random((n, d))
    rings = 2 if d == 3 else 7
    shifts = np.stack(np.meshgrid(*[np.arange(-rings, rings + 1)] * d, indexing="ij"), axis=-1).reshape(-1, d)
    shifts = shifts[np.argsort((shifts != 0).any(axis=1), kind="stable")]
    tiled = ((x[None] + shifts[:, None]) * sides).reshape(-1, d)
    start, _ = Delaunay(tiled).vertex_neighbor_vertices
    np.testing.assert_array_equal(neighbours(x, sides)[0].degree, np.diff(start)[:n])


def test_one_point_of_a_thin_torus_meets_its_images_alone() -> None:
    made = neighbours([[0.3, 0.4]], (40, 1))[0]
    assert made.degree.tolist() == [4]
    np.testing.assert_allclose(
        np.sort(np.abs(made.vector).max(axis=1)), np.sqrt([1 / 40, 1 / 40, 40, 40]), rtol=1e-12
    )


@pytest.mark.parametrize(("columns", "rows"), [(4, 3), (12, 5), (1, 1), (20, 2)])
def test_hexagonal_lattice_of_a_rectangle(columns: int, rows: int) -> None:
    x = hexagonal_rectangle(columns, rows)
    sides = (columns, rows * math.sqrt(3))
    assert psi6(x, sides) == pytest.approx(1, abs=1e-9)
    assert bond_order(x, sides) == pytest.approx(1, abs=1e-9)
    assert valence6(x, sides) == 1
    np.testing.assert_allclose(nearest_distances(x, sides), 1, rtol=1e-12)


@pytest.mark.parametrize("turn", [(0, 1), (1, 0)])
def test_zone_plate_is_that_of_the_set_that_was_repeated(turn: tuple[int, int]) -> None:
    x = points((1, 1), 256)  # a tile of 8 by 8 pixels; two of them are one of 16 by 8
    times = (2, 1) if turn == (0, 1) else (1, 2)
    np.testing.assert_allclose(zone_plate(repeated(x, times), 100, times), zone_plate(x, 100), atol=1e-12)


def test_zone_plate_of_a_ratio_that_pixels_do_not_have() -> None:
    picture = zone_plate(hexagonal_rectangle(16, 9), 64, (16, 9 * math.sqrt(3)))
    assert picture.shape == (64, 64)
    assert np.isfinite(picture).all()


def test_rdf_of_uniform_points_is_one_and_ends_at_half_the_shortest_side() -> None:
    made = rdf(np.random.default_rng(0).random((20, 500, 2)), (6, 1))
    error = made.g_by_set.std(axis=0, ddof=1) / math.sqrt(20)
    assert np.mean(np.abs(made.g - 1)[5:] < 3 * error[5:]) > 0.95
    assert made.r[-1] * math.sqrt(2 / math.sqrt(3) / 500) < 0.5 / math.sqrt(6)


def test_edge_density_of_uniform_points_is_one_in_a_box() -> None:
    profile = edge_density(np.random.default_rng(3).random((60, 300, 3)), sides=(1, 2, 0.7))
    assert np.all(np.abs(profile.density - 1) < 5 * profile.standard_error)
    assert profile.cumulative[-1] == pytest.approx(1) or profile.edges[-1] == 8


@pytest.mark.parametrize("measure", [nearest_distances, rdf, neighbours, valence, psi6, bond_order])
def test_sides_that_do_not_fit_are_refused(measure: object) -> None:
    with pytest.raises(InputError, match="sides must be 2 lengths"):
        measure(np.random.default_rng(0).random((20, 2)), (1, 2, 3))  # type: ignore[operator]
