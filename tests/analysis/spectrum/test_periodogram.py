"""The exact periodogram against integer phases in long double, closed forms and laws."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.analysis.spectrum.limits import check_fmax, check_harmonic, largest_fmax
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.power_of_each import each_power
from gbnbench.core.errors import InputError
from tests.oracles.power import direct_power, on_grid, roots

# d, fmax of the cube, n: |f| up to 512 in one and two dimensions as the definition of done asks.
CUBES = ((1, 512, 333), (2, 64, 300), (3, 9, 129), (5, 2, 131), (8, 1, 257))


@pytest.mark.parametrize(("d", "fmax", "n"), CUBES)
@pytest.mark.parametrize(("precision", "allowed"), [("double", 1e-15), ("float", 1e-6)])
def test_the_cube_is_exact(d, fmax, n, precision, allowed):
    rng = np.random.default_rng(d)
    x = on_grid((n, d), rng)
    cube = periodogram(x, fmax, precision).power
    assert cube.shape == (2 * fmax + 1,) * d
    index = rng.integers(0, cube.size, 150)
    f = np.stack(np.unravel_index(index, cube.shape), axis=1) - fmax
    error = (np.sqrt(cube.ravel()[index]) - roots(x, f).astype(float)) * np.sqrt(n)
    assert np.sqrt(np.mean(error**2)) <= allowed * np.sqrt(n)
    assert np.abs(error).max() <= 10 * allowed * np.sqrt(n)


@pytest.mark.parametrize("d", [1, 2, 3, 5, 8])
@pytest.mark.parametrize(
    ("precision", "allowed", "largest"), [("double", 1e-15, 2**40), ("float", 1e-6, 512)]
)
def test_listed_frequencies_are_exact_at_any_size(d, precision, allowed, largest):
    rng = np.random.default_rng(d)
    x = on_grid((301, d), rng)
    if precision == "float":
        x = np.floor(x * 2.0**32) / 2.0**32
    f = rng.integers(-largest, largest + 1, (41, d))
    result = periodogram(x, precision=precision, frequencies=f)
    error = (np.sqrt(result.power) - roots(x, f).astype(float)) * np.sqrt(301)
    assert np.sqrt(np.mean(error**2)) <= allowed * np.sqrt(301)
    assert np.array_equal(np.asarray(result), result.power)
    assert result.shape == (41,) == (len(result),)
    assert np.array_equal(result[3:5] - result.power[3:5], [0, 0])
    assert np.array_equal(result - result.power, np.zeros(41))


@pytest.mark.parametrize(("d", "m", "fmax"), [(1, 16, 40), (2, 8, 20), (3, 4, 6)])
@pytest.mark.parametrize(("precision", "floor"), [("double", 1e-27), ("float", 1e-11)])
def test_a_dyadic_lattice_has_power_n_on_its_harmonics_and_none_off_them(d, m, fmax, precision, floor):
    lattice = np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1).reshape(-1, d)
    power = periodogram(lattice, fmax, precision).power
    f = np.indices(power.shape) - fmax
    harmonic = (f % m == 0).all(axis=0)
    assert power[harmonic] == pytest.approx(len(lattice), rel=1e-6)
    assert power[~harmonic].max() <= floor


def test_the_centre_is_n_axis_a_is_coordinate_a_and_the_mean_is_over_sets():
    rng = np.random.default_rng(3)
    x = rng.random((3, 50, 2))
    x[..., 0] = rng.integers(0, 4, (3, 50)) / 4  # periodic along axis 0 only
    spectrum = periodogram(x, 5)
    assert spectrum.power[5, 5] == pytest.approx(50)
    assert spectrum.power[5 + 4, 5] == pytest.approx(50)
    assert spectrum.power[5, 5 + 4] < 40
    each, mean = each_power(x, 5)
    assert np.array_equal(mean.power, each.mean(axis=0))
    assert spectrum.power == pytest.approx(each.mean(axis=0), rel=1e-14)
    assert spectrum.power == pytest.approx(
        np.mean([periodogram(one, 5).power for one in x], axis=0), rel=1e-14
    )
    assert (spectrum.n, spectrum.d, spectrum.realizations, spectrum.fmax) == (50, 2, 3, 5)


def test_white_noise_has_power_one():
    x = np.random.default_rng(4).random((200, 64, 2))
    power = periodogram(x, 6).power
    power[6, 6] = np.nan
    # 84 independent frequencies, exponentially distributed, 200 sets: five standard errors.
    assert np.nanmean(power) == pytest.approx(1, abs=5 / np.sqrt(84 * 200))


@settings(max_examples=25, deadline=None)
@given(st.integers(1, 4), st.integers(1, 60), st.integers(0, 2**32 - 1))
def test_laws(d, n, seed):
    rng = np.random.default_rng(seed)
    x, fmax = rng.random((n, d)), 3
    power = periodogram(x, fmax).power
    tolerance = {"rel": 1e-9, "abs": 1e-12}
    assert np.array_equal(power, np.flip(power))  # P(-f) = P(f)
    assert periodogram(rng.permutation(x), fmax).power == pytest.approx(power, **tolerance)
    shifted = (x + rng.random(d)) % 1.0
    assert periodogram(shifted, fmax).power == pytest.approx(power, **tolerance)
    axes = rng.permutation(d)
    assert periodogram(x[:, axes], fmax).power == pytest.approx(np.transpose(power, axes), **tolerance)


def test_points_beyond_one_chunk_of_the_tables_are_all_counted():
    x = on_grid((20_001, 2), 5)
    power = periodogram(x, 33).power
    f = np.array([[33, -33], [1, 0], [0, 1], [-7, 20]])
    expected = direct_power(x, f)
    assert power[f[:, 0] + 33, f[:, 1] + 33] == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({}, "either fmax or frequencies"),
        ({"fmax": 2, "frequencies": [[1, 1]]}, "either fmax or frequencies"),
        ({"fmax": 0}, "at least 1"),
        ({"fmax": 2.0}, "integer"),
        ({"fmax": True}, "integer"),
        ({"fmax": 3, "precision": "half"}, "double"),
        ({"frequencies": [[1.5, 0.0]]}, "integers"),
        ({"frequencies": [[1, 0, 0]]}, "(m, 2)"),
        ({"frequencies": [1, 0]}, "(m, 2)"),
    ],
)
def test_bad_requests_are_refused_in_words(arguments, says):
    with pytest.raises(InputError) as refusal:
        periodogram([[0.5, 0.25]], **arguments)
    assert says in str(refusal.value)


def test_a_cube_that_cannot_fit_names_the_one_that_would():
    with pytest.raises(InputError, match="largest fmax that fits is"):
        check_fmax(10**6, 2)
    with pytest.raises(InputError, match="list the frequencies"):
        check_fmax(1, 60)


@pytest.mark.parametrize("d", range(1, 9))
def test_largest_fmax_is_the_largest(d):
    for count in (3**d, 5**d - 1, 5**d, 10**6):
        f = largest_fmax(count, d)
        assert f == 1 or (2 * f + 1) ** d <= count
        assert (2 * f + 3) ** d > count


@pytest.mark.parametrize("weights", [np.ones(3) * 1j, np.ma.masked_less([1.0, 2.0, 3.0], 2), ["a", "b", "c"]])
def test_weights_that_are_no_real_numbers_are_refused(weights):
    x = np.random.default_rng(0).random((3, 2))
    with pytest.raises(InputError, match="weights must be real numbers"):
        periodogram(x, 2, weights=weights)


def test_masked_points_are_refused():
    with pytest.raises(InputError, match="masked"):
        periodogram(np.ma.masked_less([[0.1, 0.5]], 0.3), 2)


def test_what_cannot_be_counted_is_an_error_in_words():
    with pytest.raises(InputError, match="more than 2\\^63"):
        check_harmonic(2, 30)
    assert check_harmonic(1, 39) == 1
