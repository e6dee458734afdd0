"""The periodogram in plain numpy against integer phases on a 2^-1074 grid and long double cosines."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.analysis.spectrum.evaluators.numpy_product import product as numpy_product
from gbnbench.analysis.spectrum.evaluators.numpy_product.errors import numpy_errors
from gbnbench.analysis.spectrum.evaluators.numpy_product.product import numpy_listed_power, numpy_power
from gbnbench.core.errors import InputError
from gbnbench.core.torus import wrap
from tests.oracles.power import roots


def departures(power, x, f, weights=None):
    return np.abs(np.sqrt(power.astype(np.longdouble)) - roots(x, f, weights)).astype(float)


def drawn(fmax, d, count=40):
    return np.random.default_rng(count).integers(-fmax, fmax + 1, (count, d))


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize(
    ("n", "d", "fmax"),
    [
        *((1, 1, 3), (5, 1, 0), (7, 1, 1), (9, 1, 2), (300, 1, 61), (513, 2, 20), (40, 2, 0)),
        *((300, 3, 5), (100, 4, 2), (61, 5, 1), (33, 8, 1), (21, 12, 1)),
    ],
)
def test_scattered_points_in_any_dimension(n, d, fmax, weighted, precision):
    rng = np.random.default_rng(n)
    x = rng.random((n, d))
    weights = rng.standard_normal(n) * 1e200 if weighted else None
    f = drawn(fmax, d)
    cube = numpy_power(x, fmax, precision, weights)
    assert cube.shape == (2 * fmax + 1,) * d
    for power, listed in (
        (cube[tuple((f + fmax).T)], False),
        (numpy_listed_power(x, f, precision, weights), True),
    ):
        errors = numpy_errors(n, d, fmax, precision, x, weights, listed=listed)
        met = departures(power, x, f, weights)
        assert met.max() <= errors.bound
        other = f.any(axis=1)  # DC is rounded where it is stored
        if other.any() and n >= 100:
            assert 0.1 * errors.rms < np.sqrt(np.mean(met[other] ** 2)) < 10 * errors.rms


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(("n", "d", "fmax"), [(64, 2, 12), (1024, 2, 12), (5000, 1, 80), (700, 6, 1)])
def test_coincident_points_are_within_the_bound_and_it_is_not_idle(n, d, fmax, precision):
    rng = np.random.default_rng(d)
    root = np.sqrt(np.longdouble(n))
    f = drawn(fmax, d, 400)
    for weights in (None, np.full(n, 0.7)):
        worst = worst_listed = 0.0
        for _ in range(5):
            x = np.repeat(rng.random((1, d)), n, axis=0)
            cube = numpy_power(x, fmax, precision, weights)
            worst = max(worst, float(np.abs(np.sqrt(cube.astype(np.longdouble)) - root).max()))
            listed = numpy_listed_power(x, f, precision, weights).astype(np.longdouble)
            worst_listed = max(worst_listed, float(np.abs(np.sqrt(listed) - root).max()))
        assert worst <= numpy_errors(n, d, fmax, precision, x, weights).bound <= 120 * worst
        assert worst_listed <= numpy_errors(n, d, fmax, precision, x, weights, listed=True).bound
        assert numpy_errors(n, d, fmax, precision, x, weights, listed=True).bound <= 120 * worst_listed


@pytest.mark.parametrize(("precision", "floor"), [("double", 1e-28), ("float", 1e-10)])
def test_a_dyadic_lattice_is_zero_off_its_harmonics(precision, floor):
    side = np.arange(16) / 16
    x = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    cube = numpy_power(x, 20, precision)
    f = np.arange(-20, 21) % 16 == 0
    harmonic = f[:, None] & f
    assert np.allclose(cube[harmonic], 256, rtol=1e-15 if precision == "double" else 1e-6)
    assert cube[~harmonic].max() < floor


def test_zero_frequency_is_n_and_the_cube_is_exactly_symmetric():
    x = np.random.default_rng(2).random((777, 3))
    cube = numpy_power(x, 3)
    assert cube[3, 3, 3] == 777
    assert np.array_equal(cube, cube[::-1, ::-1, ::-1])


def test_many_small_chunks_and_blocks_change_only_rounding(monkeypatch):
    x = np.random.default_rng(3).random((500, 4))
    weights = np.random.default_rng(4).random(500)
    f = drawn(10**6, 4, 90)
    whole = numpy_power(x, 3, weights=weights), numpy_listed_power(x, f, weights=weights)
    monkeypatch.setattr(numpy_product, "TABLE_BYTES", 50_000)
    monkeypatch.setattr(numpy_product, "BLOCK_BYTES", 2_000)
    monkeypatch.setattr(numpy_product, "LISTED", 117)
    parts = numpy_power(x, 3, weights=weights), numpy_listed_power(x, f, weights=weights)
    for one, other in zip(whole, parts, strict=True):
        np.testing.assert_allclose(np.sqrt(one), np.sqrt(other), atol=1e-13)


@pytest.mark.parametrize("size", [2**20, 2**40, 2**62])
def test_phases_are_exact_at_any_listed_frequency(size):
    x = np.random.default_rng(5).random((200, 3)) * 0.9 + 2.0**-12
    f = np.concatenate([drawn(size, 3, 20), [[size, -size, 1], [-(2**63), 2**63 - 1, 0]]])
    errors = numpy_errors(200, 3, size, x=x, listed=True)
    assert errors.bound < 1e-12
    assert departures(numpy_listed_power(x, f), x, f).max() <= errors.bound


def test_coordinates_that_fixed_point_rounds_are_in_the_bound():
    rng = np.random.default_rng(6)
    x = np.concatenate([rng.random((50, 2)) * 2.0**-13, np.full((50, 2), 5e-324), np.full((50, 2), 2.0**-65)])
    f = drawn(2**40, 2, 30)
    met = departures(numpy_listed_power(x, f), x, f).max()
    known, unknown = (numpy_errors(150, 2, 2**40, x=given, listed=True).bound for given in (x, None))
    assert 1e-8 < met <= known <= unknown
    assert departures(numpy_power(x, 9)[tuple((drawn(9, 2) + 9).T)], x, drawn(9, 2)).max() < 1e-12


@settings(max_examples=20, deadline=None, derandomize=True)
@given(st.integers(1, 60), st.integers(1, 4), st.integers(0, 3), st.integers(0, 2**32))
def test_power_keeps_under_shifts_and_reordering(n, d, fmax, seed):
    rng = np.random.default_rng(seed)
    x = np.floor(rng.random((n, d)) * 2.0**40) / 2.0**40
    weights = rng.random(n) + 0.1
    order = rng.permutation(n)
    shift = np.floor(rng.random(d) * 2.0**40) / 2.0**40
    power = np.sqrt(numpy_power(x, fmax, weights=weights))
    np.testing.assert_allclose(
        np.sqrt(numpy_power(wrap(x + shift), fmax, weights=weights)), power, atol=1e-13
    )
    np.testing.assert_allclose(
        np.sqrt(numpy_power(x[order], fmax, weights=weights[order])), power, atol=1e-13
    )


def test_another_precision_is_refused():
    for call in (
        lambda: numpy_power(np.zeros((1, 1)), 1, "half"),
        lambda: numpy_listed_power(np.zeros((1, 1)), np.zeros((1, 1), np.int64), "half"),
        lambda: numpy_errors(1, 1, 1, "half"),
    ):
        with pytest.raises(InputError, match='"double" or "float"'):
            call()
