"""Scalars of the radial profile on spectra whose values are known."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.radial import profile_measures
from gbnbench.analysis.radial.radial_power import mean_over_groups
from gbnbench.analysis.spectrum.shells import exact_shells, in_band
from gbnbench.core.errors import RefusalError

N, FMAX = 400, 40


def made_of(function):
    f = np.indices((2 * FMAX + 1,) * 2) - FMAX
    return mean_over_groups(function(np.hypot(*f) / 20), exact_shells(FMAX, 2), 1 / 20)


def test_an_exponential_profile_gives_its_own_parameters():
    gbn = made_of(lambda nu: 3e-10 * np.exp(4 * np.pi**2 * nu**2))
    fit = profile_measures.exponential_fit(gbn)
    assert math.exp(fit.intercept) == pytest.approx(3e-10, rel=1e-9)
    assert fit.slope == pytest.approx(4 * np.pi**2, rel=1e-10)
    assert fit.residual_db < 1e-9 < 1 < profile_measures.powerlaw_fit(gbn).residual_db


def test_a_power_law_gives_its_own_exponent():
    with np.errstate(divide="ignore"):
        cellular = made_of(lambda nu: 0.2 * nu**4)
    fit = profile_measures.powerlaw_fit(cellular)
    assert (fit.slope, math.exp(fit.intercept)) == (pytest.approx(4), pytest.approx(0.2))
    assert fit.residual_db < 1e-9 < 1 < profile_measures.exponential_fit(cellular).residual_db


def test_the_residual_is_root_mean_square_decibels():
    wavy = made_of(lambda nu: np.where(np.rint(400 * nu**2) % 2 == 0, 10**0.1, 10**-0.1))
    assert profile_measures.exponential_fit(wavy).residual_db == pytest.approx(1, rel=0.05)


def test_fits_of_steep_profiles_against_forty_digits():
    """Powers over 24 decades, whose logarithms are large, against exact normal equations."""
    radial = made_of(lambda nu: 1e-24 * np.exp(150 * np.minimum(nu, 1) ** 2 + np.sin(40 * nu)))
    band = in_band(radial.nu, 0.05, 0.6)
    with mpmath.workdps(40):
        target = [mpmath.log(mpmath.mpf(float(p))) for p in radial.power[band]]
        fits = {
            profile_measures.exponential_fit: [mpmath.mpf(float(nu)) ** 2 for nu in radial.nu[band]],
            profile_measures.powerlaw_fit: [mpmath.log(mpmath.mpf(float(nu))) for nu in radial.nu[band]],
        }
        for fit, abscissa in fits.items():
            count = len(target)
            x, y = mpmath.fsum(abscissa) / count, mpmath.fsum(target) / count
            slope = mpmath.fsum((a - x) * (t - y) for a, t in zip(abscissa, target, strict=True))
            slope /= mpmath.fsum((a - x) ** 2 for a in abscissa)
            rest = [t - y - slope * (a - x) for a, t in zip(abscissa, target, strict=True)]
            decibels = 10 / mpmath.log(10) * mpmath.sqrt(mpmath.fsum(r * r for r in rest) / count)
            found = fit(radial)
            assert found.slope == pytest.approx(float(slope), rel=1e-13)
            assert found.intercept == pytest.approx(float(y - slope * x), rel=1e-13)
            assert found.residual_db == pytest.approx(float(decibels), rel=1e-12)


def test_evacuated_energy_against_forty_digits():
    """Powers that fall short of 1 by 1e-9 beside some of 1e-20."""
    rng = np.random.default_rng(2)
    side, n = 2 * FMAX + 1, N
    half = np.where(rng.random(side * side // 2) < 0.5, 1 - 1e-9 * rng.random(side * side // 2), 1e-20)
    power = np.concatenate([half, [n], half[::-1]]).reshape(side, side)
    square = np.sum((np.indices((side, side)) - FMAX) ** 2, axis=0).ravel()
    with mpmath.workdps(40):
        logarithms = [
            mpmath.log(mpmath.mpf(float(p)))
            for p, s in zip(power.ravel(), square, strict=True)
            if 0 < s < n and p < 1
        ]
        expected = float(-mpmath.fsum(logarithms) / n)
    assert profile_measures.evacuated_energy(power, n, 2, FMAX) == pytest.approx(expected, rel=1e-14)


def test_floor_and_power_at_1_are_plain_means_over_frequencies():
    f = np.indices((2 * FMAX + 1,) * 2) - FMAX
    r2 = (f**2).sum(axis=0)
    power = np.random.default_rng(1).random(r2.shape)
    power = power + np.flip(power)
    radial = mean_over_groups(power, exact_shells(FMAX, 2), 1 / 20)
    assert profile_measures.noise_floor(radial) == pytest.approx(power[(r2 > 0) & (r2 <= 25)].mean())
    assert profile_measures.power_at_1(radial) == pytest.approx(power[r2 == 1].mean())


def test_the_floor_of_a_small_set_is_its_lowest_shell():
    radial = mean_over_groups(np.arange(25.0).reshape(5, 5), exact_shells(2, 2), 1 / 2)
    assert profile_measures.noise_floor(radial) == profile_measures.power_at_1(radial) == 12.0


def test_the_peak_is_over_whole_rings_and_says_where():
    radial = made_of(lambda nu: 1 + np.exp(-(((nu - 1.1) / 0.05) ** 2)) + 9 * (nu > 1.99))
    value, nu = profile_measures.peak(radial)
    assert nu == pytest.approx(1.1)
    assert value == pytest.approx(1.95, abs=0.06)


def test_evacuated_energy_is_the_sum_of_logarithms_below_one():
    rng = np.random.default_rng(2)
    power = rng.exponential(size=(2 * FMAX + 1,) * 2)
    f = np.indices(power.shape) - FMAX
    r2 = (f**2).sum(axis=0)
    expected = -sum(math.log(p) for p, q in zip(power.flat, r2.flat, strict=True) if 0 < q < N and p < 1) / N
    assert profile_measures.evacuated_energy(power, N, 2, FMAX) == pytest.approx(expected)


def test_what_a_spectrum_cannot_tell_is_refused():
    small = mean_over_groups(np.ones((5, 5)), exact_shells(2, 2), 1 / 20)
    with pytest.raises(RefusalError, match="three shells"):
        profile_measures.exponential_fit(mean_over_groups(np.ones((5, 5)), exact_shells(2, 2), 1 / 2))
    with pytest.raises(RefusalError, match="nu = 1"):
        profile_measures.peak(small)
    with pytest.raises(RefusalError, match="fmax >= 19"):
        profile_measures.evacuated_energy(np.ones((37, 37)), N, 2, 18)
    with pytest.raises(RefusalError, match="0 to rounding"):
        profile_measures.evacuated_energy(np.full((39, 39), 1e-30), N, 2, 19)
    for measure in (
        profile_measures.noise_floor,
        profile_measures.exponential_fit,
        profile_measures.powerlaw_fit,
    ):
        with pytest.raises(RefusalError, match="fmax >= "):
            measure(mean_over_groups(np.ones((9, 9)), exact_shells(4, 2), 1 / 20))
    with pytest.raises(RefusalError, match="beyond rounding"):
        profile_measures.powerlaw_fit(mean_over_groups(np.zeros((39, 39)), exact_shells(19, 2), 1 / 20))


@pytest.mark.parametrize(("n", "d"), [(512, 2), (2048, 2), (100, 2), (2, 2), (1000, 3), (343, 3), (1024, 4)])
def test_shells_exactly_on_a_bands_edge_count_whatever_their_nu_rounded_to(n, d):
    """nu <= q is |f|^2d <= q^2d n^2: decided in whole numbers here."""
    fmax = math.ceil(n ** (1 / d)) + 2
    shells = exact_shells(fmax, d)
    nu = shells.radius * n ** (-1 / d)
    for a, b in ((1, 4), (3, 5), (1, 20), (1, 10), (1, 1), (1, 2), (2, 1)):
        squares = [round(r * r) for r in shells.radius.tolist()]
        at_most = [s**d * b ** (2 * d) <= a ** (2 * d) * n * n for s in squares]
        at_least = [s**d * b ** (2 * d) >= a ** (2 * d) * n * n for s in squares]
        assert in_band(nu, 0, a / b).tolist() == at_most
        assert in_band(nu, a / b, np.inf).tolist() == at_least


@pytest.mark.parametrize(("n", "d", "fmax"), [(1024, 8, 2), (400, 2, 19), (512, 3, 7), (512, 3, 9)])
def test_evacuated_energy_takes_in_the_cubes_corners_and_leaves_out_nu_1(n, d, fmax):
    power = np.full((2 * fmax + 1,) * d, math.exp(-1))
    f2 = sum(np.meshgrid(*[np.arange(-fmax, fmax + 1) ** 2] * d, indexing="ij"))
    inside = np.count_nonzero(
        (f2 > 0) & (f2.astype(object) ** d < n * n if d < 5 else (f2 > 0) & (f2 < n ** (2 / d)))
    )
    assert profile_measures.evacuated_energy(power, n, d, fmax) == pytest.approx(inside / n, rel=1e-12)
