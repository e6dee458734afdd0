"""Sums of waves: values, means and energies against samples."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.integration.integrands.waves import Waves, WaveSum
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import half_ball


@pytest.mark.parametrize("d", [1, 2, 3, 5, 8, 12, 20])
def test_values_are_those_of_the_definition(d: int) -> None:
    rng = np.random.default_rng(d)
    one = Waves(count=9).draw(d, rng)
    assert (one.waves**2).sum(axis=1).max() <= max(1, 512 ** (2 / d))
    for x in rng.random((3, d)):
        with mpmath.workdps(40):
            turns = [
                mpmath.fdot(f.tolist(), x) + mpmath.mpf(p) for f, p in zip(one.waves, one.phases, strict=True)
            ]
            value = mpmath.fsum(mpmath.cospi(2 * t) for t in turns)
        assert one(x[None])[0] == pytest.approx(float(value), abs=9 * 4e-16)


@pytest.mark.parametrize(("d", "m"), [(1, 2048), (2, 64), (3, 20)])
def test_mean_and_energy_are_those_of_samples(d: int, m: int) -> None:
    one = Waves(count=30, reach=0.5 if d > 1 else 1).draw(d, np.random.default_rng(1))
    x = np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1)
    transform = np.abs(np.fft.fftn(one(x)) / m**d) ** 2
    f = Waves(reach=0.5 if d > 1 else 1).frequencies(d, 0.1)
    assert transform.flat[0] < 1e-29
    assert one.energy(f) == pytest.approx(transform[tuple(f.T)], abs=1e-14)
    assert one.energy(-f) == pytest.approx(one.energy(f))
    assert 2 * one.energy(f).sum() == pytest.approx(transform.sum(), rel=1e-12)  # Parseval
    assert one.energy(np.array([[0] * d, [m] * d])).tolist() == [0, 0]


def test_waves_of_one_frequency_meet_in_one_amplitude() -> None:
    one = WaveSum(np.array([[1, -2], [-1, 2], [1, -2], [0, 3]]), np.array([0.1, 0.2, 0.45, 0.7]))
    meet = np.exp(2j * np.pi * 0.1) + np.exp(-2j * np.pi * 0.2) + np.exp(2j * np.pi * 0.45)
    assert one.energy(np.array([[1, -2], [-1, 2], [0, -3], [1, 2]])) == pytest.approx(
        [abs(meet / 2) ** 2, abs(meet / 2) ** 2, 0.25, 0]
    )


def test_the_mean_energy_is_the_mean_over_draws() -> None:
    family, rng = Waves(count=7, reach=0.1), np.random.default_rng(2)
    f = family.frequencies(2, 0.5)
    each = np.array([family.draw(2, rng).energy(f) for _ in range(1500)])
    error = each.std(axis=0) / math.sqrt(len(each))
    assert np.abs(each.mean(axis=0) - family.mean_energy(f)) == pytest.approx(0, abs=4.5 * error.max())
    assert family.mean_energy(np.array([[0, 0], [2, 2]])).tolist() == [0, 0]


def test_variance_over_shifts_is_what_the_spectrum_predicts() -> None:
    rng = np.random.default_rng(5)
    family = Waves(count=5, reach=0.15)
    x, f = rng.random((30, 2)), family.frequencies(2, 0.1)
    one = family.draw(2, rng)
    predicted = 2 * np.sum(one.energy(f) * periodogram(x, frequencies=f).power) / len(x)
    m = 16  # shifts on a grid that the band, |f_a| <= 3, does not overrun: an exact mean
    shifts = np.stack(np.meshgrid(*[np.arange(m) / m] * 2), axis=-1).reshape(-1, 1, 2)
    estimates = one((x + shifts) % 1.0).mean(axis=1)
    assert np.mean(estimates**2) == pytest.approx(predicted, rel=1e-12)


@pytest.mark.parametrize("d", [1, 2, 3, 8, 12, 20])
def test_at_least_the_lowest_shell_is_reached(d: int) -> None:
    f = Waves(reach=1e-6).frequencies(d, 0.5)
    assert len(f) == d
    assert (f == half_ball(d, 1)).all()


def test_settings_and_reaches_out_of_range_are_told() -> None:
    with pytest.raises(InputError, match="count of waves must be at least 1; got 0"):
        Waves(count=0)
    with pytest.raises(InputError, match="reach of waves must be positive; got -1"):
        Waves(reach=-1)
    assert Waves().refusal(20) is None
    reason = Waves(reach=3).refusal(12)
    assert reason is not None
    assert "take a smaller reach" in reason
    with pytest.raises(RefusalError, match="take a smaller reach"):
        Waves(reach=3).draw(12, np.random.default_rng(0))
    with pytest.raises(RefusalError, match="sums of waves are for d = 1 to 20; got d=21"):
        Waves().frequencies(21, 0.5)
