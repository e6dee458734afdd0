"""Electrostatic halftoning: forces are sums over all charges, energy falls, a flat density is as usual."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import exp1

from gbnbench import measures
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.adaptive.charges.electrostatic import PIXEL, Attraction
from gbnbench.generators.adaptive.charges.repulsion import Repulsion, charges_refusal
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.registry import adaptive_generator, adaptive_points
from gbnbench.generators.gbn.ewald import EwaldEnergy

RAMP = as_density(np.linspace(0.2, 1, 40)[:, None] * np.ones(30))


def forces_of(places, charges, at, variance=0.0):
    """Plain sum of the forces of charges, each spread over a Gaussian, on unit charges elsewhere."""
    apart = at[:, None] - places
    square = (apart**2).sum(axis=2)
    own = square == 0
    square[own] = 1.0
    spread = 1 - np.exp(-square / (2 * variance)) if variance else 1.0
    return ((charges * spread * ~own / square)[..., None] * apart).sum(axis=1)


def test_points_repel_in_a_box_as_all_pairs_do():
    x = np.random.default_rng(0).random((300, 2)) * (40, 60)
    expected = forces_of(x, np.ones(300), x)
    error = Repulsion(as_density(np.ones((40, 60))), 300)(x) - expected
    assert np.sqrt((error**2).mean()) < 3e-4  # of forces of some 10
    assert np.abs(error).max() < 3e-3


def test_points_repel_on_the_torus_as_by_ewalds_sum():
    x = np.random.default_rng(1).random((300, 2))
    spacing = 40 / np.sqrt(300)
    expected = -2 * np.pi * EwaldEnergy(300, 2, 0.0)(x)[1] / spacing
    error = Repulsion(as_density(np.ones((40, 40)), toroidal=True), 300)(40 * x) - expected
    assert np.sqrt((error**2).mean()) < 3e-4
    assert np.abs(error).max() < 3e-3


def test_pixels_attract_as_all_their_charges_do():
    rng = np.random.default_rng(2)
    density = as_density(rng.random((30, 20)))
    x = rng.random((50, 2)) * density.shape
    pixels = np.argwhere(density.values >= 0) + 0.5
    expected = -forces_of(pixels, density.of_points(40).ravel(), x, PIXEL**2)
    # Splines between the centres of pixels that differ at random: errors of 5e-3, the largest pull being 3.
    assert Attraction(density, 40)(x) == pytest.approx(expected, abs=1e-2)


def test_a_constant_density_on_the_torus_attracts_nowhere():
    x = np.random.default_rng(3).random((20, 2)) * 30
    assert Attraction(as_density(np.ones((30, 30)), toroidal=True), 40)(x) == pytest.approx(0, abs=1e-12)


def test_energy_falls_where_nothing_is_shaken():
    pixels, charges = np.argwhere(RAMP.values >= 0) + 0.5, RAMP.of_points(60).ravel()

    def energy(x):
        between = np.linalg.norm(x[:, None] - x, axis=2)[np.triu_indices(60, 1)]
        square = ((x[:, None] - pixels) ** 2).sum(axis=2)
        pulled = 0.5 * (np.log(square) + exp1(square / (2 * PIXEL**2)))
        return (pulled * charges).sum() - np.log(between).sum()

    found = [
        energy(adaptive_points(f"electrostatic[shaking=0,iterations={k}]", RAMP, 60))
        for k in (0, 2, 8, 32, 128)
    ]
    assert (np.diff(found) < 0).all()


def test_islands_get_their_shares():
    values = np.zeros((30, 50))
    values[5:12, 4:14], values[20:27, 30:45] = 1.0, 2.0  # 70 and 210
    x = adaptive_points("electrostatic", as_density(values), 40)
    assert (x[:, 1] < 20).sum() in (9, 10, 11)  # from a random start, over a gap without ink


def test_what_charges_cannot_do_is_refused_in_words():
    with pytest.raises(RefusalError, match="3 axes"):
        adaptive_points("electrostatic", as_density(np.ones((4, 4, 4))), 5)
    with pytest.raises(RefusalError, match="16,777,216 are the most"):
        adaptive_points("electrostatic", as_density(np.ones((500, 500))), 50_000_000)
    assert "near pairs" in str(charges_refusal(as_density(np.ones((100, 100))), 2_000_000))
    with pytest.raises(RefusalError, match="too narrow"):
        adaptive_points("electrostatic", as_density(np.ones((1, 100_000)), toroidal=True), 100)
    with pytest.raises(InputError, match=r"tau must be above 0 and at most 0\.3"):
        adaptive_generator("electrostatic[tau=1]")


@pytest.mark.slow
def test_a_constant_density_has_the_spectrum_of_the_uniform_method():
    flat = as_density(np.ones((128, 128)), toroidal=True)
    found = [measures(adaptive_points("electrostatic", flat, 1024, seed=seed) / 128) for seed in range(3)]
    # Of the uniform method, mean of three sets: floor 4.4e-5 (3.4 to 5.1), peak 4.49, least distance 0.814.
    assert np.mean([m["noise_floor"] for m in found]) == pytest.approx(4.4e-5, rel=0.3)
    assert np.mean([m["peak"] for m in found]) == pytest.approx(4.5, rel=0.1)
    assert np.mean([m["min_distance"] for m in found]) == pytest.approx(0.81, abs=0.02)
