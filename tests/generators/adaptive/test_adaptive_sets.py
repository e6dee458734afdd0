"""Adaptive sets: as many as asked, on the ink, the same from the same seed, and refused in words."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench import measures
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.adaptive.density import as_density, density_of
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.hilbert_start import hilbert_index, hilbert_start
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.generators.adaptive.registry import ADAPTIVE_GENERATORS, adaptive_generator, adaptive_points

SHORT = {
    "gbn": "gbn[gradients=5]",
    "bnot": "bnot[alternations=5]",
    "electrostatic": "electrostatic[iterations=12]",
    "kdm": "kdm[iterations=3]",
    "voidcluster": "voidcluster[side=16]",
}
DISC = density_of(lambda x: np.hypot(*(x - 20).T) < 12, (40, 40))


def quick(name: str) -> AdaptiveGenerator:
    """Make the generator with few steps, where its own take long."""
    return adaptive_generator(SHORT.get(name, name))


@pytest.mark.parametrize("name", ADAPTIVE_GENERATORS)
def test_sets_are_on_the_ink_and_follow_the_seed(name):
    generator = quick(name)
    x = adaptive_points(generator, DISC, 70, seed=3)
    assert x.shape == (70, 2)
    assert (DISC.values[tuple(x.astype(int).T)] > 0).all()
    assert (adaptive_points(generator, DISC, 70, seed=3) == x).all()
    assert (adaptive_points(generator, DISC, 70, seed=4) != x).any()
    assert (adaptive_points(generator, DISC, 70, seed=3, realization=1) != x).any()


@pytest.mark.parametrize("name", ADAPTIVE_GENERATORS)
@pytest.mark.parametrize("toroidal", [False, True])
@pytest.mark.parametrize(
    "values",
    [
        np.ones((1, 1)),
        np.eye(3),
        np.ones((1, 30)),
        np.pad([[1.0]], 15),
        np.pad([[1.0]], 15, constant_values=1e-4),
    ],
    ids=["one pixel", "diagonal", "one row", "one of many", "contrast"],
)
def test_odd_densities_are_served(name, values, toroidal):
    density = as_density(values, toroidal=toroidal)
    generator = quick(name)
    for n in (1, 2, 11):
        x = adaptive_points(generator, density, n)
        assert x.shape == (n, 2)
        assert np.isfinite(x).all()
        assert (x >= 0).all()
        assert (x < density.shape).all()
        assert (density.values[tuple(x.astype(int).T)] > 0).all()


def test_volumes_are_served():
    ramp = as_density(np.linspace(0, 1, 12)[:, None, None] * np.ones((12, 10, 8)))
    x = adaptive_points("gbn[gradients=10]", ramp, 200)
    assert x.shape == (200, 3)
    assert x[:, 0].mean() == pytest.approx(8, abs=0.5)  # 2/3 of the way up


def test_the_energy_falls_from_start_to_end():
    from gbnbench.generators.adaptive.gbn.descent import descend
    from gbnbench.generators.adaptive.gbn.energy import AdaptiveEnergy
    from gbnbench.opencl import runtime

    y = np.linspace(0.1, 1, 48)[:, None] * np.ones(48)
    density = as_density(y)
    energy = AdaptiveEnergy(runtime(), density, 150, sigma=1.0, smoothing=0.5, spread=0.8, precision="double")
    start = hilbert_start(density, 150, np.random.default_rng(0))
    heard = []
    end = descend(energy, start, 40, lambda _, now, __: heard.append(now))
    assert len(heard) == 40
    assert energy(end).energy <= min(heard) + 1e-6
    assert energy(end).energy < heard[0]


@pytest.mark.slow
def test_a_constant_density_reaches_the_floor_and_the_disorder_of_the_uniform_method():
    flat = as_density(np.ones((128, 128)), toroidal=True)
    found = measures(adaptive_points("gbn[sigma=1,smoothing=1,spread=1]", flat, 1024) / 128)
    # 100 gradients of the uniform method leave 9.9e-9 and a peak of 1.97 (its own doc has them).
    assert found["noise_floor"] < 3e-8
    assert found["peak"] == pytest.approx(1.9, abs=0.25)


@pytest.mark.parametrize("d", [2, 3])
def test_a_hilbert_curve_goes_from_each_cell_to_a_neighbour(d):
    cells = np.argwhere(np.ones((8,) * d))
    index = hilbert_index(cells)
    assert sorted(index) == list(range(8**d))
    walk = cells[np.argsort(index)]
    assert (np.abs(np.diff(walk, axis=0)).sum(axis=1) == 1).all()


def test_a_start_has_the_share_of_each_half():
    x = hilbert_start(as_density([[1.0, 3.0]]), 1000, np.random.default_rng(0))
    assert abs((x[:, 1] < 1).sum() - 250) <= 4


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (np.zeros((3, 3)), "0 everywhere"),
        ([[1.0, -1.0]], "below 0"),
        ([[1.0, np.nan]], "nan or infinite"),
        (np.zeros((0, 3)), "pixels"),
        (np.ones(5), "two axes"),
        ([["a"]], "real numbers"),
    ],
)
def test_what_is_no_density_is_refused(values, words):
    with pytest.raises(InputError, match=words):
        as_density(values)


def test_wrong_arguments_are_refused_in_words():
    with pytest.raises(InputError, match="no adaptive generator"):
        adaptive_generator("gbnn")
    with pytest.raises(InputError, match=r"sigma must lie in \[0.5, 1.5\]"):
        adaptive_generator("gbn[sigma=9]")
    with pytest.raises(InputError, match="n must be"):
        adaptive_points("gbn", DISC, 0)
    with pytest.raises(InputError, match="one number each"):
        density_of(lambda x: np.ones(3), (4, 4))
    with pytest.raises(RefusalError, match="fewer points"):
        adaptive_points(AdaptiveGaussianBlueNoise(), as_density(np.ones((2000, 2000))), 500_000_000)
