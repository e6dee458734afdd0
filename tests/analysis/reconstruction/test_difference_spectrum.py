"""The power of a set less its density is the periodogram where that is flat, and 1 for independent points."""

from __future__ import annotations

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis.reconstruction.difference_spectrum import TAPER, annular_power, difference_power
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.rejection import Rejection


def test_of_a_flat_density_it_is_the_periodogram_but_for_zero():
    x = np.random.default_rng(1).random((90, 2))
    nu, power = difference_power(x * 30, np.full((30, 30), 90 / 900))
    fmax = len(power) // 2
    wanted = gbnbench.periodogram(x, fmax).power
    wanted[fmax, fmax] = 0  # as many points as there should be
    assert power == pytest.approx(wanted, abs=1e-11)  # rounding of sums of 90 phases, squared
    assert nu[fmax, fmax + 3] == pytest.approx(3 / np.sqrt(90))


@pytest.mark.parametrize("tapered", [False, True])
def test_it_is_that_of_sums_and_integrals_taken_one_by_one(tapered):
    rng = np.random.default_rng(2)
    rho = rng.random((5, 7))
    points = rng.random((12, 2)) * [5, 7]
    _, power = difference_power(points, rho, tapered=tapered, nu_max=0.6)
    f = np.array(power.shape) // 2

    def h(u):
        cosines = np.cos(2 * np.pi * np.arange(4) * u[..., None])
        return (cosines @ np.array(TAPER)) if tapered else np.ones(u.shape)

    parts = 400  # of a pixel, for the midpoint rule: an error of 1e-5 of the integrand
    grid = [(np.arange(s * parts) + 0.5) / (s * parts) for s in (5, 7)]
    for g in [(0, 0), (1, 0), (1, 1), (-1, 1)]:
        waves = [h(u) * np.exp(-2j * np.pi * k * u) for k, u in zip(g, grid, strict=True)]
        means = [w.reshape(s, parts).mean(axis=1) for w, s in zip(waves, (5, 7), strict=True)]
        at = points / [5, 7]
        direct = (np.prod(h(at), axis=1) * np.exp(-2j * np.pi * at @ np.array(g))).sum()
        squares = [(h(u) ** 2).reshape(s, parts).mean(axis=1) for u, s in zip(grid, (5, 7), strict=True)]
        wanted = abs(direct - means[0] @ rho @ means[1]) ** 2 / (squares[0] @ rho @ squares[1])
        assert power[f[0] + g[0], f[1] + g[1]] == pytest.approx(wanted, rel=1e-4)
        assert power[f[0] - g[0], f[1] - g[1]] == pytest.approx(wanted, rel=1e-4)


@pytest.mark.parametrize("tapered", [False, True])
def test_independent_points_of_a_density_have_power_1(tapered):
    rng = np.random.default_rng(3)
    rho = np.linspace(0.1, 2, 20)[:, None] * np.ones(16)
    rho *= 120 / rho.sum()
    density = as_density(rho)
    total = 0.0
    for _ in range(60):
        points = Rejection()(density, rng.poisson(120), rng)
        nu, power = difference_power(points, rho, tapered=tapered)
        total = total + annular_power(nu, power, 0.2).power
    # The first annulus has 8 frequencies, half of them independent, the taper leaves about one: 60 draws.
    assert total / 60 == pytest.approx(1, abs=0.45)
    assert np.mean(total / 60) == pytest.approx(1, abs=0.1)


def test_the_taper_hides_the_borders():
    y, x = np.meshgrid(np.arange(24) + 0.37, np.arange(24) + 0.11, indexing="ij")
    lattice = np.stack([y.ravel(), x.ravel()], axis=1)
    _, power = difference_power(lattice, np.full((24, 24), 1.0), tapered=True, nu_max=0.8)
    # A lattice has no power but at its harmonics, which are 24 cycles off; side lobes are 3e-5 of amplitude.
    assert power[19 - 12 : 19 + 13, 19 - 12 : 19 + 13].max() < 576 * 3e-5**2


def test_annuli_hold_every_frequency_within_reach_once():
    nu = np.hypot(np.arange(-4, 5)[:, None], np.arange(-6, 7)) / 10
    radial = annular_power(nu, np.ones(nu.shape), 0.1)
    assert int(radial.count.sum()) == int(((nu > 0) & (nu <= 0.4)).sum())
    assert radial.power == pytest.approx(1)
