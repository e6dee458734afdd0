"""Farthest-point optimisation: the stop rule, published distances and the optima of a few points."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, densest_spacing
from gbnbench.generators.fpo.generator import FarthestPoint


def nearest_distances(x: FloatArray) -> FloatArray:
    """Nearest-neighbour distances over d_hex, from all nine tiles."""
    tiles = np.concatenate([x + np.array(tile) for tile in np.ndindex(3, 3)]) - 1.0
    return np.asarray(cKDTree(tiles).query(x, k=2)[0])[:, 1] / np.sqrt(2 / (np.sqrt(3) * len(x)))


@pytest.mark.parametrize(("n", "seed"), [(64, 1), (256, 0), (256, 1), (256, 2), (1024, 0), (1024, 1)])
def test_distances_are_those_published(n: int, seed: int):
    x = FarthestPoint()(n, 2, np.random.default_rng(seed))
    assert x.shape == (n, 2)
    assert x.dtype == np.float64
    assert np.all((x >= 0) & (x < 1))
    distance = nearest_distances(x)
    assert distance.min() >= 0.925
    # PSA's fpo set has .929 and .932: nearly every point's nearest neighbour is at the minimum.
    assert 0.926 < distance.mean() < 0.945
    assert distance.mean() - distance.min() < 0.012


def test_the_local_strategy_reaches_the_same_distances():
    x = FarthestPoint(strategy="local")(256, 2, np.random.default_rng(1))
    distance = nearest_distances(x)
    assert distance.min() >= 0.925
    assert 0.926 < distance.mean() < 0.945


def test_minimum_distance_never_falls_and_the_stop_rule_holds():
    unit = densest_spacing(256, 2)
    results = FarthestPoint().optimise(np.random.default_rng(11).random((4, 256, 2)))
    for result in results:
        history = result.min_distance / unit
        assert result.converged
        assert result.fresh_moves == 0
        assert np.all(np.diff(history) >= -1e-14)
        assert nearest_distances(result.points).min() == pytest.approx(history[-1], abs=1e-12)
        gains = history[5:] - history[:-5]
        met = (gains < 0.002) & (history[5:] >= 0.925)
        assert met[-1]
        assert not met[:-1].any()


def test_a_seed_gives_one_set_and_seeds_give_different_sets():
    first, again, other = (FarthestPoint()(100, 2, np.random.default_rng(s)) for s in (8, 8, 9))
    np.testing.assert_array_equal(first, again)
    assert cKDTree(first, boxsize=[1.0, 1.0]).query(other)[0].min() > 0


def test_realizations_are_independent():
    # The mean over M sets of the unit amplitude of a frequency with little structure falls as 1/sqrt(M).
    starts = np.random.default_rng(21).random((64, 64, 2))
    sets = np.stack([result.points for result in FarthestPoint(sweeps=6).optimise(starts)])
    amplitude = np.exp(-2j * np.pi * (sets @ np.array([17.0, 5.0]))).sum(axis=1)
    phase = amplitude / np.abs(amplitude)
    assert np.abs(phase.mean()) < 3 / np.sqrt(64)


def test_a_jammed_start_is_followed_by_another():
    rng = np.random.default_rng(1)
    for _ in range(20):
        before = rng.bit_generator.state
        if FarthestPoint().optimise(rng.random((1, 48, 2)))[0].min_distance[-1] < 0.925 * densest_spacing(
            48, 2
        ):
            break
    else:
        pytest.fail("no start of twenty jammed; one in four should")
    rng.bit_generator.state = before
    assert nearest_distances(FarthestPoint(starts=1)(48, 2, rng)).min() < 0.925
    rng.bit_generator.state = before
    assert nearest_distances(FarthestPoint()(48, 2, rng)).min() >= 0.925


def test_one_two_and_three_points_take_their_best_places():
    rng = np.random.default_rng(0)
    assert FarthestPoint()(1, 2, rng).shape == (1, 2)
    two = FarthestPoint()(2, 2, rng)
    np.testing.assert_allclose(np.abs(two[0] - two[1]), [0.5, 0.5], atol=1e-15)
    three = nearest_distances(FarthestPoint()(3, 2, rng)) * densest_spacing(3, 2)
    np.testing.assert_allclose(
        three, (np.sqrt(6) - np.sqrt(2)) / 2, atol=1e-5
    )  # densest packing of the torus


def test_a_perfect_grid_stays():
    grid = (np.stack(np.meshgrid(np.arange(6), np.arange(6)), axis=-1).reshape(1, -1, 2) + 0.5) / 6
    result = FarthestPoint().optimise(grid)[0]
    np.testing.assert_array_equal(result.points, grid[0])
    assert result.converged
    assert len(result.min_distance) == 2


@pytest.mark.parametrize("start", ["cluster", "same", "line"])
def test_hopeless_starts_are_spread_too(start: str):
    rng = np.random.default_rng(6)
    x = {
        "cluster": 0.01 * rng.random((60, 2)),
        "same": np.full((60, 2), 0.3),
        "line": rng.random((60, 2)) * (1, 0),
    }
    result = FarthestPoint(target=0.9).optimise(x[start][None])[0]
    assert result.converged
    assert nearest_distances(result.points).min() >= 0.9


def test_sweeps_that_do_not_suffice_are_reported():
    with pytest.warns(RuntimeWarning, match=r"sweeps=3 .* raise sweeps"):
        x = FarthestPoint(sweeps=3)(64, 2, np.random.default_rng(0))
    assert nearest_distances(x).min() < 0.925


@pytest.mark.parametrize("d", [1, 3])
def test_other_dimensions_are_refused(d: int):
    assert "d=2" in (FarthestPoint().refusal(64, d) or "")
    with pytest.raises(RefusalError, match="use d=2"):
        FarthestPoint()(64, d, np.random.default_rng(0))


@pytest.mark.parametrize(
    "settings", [{"target": 1.2}, {"target": float("nan")}, {"gain": -1.0}, {"sweeps": 0}, {"starts": 0}]
)
def test_settings_out_of_range_are_named(settings: dict[str, float]):
    with pytest.raises(InputError, match=f"^{next(iter(settings))} must"):
        FarthestPoint(**settings)  # type: ignore[arg-type]


def test_starts_must_be_sets_of_the_plane():
    with pytest.raises(InputError, match="starts must be"):
        FarthestPoint().optimise(np.zeros((5, 2)))
    with pytest.raises(InputError, match="points must lie"):
        FarthestPoint().optimise(np.ones((1, 5, 2)))
