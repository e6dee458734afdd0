"""Poisson-disk sets: least distances, maximality by Delaunay circles, and dart throwing in turn."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import Delaunay

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.periodic_delaunay import with_images
from gbnbench.core.torus import FloatArray, densest_spacing, toroidal_distance
from gbnbench.generators.direct.bridson import Bridson
from gbnbench.generators.direct.dart_throwing import DartThrowing
from gbnbench.generators.direct.maximal_poisson import MaximalPoisson
from gbnbench.generators.direct.poisson_disk import in_turn, throw_darts
from gbnbench.generators.direct.toroidal_tree import toroidal_tree
from gbnbench.generators.registry import generate


def least_distance(x: FloatArray) -> float:
    return float(toroidal_tree(x).query(x, 2)[0][:, 1].min())


def largest_empty_circle(x: FloatArray) -> float:
    """Radius of the largest ball of the torus without a point, by the circumcentres of a tiling."""
    tiled = with_images(x, 0.99)[0]
    corners = tiled[Delaunay(tiled).simplices]
    edges = corners[:, 1:] - corners[:, :1]
    sound = np.abs(np.linalg.det(edges)) > 1e-12
    edges, first = edges[sound], corners[sound, 0]
    centre = first + np.linalg.solve(edges, 0.5 * np.sum(edges**2, axis=2)[:, :, None])[:, :, 0]
    inside = np.all((centre >= 0) & (centre < 1), axis=1)
    return float(np.linalg.norm(centre - first, axis=1)[inside].max())


def test_largest_empty_circle_of_a_grid() -> None:
    x = generate("grid", n=36, d=2, seed=1) + 0.0
    assert largest_empty_circle(x) == pytest.approx(np.sqrt(0.5) / 6)


@pytest.mark.parametrize(("n", "d"), [(200, 1), (300, 2), (60, 3)])
def test_maximal_sets_have_no_gap_and_keep_their_distance(n: int, d: int) -> None:
    for seed in range(3):
        found = None
        rng = np.random.default_rng(seed)
        while found is None:
            found = MaximalPoisson().saturated_set(n, d, rng)
        x, radius = found
        assert x.shape == (n, d)
        assert least_distance(x) >= radius * (1 - 1e-12)
        if d == 1:
            gaps = np.diff(np.sort(x[:, 0]), append=np.sort(x[:, 0])[:1] + 1)
            assert gaps.max() / 2 <= radius * (1 + 1e-12)
        else:
            assert largest_empty_circle(x) <= radius * (1 + 1e-12)


def test_the_saturated_share_in_1d_is_renyi_s() -> None:
    """The parking constant .7476; its standard deviation over sets of 2,000 points is .0044."""
    x, saturated = throw_darts(np.empty((0, 1)), 0.7476 / 2000, 4000, np.random.default_rng(2))
    assert saturated
    assert abs(len(x) * 0.7476 / 2000 - 0.747598) < 0.02


def test_darts_in_turn_are_those_of_a_plain_loop() -> None:
    rng = np.random.default_rng(4)
    there, thrown = rng.random((10, 2)), rng.random((300, 2))
    plain: list[FloatArray] = []
    for dart in thrown:
        others = np.concatenate([there, np.reshape(plain, (-1, 2))])
        if toroidal_distance(others, dart).min() > 0.07:
            plain.append(dart)
    assert np.array_equal(in_turn(thrown, there, 0.07), plain)


def test_cells_left_out_change_no_distribution() -> None:
    """Mean pair distances of cells' dart throwing against plain dart throwing of 12 points, 120 sets each."""
    radius, rng = 0.2, np.random.default_rng(7)
    statistic: dict[bool, list[float]] = {True: [], False: []}
    for _ in range(120):
        statistic[True].append(spread(throw_darts(np.empty((0, 2)), radius, 12, rng)[0]))
        plain: FloatArray = np.empty((0, 2))
        while len(plain) < 12:
            plain = in_turn_all(plain, rng.random((1, 2)), radius)
        statistic[False].append(spread(plain))
    cells, loop = np.array(statistic[True]), np.array(statistic[False])
    assert abs(cells.mean() - loop.mean()) < 4 * np.sqrt((cells.var() + loop.var()) / 120)


