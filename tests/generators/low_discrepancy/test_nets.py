"""Nets in base 2: their quality t counted exactly, exchanges that keep it, and the energy of an exchange."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import chisquare, qmc

from gbnbench.core.errors import InputError
from gbnbench.generators.low_discrepancy.blue_nets import BlueNets
from gbnbench.generators.low_discrepancy.dyadic_net import (
    GaussianEnergy,
    exchangeable_pairs,
    random_net,
)
from gbnbench.generators.low_discrepancy.net_quality import net_quality
from gbnbench.generators.registry import generate


def as_points(y: np.ndarray) -> np.ndarray:
    return np.stack([np.arange(len(y)), y], axis=1) / len(y)


def test_quality_of_sets_known() -> None:
    assert net_quality(generate("hammersley[shift=false]", n=256)) == 0
    assert net_quality(generate("grid[shift=false]", n=256) - 1 / 32) == 4  # 16 points in each column
    diagonal = np.arange(64) / 64
    assert net_quality(np.stack([diagonal, diagonal], axis=1)) == 5


@pytest.mark.parametrize("name", ["sobol", "pmj02"])
def test_every_prefix_of_two_to_the_m_is_a_net(name: str) -> None:
    for seed in range(3):
        x = generate(name, n=1024, d=2, seed=seed)
        assert [net_quality(x[: 2**m]) for m in range(11)] == [0] * 11


@pytest.mark.parametrize("name", ["sobol", "pmj02"])
def test_every_stretch_of_two_to_the_m_is_a_net(name: str) -> None:
    """What makes a (0, 2)-sequence, rather than nets of the prefixes alone."""
    for seed in range(3):
        x = generate(name, n=256, d=2, seed=seed)
        for m in range(9):
            assert {net_quality(x[first : first + 2**m]) for first in range(0, 256, 2**m)} == {0}


@pytest.mark.parametrize(
    ("d", "quality", "bound"),
    [(2, (0,) * 8, 0), (3, (0, 1, 1, 1, 1, 1, 1, 1), 1), (4, (0, 1, 2, 2, 2, 2, 2, 3), 3),
     (5, (0, 1, 2, 2, 2, 3, 3, 3), 5)],
)  # fmt: skip
def test_sobol_has_the_quality_of_its_plain_points(d: int, quality: tuple[int, ...], bound: int) -> None:
    """Owen's scrambling keeps t; Sobol's bound is the sum of the degrees of d - 1 polynomials less 1 each."""
    plain = qmc.Sobol(d, scramble=False).random_base2(8)
    for m, t in enumerate(quality, start=1):
        assert net_quality(plain[: 2**m]) == t <= bound
        assert net_quality(generate("sobol", n=2**m, d=d, seed=m)) == t


@pytest.mark.parametrize("m", [0, 1, 2, 3, 6, 7])
def test_netshuffle_draws_nets(m: int) -> None:
    for seed in range(5):
        assert net_quality(as_points(random_net(m, np.random.default_rng(seed)))) == 0


def test_netshuffle_draws_all_nets_of_four_points_alike() -> None:
    """There are 2**(m 2**(m - 1)) nets: 16 of four points."""
    rng = np.random.default_rng(1)
    drawn = np.array([random_net(2, rng) for _ in range(1600)])
    found, count = np.unique(drawn, axis=0, return_counts=True)
    assert len(found) == 16
    assert chisquare(count).pvalue > 1e-4


@pytest.mark.parametrize("m", [1, 4, 7])
def test_exchanges_keep_the_net(m: int) -> None:
    rng = np.random.default_rng(m)
    y = random_net(m, rng)
    for level in rng.integers(m, size=30):
        pairs = exchangeable_pairs(y, int(level))
        assert np.array_equal(np.sort(pairs, axis=None), np.arange(2**m))
        made = pairs[rng.random(len(pairs)) < 0.5]
        y[made] = y[made[:, ::-1]]
        assert net_quality(as_points(y)) == 0


@pytest.mark.slow
@pytest.mark.parametrize(("m", "sigma"), [(1, 0.5), (5, 0.5), (6, 1.0), (7, 0.7)])
def test_the_change_is_that_of_the_energy_summed_anew(m: int, sigma: float) -> None:
    """What lies beyond four standard deviations is left out: exp(-8) of each of some pairs."""

    def plain(y: np.ndarray) -> float:
        x = as_points(y)
        gap = x[:, None] - x
        images = sum(np.exp(-((gap + k) ** 2) * 2**m / (2 * sigma**2)) for k in range(-3, 4))
        both = np.prod(images, axis=2)
        return float(both.sum() - np.trace(both)) / 2

    energy, y = GaussianEnergy(m, sigma), random_net(m, np.random.default_rng(m))
    start = plain(y)
    for level in range(m):
        pairs = exchangeable_pairs(y, level)
        change = energy.change(y, pairs)
        for k in range(0, len(pairs), max(1, len(pairs) // 4)):
            other = y.copy()
            other[pairs[k]] = y[pairs[k][::-1]]
            assert change[k] == pytest.approx(plain(other) - start, abs=3e-3)


@pytest.mark.parametrize("n", [2, 64, 128])
def test_blue_nets_are_nets(n: int) -> None:
    for sigma in (0.4, 1.0):
        x = BlueNets(sigma=sigma, iterations=30)(n, 2, np.random.default_rng(n))
        assert net_quality(x) == 0


def test_sizes_and_settings_are_refused() -> None:
    assert "nearest is 1024" in str(BlueNets().refusal(1000, 2))
    assert "nearest is 512" in str(BlueNets().refusal(700, 2))
    assert "nearest is 65536" in str(BlueNets().refusal(2**17, 2))
    for settings in ({"sigma": 0.1}, {"sigma": float("nan")}, {"iterations": -1}):
        with pytest.raises(InputError, match=next(iter(settings))):
            BlueNets(**settings)  # type: ignore[arg-type]
