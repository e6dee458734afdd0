"""Progressive orders of adaptive sets: each prefix has the density, far better than a random choice."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.gbn.prefix_choice import PrefixChoice
from gbnbench.generators.adaptive.gbn.progressive import PREFIXES, progressive_order
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.generators.kernel_based.progressive_order import prefix_noise_floors

HALVES = np.ones((32, 32))
HALVES[:, 16:] = 0.25


@pytest.mark.parametrize("toroidal", [False, True])
def test_prefixes_have_the_share_of_each_block(toroidal):
    density = as_density(HALVES, toroidal=toroidal)
    expected = HALVES.reshape(4, 8, 4, 8).sum(axis=(1, 3)) / HALVES.sum()
    lengths, seeds = (50, 70, 100, 140), range(4)
    excess = np.zeros(len(lengths))
    for seed in seeds:
        x = adaptive_points("gbn[gradients=20]", density, 200, seed=seed)
        order = progressive_order(density, x)
        assert sorted(order) == list(range(200))
        for i, m in enumerate(lengths):
            counts = np.histogram2d(*x[order[:m]].T, bins=4, range=[(0, 32)] * 2)[0]
            excess[i] += ((counts - m * expected) ** 2 / (m * expected)).mean() / len(seeds)
    assert excess.max() < 0.25  # about 1 at random


def test_prefixes_of_a_flat_set_are_blue():
    flat = as_density(np.ones((64, 64)), toroidal=True)
    x = adaptive_points("gbn[gradients=30]", flat, 512)
    floors = prefix_noise_floors(x[progressive_order(flat, x)] / 64, [64, 128, 180, 256])
    # At most 2e-2 as the uniform method's prefixes (progressivegbn); a random half has 0.5.
    assert floors.max() < 0.03


def test_sums_are_those_over_all_pairs_and_fall_by_exchanges():
    density = as_density(HALVES, toroidal=True)
    x = np.random.default_rng(0).random((160, 2)) * 32
    widths, pulls = PREFIXES.pull(density, 20, x)
    choice = PrefixChoice(x, widths, pulls, density.shape)
    choice.take_out_clusters(20)
    assert choice.inside.sum() == 20

    def energy(inside):
        apart = x[:, None] - x
        apart -= 32 * np.rint(apart / 32)
        variance = widths[:, None] ** 2 + widths**2
        gaussians = np.exp(-(apart**2).sum(axis=2) / (2 * variance)) / (2 * np.pi * variance)
        return 0.5 * gaussians[np.ix_(inside, inside)].sum() - pulls[inside].sum()

    before = choice.energy()
    assert before == pytest.approx(energy(choice.inside), rel=1e-4)  # Gaussians end at 4.5 widths
    choice.exchange()
    assert choice.inside.sum() == 20
    assert choice.energy() == pytest.approx(energy(choice.inside), rel=1e-4)
    assert choice.energy() < before


def test_pulls_are_the_densitys_where_it_is_flat():
    flat = as_density(np.ones((32, 32)), toroidal=True)
    widths, pulls = PREFIXES.pull(flat, 64, np.random.default_rng(1).random((150, 2)) * 32)
    assert pulls == pytest.approx(64 / 1024, rel=1e-5)
    assert widths == pytest.approx(0.8 * 4 / np.sqrt(2), rel=1e-5)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_few_points_are_ordered(n):
    density = as_density(HALVES)
    x = adaptive_points("rejection", density, n)
    assert sorted(progressive_order(density, x)) == list(range(n))


def test_points_that_coincide_are_ordered():
    x = np.full((6, 2), 3.5)
    assert sorted(progressive_order(as_density(HALVES), x)) == list(range(6))