def spread(x: FloatArray) -> float:
    return float(np.exp(-30 * toroidal_distance(x[:, None], x[None]) ** 2).sum())


def in_turn_all(x: FloatArray, dart: FloatArray, radius: float) -> FloatArray:
    return np.concatenate([x, in_turn(dart, x, radius)])


@pytest.mark.parametrize(("n", "d"), [(400, 2), (300, 3), (200, 4)])
def test_darts_keep_the_relative_radius(n: int, d: int) -> None:
    x = DartThrowing(radius=0.7)(n, d, np.random.default_rng(1))
    assert least_distance(x) >= 0.7 * densest_spacing(n, d)


def test_darts_that_find_no_room_make_the_radius_smaller() -> None:
    with pytest.warns(RuntimeWarning, match="n=100 points in d=2 found room at a relative radius of 0.7"):
        x = DartThrowing(radius=1.0)(100, 2, np.random.default_rng(1))
    assert 0.7 < least_distance(x) / densest_spacing(100, 2) < 0.85


@pytest.mark.parametrize(("n", "d"), [(300, 1), (400, 2), (300, 3)])
def test_bridson_s_front_leaves_no_large_hole(n: int, d: int) -> None:
    x = Bridson()(n, d, np.random.default_rng(3))
    least = {1: 0.6, 2: 0.68, 3: 0.65}[d]  # of the densest spacing; a saturated set has .75, .78 and .80
    assert least < least_distance(x) / densest_spacing(n, d) < 0.8
    if d == 2:  # candidates lie within two radii: no empty circle beyond them
        assert largest_empty_circle(x) < 1.3 * least_distance(x)


@pytest.mark.parametrize(("candidates", "n", "d"), [(1, 64, 2), (4, 200, 1)])
def test_a_front_that_dies_out_gives_no_set(candidates: int, n: int, d: int) -> None:
    """Its radius would be lowered to nothing; two candidates in 2D are enough."""
    with pytest.raises(RefusalError, match=f"front with candidates={candidates} dies out"):
        Bridson(candidates)(n, d, np.random.default_rng(1))
    assert least_distance(Bridson(2)(64, 2, np.random.default_rng(1))) > 0.5 * densest_spacing(64, 2)


def test_a_radius_next_to_nothing_is_no_radius() -> None:
    assert len(DartThrowing(radius=1e-308)(16, 2, np.random.default_rng(1))) == 16


def test_sizes_that_would_take_for_ever_are_refused() -> None:
    assert DartThrowing().refusal(16_384, 6) is None
    assert "nearest is 4096" in str(DartThrowing().refusal(16_384, 8))
    assert "nearest is 40 " in str(DartThrowing(attempts=10**6).refusal(64, 8)) + " "
    assert Bridson().refusal(100_000, 3) is None
    for candidates, n, d in ((30, 16_384, 8), (30, 4096, 100), (10_000, 100_000, 2)):
        assert "with" in str(Bridson(candidates).refusal(n, d))
    assert Bridson(10_000).refusal(1, 100) is None


@pytest.mark.parametrize(
    ("kind", "settings", "word"),
    [
        (DartThrowing, {"radius": 1.5}, "radius"),
        (DartThrowing, {"attempts": 0}, "attempts"),
        (DartThrowing, {"attempts": 10**20}, "attempts"),
        (Bridson, {"candidates": 0}, "candidates"),
        (Bridson, {"candidates": 10**400}, "candidates"),
    ],
)
def test_settings_out_of_range_are_refused(kind: type, settings: dict[str, float], word: str) -> None:
    with pytest.raises(InputError, match=word):
        kind(**settings)
