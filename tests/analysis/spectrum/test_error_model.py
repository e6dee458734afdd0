"""Stated errors against measured ones: the bound holds and is not idle, the typical error is typical."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.coordinate_rounding import coordinates, rounded_at_worst
from gbnbench.analysis.spectrum.error_model import rms_for
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.direct_sum import listed_power
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.results.resolution import resolvable_power
from tests.devices import gpu_form
from tests.oracles.power import mean_power, on_grid, root_distance

PRECISIONS = ("double", "float")


def measured(p, x, fmax, f, weights=None):
    """Errors of a cube and of a list at the frequencies f, each with what was stated."""
    truth = mean_power(x, f, weights)
    w = None if weights is None else np.atleast_2d(weights)
    cube, of_cube = cube_powers(p, x, fmax, w)
    listed, of_list = listed_power(p, x, f, w)
    yield root_distance(cube[tuple((f + fmax).T)], truth), of_cube
    yield root_distance(listed, truth), of_list


def drawn(fmax, d, count):
    """Frequencies without zero, which is exact."""
    f = np.random.default_rng([fmax, d]).integers(-fmax, fmax + 1, (count, d))
    return f[f.any(axis=1)]


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize(
    ("n", "d", "fmax"),
    [
        *((1, 2, 20), (2, 1, 50), (3, 3, 4), (10, 2, 10), (100, 1, 300), (100, 2, 20), (100, 8, 1)),
        *((1000, 3, 5), (1000, 8, 1), (5000, 2, 10), (100_000, 2, 5)),
    ],
)
def test_random_sets_are_as_typical_as_stated(precision, n, d, fmax):
    x, f = np.random.default_rng(n + d).random((1, n, d)), drawn(fmax, d, max(12, min(150, 600_000 // n)))
    for met, errors in measured(precision_of(precision), x, fmax, f):
        rms = np.sqrt(np.mean(met**2))
        assert met.max() <= errors.bound
        assert 0.1 * rms < errors.rms < 10 * rms
        assert rms < 1.6 * errors.rms


@pytest.mark.parametrize("precision", PRECISIONS)
def test_random_weights_are_as_typical_as_stated(precision):
    rng = np.random.default_rng(1)
    for weights in (
        rng.standard_normal(700),
        np.where(np.arange(700) < 3, 1.0, 1e-9),
        10.0 ** -rng.integers(0, 9, 700),
    ):
        weights = weights / np.abs(weights).max()
        for met, errors in measured(
            precision_of(precision), on_grid((1, 700, 2), 2), 8, drawn(8, 2, 150), weights
        ):
            assert met.max() <= errors.bound
            assert 0.1 < errors.rms / np.sqrt(np.mean(met**2)) < 10


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("fmax", [2**9, 2**14, 2**17])
def test_large_harmonics_in_which_float_coordinates_count(precision, fmax):
    x, f = on_grid((1, 300, 1), 3), drawn(fmax, 1, 200)
    for met, errors in measured(precision_of(precision), x, fmax, f):
        assert met.max() <= errors.bound
        assert 0.1 < errors.rms / np.sqrt(np.mean(met**2)) < 10
    if precision == "float" and fmax == 2**17:
        assert errors.rms > 1e-5  # not that of the sums


@pytest.mark.parametrize(("d", "bits"), [(1, 20), (2, 24), (3, 28), (2, 40), (1, 60)])
def test_listed_harmonics_of_any_size_in_float(d, bits):
    x, f = on_grid((1, 300, d), 4), drawn(2**bits, d, 200)
    power, errors = listed_power(precision_of("float"), x, f)
    met = root_distance(power, mean_power(x, f))
    assert met.max() <= errors.bound <= 2 * math.sqrt(300)  # no amplitude can be further off
    assert 0.1 < errors.rms / np.sqrt(np.mean(met**2)) < 10


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("bits", [3, 30, 50, 62])
def test_coordinates_below_the_least_that_are_exact(precision, bits):
    rng = np.random.default_rng(5)
    x = np.ldexp(rng.random((1, 400, 2)), -rng.integers(12, 60, (1, 400, 2)))
    x[0, :20] = np.ldexp(rng.random((20, 2)), -1040)  # denormals
    x[0, 20:30] = 5e-324
    x[0, 30:40] = 2.0**-65
    x[0, ::2, 0] += rng.integers(0, 1 << 20, 200) / 2.0**20
    x %= 1
    f = rng.integers(-(2**bits), 2**bits, (60, 2))
    p = precision_of(precision)
    power, errors = listed_power(p, x, f)
    met = root_distance(power, mean_power(x, f))
    assert met.max() <= errors.bound <= 2 * math.sqrt(400)
    if bits == 3:
        cube, of_cube = cube_powers(p, x, 8)
        assert root_distance(cube[tuple((f + 8).T)], mean_power(x, f)).max() <= of_cube.bound


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize(
    ("n", "d", "fmax"),
    [(1, 2, 20), (2, 2, 20), (16, 2, 20), (256, 1, 200), (1024, 2, 12), (4099, 8, 1), (100_000, 2, 9)],
)
def test_coincident_points_are_within_the_bound_and_it_is_not_idle(precision, n, d, fmax):
    p, root = precision_of(precision), np.sqrt(np.longdouble(n))
    worst, worst_listed, f = 0.0, 0.0, drawn(fmax, d, 200)
    for seed in range(4):
        # exact in float too, so that only the arithmetic errs
        place = np.random.default_rng([n, d, seed]).integers(0, 2**32, (1, 1, d)) / 2.0**32
        x = np.repeat(place, n, axis=1)
        cube, errors = cube_powers(p, x, fmax)
        listed, of_list = listed_power(p, x, f)
        worst = max(worst, float(np.abs(np.sqrt(cube.astype(np.longdouble)) - root).max()))
        worst_listed = max(worst_listed, float(np.abs(np.sqrt(listed.astype(np.longdouble)) - root).max()))
    assert worst <= errors.bound <= 100 * worst
    assert worst_listed <= of_list.bound <= 100 * worst_listed


@pytest.mark.parametrize("precision", PRECISIONS)
def test_coincident_points_that_float_rounds_are_within_the_bound(precision):
    x = np.repeat(on_grid((1, 1, 2), 6), 500, axis=1)
    cube, errors = cube_powers(precision_of(precision), x, 300)
    assert np.abs(np.sqrt(cube) - math.sqrt(500)).max() <= errors.bound


@pytest.mark.parametrize("double", [True, False])
@pytest.mark.parametrize("has_double", [True, False])
@pytest.mark.parametrize("n", [1, 200, 9000])
def test_a_device_without_double_says_so_in_its_errors(double, has_double, n):
    if double and not has_double:
        pytest.skip("such a device has no double")
    p, f = gpu_form(double, has_double), drawn(5, 2, 40)
    for x in (on_grid((1, n, 2), n), np.repeat(on_grid((1, 1, 2), 7), n, axis=1)):
        for met, errors in measured(p, x, 5, f):
            assert met.max() <= errors.bound
        if n > 1 and x[0, 0, 0] != x[0, 1, 0]:
            assert 0.1 < errors.rms / np.sqrt(np.mean(met**2)) < 10


@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_mean_of_many_sets_is_within_the_bound_of_one(precision):
    x = np.random.default_rng(8).random((3000, 2, 1))
    f = np.arange(-3, 4)[:, None]
    power, errors = cube_powers(precision_of(precision), x, 3)
    assert root_distance(power, mean_power(x, f)).max() <= errors.bound


@pytest.mark.parametrize(("d", "m", "fmax"), [(1, 256, 600), (2, 16, 40), (4, 4, 4), (8, 2, 1)])
@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_dyadic_lattice_has_nothing_off_its_harmonics_but_the_stated_error(d, m, fmax, precision):
    x = np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1).reshape(-1, d)
    spectrum = periodogram(x, fmax, precision, method="product")
    harmonic = ((np.indices(spectrum.shape) - fmax) % m == 0).all(axis=0)
    off = np.sqrt(spectrum.power[~harmonic])
    assert off.max() <= spectrum.error_bound
    assert np.sqrt(np.mean(off**2)) <= 10 * spectrum.error_rms
    assert np.abs(np.sqrt(spectrum.power[harmonic]) - math.sqrt(len(x))).max() <= spectrum.error_bound


@pytest.mark.parametrize("precision", PRECISIONS)
def test_cancellation_of_points_and_their_copies_moved_by_one_half(precision):
    first = np.random.default_rng(9).integers(0, 2**53, (500, 3))
    x = np.concatenate([first, (first + 2**52) % 2**53]) / 2.0**53
    spectrum = periodogram(x, 5, precision, method="product")
    odd = (np.indices(spectrum.shape) - 5).sum(axis=0) % 2 == 1
    met = np.sqrt(spectrum.power[odd])
    assert met.max() <= spectrum.error_bound
    assert 0.1 < spectrum.error_rms / np.sqrt(np.mean(met**2)) < 10


def test_a_power_of_1e_25_is_seen():
    x = np.arange(256)[:, None] / 256
    step = math.asin(math.sqrt(1e-25 * 256) / 2) / math.pi
    x[0] = step
    spectrum = periodogram(x, 3)
    for f in (1, 2, 3):
        truth = 4 * math.sin(math.pi * f * step) ** 2 / 256
        assert abs(math.sqrt(spectrum.power[3 + f]) - math.sqrt(truth)) <= spectrum.error_bound
        assert spectrum.power[3 + f] == pytest.approx(truth, rel=0.01)
    assert spectrum.resolvable < 1e-25


def test_coordinates_are_measured_as_they_are():
    x = np.array([[[0.5, 0.25], [2.0**-65, 0.0], [2.0**-66 + 2.0**-64, 0.5]]])
    found = coordinates(x, "double")
    assert found.coherent == pytest.approx((2.0**-65 + 2.0**-66) / math.sqrt(3), rel=1e-12)
    assert found.scattered == pytest.approx(math.sqrt((2.0**-130 + 2.0**-132) / 3), rel=1e-12)
    assert found.share == math.sqrt(3)
    assert coordinates(np.full((1, 4, 2), 0.3), "double").coherent == 0
    w = np.array([[1.0, 2.0, 0.0]])
    weighted = coordinates(x, "double", w)
    assert weighted.share == pytest.approx(3 / math.sqrt(5))
    assert weighted.coherent == pytest.approx(2 * 2.0**-65 / math.sqrt(5))
    assert weighted.scattered == pytest.approx(2 * 2.0**-65 / math.sqrt(5))
    two = np.concatenate([np.full((1, 3, 2), 0.5), x])
    assert coordinates(two, "double") == found  # the worst of the sets
    rough = coordinates(np.full((1, 9, 1), 2.0**-33), "float")
    assert rough.coherent == pytest.approx(3 * 2.0**-33)
    for precision in PRECISIONS:
        worst = rounded_at_worst(50, 3, precision)
        seen = coordinates(np.random.default_rng(1).random((1, 50, 3)) * 0.9 + 0.1, precision)
        assert seen.coherent <= worst.coherent
        assert seen.scattered <= 1.2 * worst.scattered
        assert seen.share == worst.share


@given(st.floats(1e-18, 1e-2))
def test_the_least_power_resolved_is_known_to_a_percent(error):
    least = resolvable_power(error)
    assert (math.sqrt(least) + error) ** 2 == pytest.approx(1.01 * least, rel=1e-9)
    assert rms_for(least) == pytest.approx(error, rel=1e-12)


def test_a_spectrum_carries_what_its_evaluation_states():
    x = on_grid((40, 2), 10)
    for spectrum in (periodogram(x, 4), periodogram(x, 4, "float"), periodogram(x, frequencies=[[1, 2]])):
        assert 0 < spectrum.error_rms < spectrum.error_bound
