"""Farthest-point optimisation for a density: voids of plain numpy, moves to their tops, uniform sets."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench import measures
from gbnbench.core.errors import RefusalError
from gbnbench.doctor.adaptive_sets import numpy_voids
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.farthest_point.places import local_spacing, void_places
from gbnbench.generators.adaptive.farthest_point.relocation import AdaptiveSweeps
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.generators.adaptive.registry import adaptive_points

BUMPS = 1.2 + np.sin(np.arange(44) / 6)[:, None] * np.cos(np.arange(60) / 9)
ISLANDS = np.where(BUMPS > 1.4, BUMPS, 0)


def _sweeps(values, n, *, toroidal=False, smoothing=0.5, seed=0):
    density = as_density(values, toroidal=toroidal)
    places = void_places(density, n, smoothing)
    return (
        density,
        places,
        AdaptiveSweeps(density, places, hilbert_start(density, n, np.random.default_rng(seed))),
    )


@pytest.mark.parametrize("toroidal", [False, True])
@pytest.mark.parametrize("values", [BUMPS, ISLANDS], ids=["bumps", "islands"])
@pytest.mark.parametrize("n", [2, 9, 80])
def test_voids_are_those_of_a_plain_search(values, n, toroidal):
    density, places, work = _sweeps(values, n, toroidal=toroidal)
    at = places.places.astype(np.float64)
    for _ in range(3):
        assert np.abs(work.voids() - numpy_voids(density, places, at, work.points())).max() < 3e-5
        work.sweep()


@pytest.mark.parametrize("toroidal", [False, True])
@pytest.mark.parametrize("values", [BUMPS, ISLANDS], ids=["bumps", "islands"])
def test_a_point_goes_to_the_largest_void_that_the_others_leave(values, toroidal):
    n = 60
    density, places, work = _sweeps(values, n, toroidal=toroidal)
    before, found = work.points(), 0
    for _ in range(3):
        work.sweep()
        after = work.points()
        others = after[:-1]  # the last point is the last one to move, so that these are as they were then
        own, now = (numpy_voids(density, places, x[-1:], others)[0] for x in (before, after))
        assert work.nearest()[-1] == pytest.approx(now, rel=1e-6)
        largest = numpy_voids(density, places, places.places.astype(np.float64), others).max()
        if (before[-1] != after[-1]).any():
            found += 1
            assert now > own
            assert now > largest * (1 - 1e-5)
            around = after[-1] + 0.01 * np.random.default_rng(0).normal(size=(400, 2))
            around = around[((around > 0) & (around < density.shape)).all(axis=1)]
            around = around[density.values[tuple(around.astype(int).T)] > 0]
            assert now > numpy_voids(density, places, around, others).max() * (1 - 2e-3)
        else:
            assert own > largest * (1 - 1e-5)
        before = after
    assert found


def test_the_least_distance_never_falls():
    _, _, work = _sweeps(BUMPS, 200)
    least = [work.nearest().min()]
    for _ in range(8):
        work.sweep()
        least.append(work.nearest().min())
    assert (np.diff(least) > -1e-9).all()
    assert least[-1] > 0.85


@pytest.mark.slow
def test_a_constant_density_gives_sets_of_the_uniform_method():
    side = 128
    flat = as_density(np.ones((side, side)), toroidal=True)
    for seed in range(2):
        found = measures(adaptive_points("fpo", flat, 1024, seed=seed) / side)
        assert found["min_distance"] > 0.9  # fpo stops at .925
        assert found["noise_floor"] == pytest.approx(8.5e-3, rel=0.25)  # fpo: 7.3e-3 and 9.4e-3, two sets
        assert found["peak"] == pytest.approx(4.2, abs=0.6)  # fpo: 4.4 and 4.0


def test_the_density_is_followed():
    ramp = as_density(np.linspace(0.1, 1, 60)[:, None] * np.ones(50))
    x = adaptive_points("fpo", ramp, 600)
    expected = ramp.of_points(600).sum(axis=1).reshape(6, 10).sum(axis=1)
    counted = np.histogram(x[:, 0], np.arange(0, 61, 10))[0]
    assert counted == pytest.approx(expected, abs=0.12 * expected.max())


def test_the_local_spacing_is_that_of_squares():
    assert local_spacing(as_density(np.ones((30, 40)), toroidal=True), 48, 0.25) == pytest.approx(5, rel=1e-9)


def test_places_are_dense_by_the_spacing_and_on_the_ink():
    density = as_density(ISLANDS)
    for n in (3, 30, 300):
        places = void_places(density, n, 0.5)
        at = places.places.astype(np.float64)
        assert (density.values[tuple(at.astype(int).T)] > 0).all()
        ink = np.argwhere(ISLANDS > 0) + 0.5
        spacing = places.spacing[tuple(ink.astype(int).T)]
        apart = np.sqrt(((ink[:, None] - at) ** 2).sum(axis=2)).min(axis=1)
        assert (apart < np.maximum(spacing / 6, 1) * np.sqrt(2)).all()


@pytest.mark.parametrize(
    ("values", "n", "words"),
    [
        (np.ones((4, 4, 4)), 5, "axes"),
        (np.ones((8, 8)), 5_000_000, "fewer points"),
        (np.pad([[1.0]], 1500), 200_000, "crowd"),
    ],
)
def test_what_cannot_be_made_is_refused(values, n, words):
    with pytest.raises(RefusalError, match=words):
        adaptive_points("fpo", as_density(values), n)
