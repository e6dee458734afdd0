"""The cost of ring means: its gradient against differences, its value against the power; the soft core."""

from __future__ import annotations

import dataclasses
import itertools

import numpy as np
import pytest

from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.generators.spectral_control.named_profiles import PeakProfile, StepProfile, widest_step
from gbnbench.generators.spectral_control.ring_cost import RingCost, ring_width, rings_below
from gbnbench.generators.spectral_control.soft_core import soft_core
from gbnbench.generators.spectral_control.target_correlation import core_of, pair_correlation_of
from gbnbench.generators.spectral_control.target_fit import target_fit

PEAK = PeakProfile(0.7, 0.2, 0.05)


@pytest.mark.parametrize(("n", "d", "core"), [(40, 1, 0.0), (40, 2, 0.0), (40, 2, 0.6), (30, 3, 0.6)])
@pytest.mark.parametrize("target", [StepProfile(0.4), PEAK])
def test_the_gradient_is_the_slope_of_the_cost(n, d, target, core):
    """Central differences over 5e-3 spacings: waves are single, so that the cost errs by 1e-6.

    The core has a kink where two points meet, which on a line some do within a step: none is tried there.
    """
    rng = np.random.default_rng(0)
    u = n ** (1 / d) * rng.random((n, d))
    cost = RingCost(rings_below(n, d, target, 1.5), core)
    way = rng.standard_normal((n, d))
    step = 5e-3 / np.abs(way).max()
    slope = (cost(u + step * way)[0] - cost(u - step * way)[0]) / (2 * step)
    assert np.sum(cost(u)[1] * way) == pytest.approx(slope, rel=3e-2, abs=3e-3)


def test_the_cost_is_that_of_the_periodogram():
    n = 50
    x = np.random.default_rng(1).random((n, 2))
    power = periodogram(x, 10).power
    f = np.indices(power.shape) - 10
    nu = np.sqrt((f**2).sum(axis=0) / n)
    half = (f[0] > 0) | ((f[0] == 0) & (f[1] > 0))
    expected = np.sum((power / np.where(nu > 0, nu, 1) ** 2)[half & (nu < 0.41)])
    rings = np.rint(nu * n**0.5)
    for ring in np.unique(rings[half & (nu >= 0.41) & (nu < 1.3)]):
        inside = half & (rings == ring) & (nu >= 0.41) & (nu < 1.3)
        root = np.sqrt(power[inside].mean())
        expected += inside.sum() * (root - 1) ** 2 * np.mean(1 / nu[inside] ** 2)
    found = RingCost(rings_below(n, 2, StepProfile(0.41), 1.3), 0.0)(n**0.5 * x)[0]
    assert found == pytest.approx(expected / n, rel=1e-5)  # single-precision waves


def test_the_soft_core_is_the_sum_over_pairs_across_the_border_too():
    side = 5.0
    u = side * np.random.default_rng(2).random((25, 2))
    energy = 0.0
    for a, b in itertools.combinations(u, 2):
        apart = (a - b) - side * np.rint((a - b) / side)
        energy += max(0.0, 1 - np.hypot(*apart) / 0.9) ** 2
    found, gradient = soft_core(u, side, 0.9)
    assert found == pytest.approx(energy, rel=1e-12)
    assert energy > 1
    assert np.abs(gradient.sum(axis=0)).max() < 1e-12


def test_two_points_at_one_place_have_a_finite_gradient():
    assert np.isfinite(soft_core(np.ones((2, 3)), 4.0, 0.5)[1]).all()


def test_rings_are_wider_in_one_dimension():
    assert ring_width(1024, 1) == pytest.approx(32)
    assert ring_width(1024, 2) == 1
    assert ring_width(1024, 3) == 1


class TestCorrelation:
    def test_the_widest_step_in_the_plane_has_its_closed_form(self):
        """g(r) = 1 - nu J1(2 pi nu r) / r."""
        from scipy.special import j1

        nu, r = widest_step(2), np.linspace(0.05, 3, 60)
        found = pair_correlation_of(StepProfile(nu), 2, 2.0, r)
        assert found == pytest.approx(1 - nu * j1(2 * np.pi * nu * r) / r, abs=2e-3)

    def test_in_one_and_three_dimensions_it_starts_at_one_less_the_empty_ball(self):
        ball = {1: 2 * 0.3, 3: 4 / 3 * np.pi * 0.3**3}
        for d, volume in ball.items():
            assert pair_correlation_of(StepProfile(0.3), d, 1.5, np.zeros(1))[0] == pytest.approx(
                1 - volume, abs=2e-3
            )

    def test_the_core_is_where_a_tenth_is_passed(self):
        """Near 0 that of the widest step is pi**3 nu**4 r**2 / 2, so that a tenth comes at 0.253 spacings."""
        assert core_of(StepProfile(widest_step(2)), 2, 2.0, 0.1) == pytest.approx(0.26, abs=0.011)
        assert core_of(StepProfile(0.3), 2, 2.0, 0.1) == 0


def test_a_fit_is_measured_of_white_noise():
    """Ring means of 400 sets of white noise are 1 within a few percent: 0.02 for the thinnest ring of 4."""
    x = np.random.default_rng(3).random((400, 64, 2))
    fit = target_fit(x, lambda nu: np.where(nu < 0.5, 0.0, 1.0), 2.0)
    assert fit.stray == pytest.approx(1, abs=0.03)
    assert fit.rms_db < 0.15
    assert fit.power == pytest.approx(np.ones(len(fit.power)), abs=0.1)
    assert np.all(np.diff(fit.nu) > 0)
    tenth = target_fit(x, lambda nu: np.full(len(nu), 0.1), 2.0)
    assert tenth.rms_db == pytest.approx(10, abs=0.1)
    assert np.isnan(tenth.stray)


def test_a_fit_says_in_words_how_near_the_power_came():
    """Of a grid: no power but at its harmonics, so that every number is known."""
    x = np.stack(np.meshgrid(np.arange(8) / 8, np.arange(8) / 8), axis=-1).reshape(-1, 2)
    fit = target_fit(x, lambda nu: np.where(nu < 0.5, 0.0, np.where(nu < 0.9, 0.004, 4.0)), 1.01)
    faint, stray = fit.power[fit.target < 0.01].mean(), fit.stray
    assert (faint, stray) == pytest.approx((0, 0), abs=1e-25)
    power = np.where(fit.target < 0.01, 0.003, fit.target / 2)
    said = str(dataclasses.replace(fit, power=power, stray=1.2e-6))
    assert said == (
        "Up to nu = 1.01: ring means of the power are within 3 dB (rms) of the target; where it asks for "
        "0.01 or less, 0.004 on average, they are 0.003; where it asks for no power, there is 1.2e-06."
    )
