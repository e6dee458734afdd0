"""Variance of crossed estimates and slopes: spreads over many repetitions are what one repetition says."""

from __future__ import annotations

import dataclasses
import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.integration.variance import crossed_mean, slope_of, variance_of
from gbnbench.core.errors import InputError


def crossed(rng, integrands=12, sets=9, scale=1.0, hardness=0.8, luck=0.5):
    """Errors e = sqrt(hardness_i luck_k) noise: their squares are crossed random effects; and E e^2."""
    hard = np.exp(hardness * rng.standard_normal(integrands) - hardness**2 / 2)
    lucky = np.exp(luck * rng.standard_normal(sets) - luck**2 / 2)
    noise = rng.standard_normal((integrands, sets))
    return scale * np.sqrt(np.outer(hard, lucky)) * noise


def test_variance_and_bias_are_the_plain_means():
    errors = crossed(np.random.default_rng(0)) + 0.3
    found = variance_of(errors)
    assert found.value == pytest.approx(np.mean(errors**2), rel=1e-14, abs=0)
    assert found.bias == pytest.approx(errors.mean(), rel=1e-14, abs=0)
    assert found.low < found.value < found.high
    assert found.low * found.high == pytest.approx(found.value**2)


@pytest.mark.parametrize("offset", [0, 2**20])
def test_small_differences_beside_a_large_common_part_against_fractions(offset):
    """Steps of 2^-30 beside 2^20, which use all digits of double: means of such values round steps away."""
    steps = np.random.default_rng(5).integers(0, 8, (5, 4))
    found = crossed_mean(offset + np.ldexp(steps.astype(float), -30))
    e = [[Fraction(int(v), 2**30) for v in row] for row in steps]
    rows, columns = [sum(r) / 4 for r in e], [sum(c) / 5 for c in zip(*e, strict=True)]
    mean = sum(rows) / 5
    residual = sum((e[i][k] - rows[i] - columns[k] + mean) ** 2 for i in range(5) for k in range(4)) / 12
    least = residual / 20
    parts = [sum((r - mean) ** 2 for r in rows) / 4 / 5, sum((c - mean) ** 2 for c in columns) / 3 / 4]
    assert found.standard_error == pytest.approx(math.sqrt(max(sum(parts) - least, least)), rel=1e-13, abs=0)
    assert found.value == pytest.approx(float(offset + mean), rel=4e-16, abs=0)


def test_a_slope_between_close_sizes_keeps_its_digits():
    n = (10**9, 10**9 + 1)
    squares = (Fraction(1), 1 - Fraction(3, 2**32))
    found = slope_of(n, [np.array([[1.0]]), np.array([[math.sqrt(squares[1])]])])
    with mpmath.workdps(40):
        # The error itself is a rounded root, which moves its square by 2^-53.
        square = mpmath.mpf(math.sqrt(squares[1])) ** 2
        exact = float(mpmath.log(square) / mpmath.log1p(mpmath.mpf(1) / 10**9))
    assert found.value == pytest.approx(exact, rel=1e-6, abs=0)


def test_standard_error_is_the_spread_over_repetitions():
    rng = np.random.default_rng(1)
    found = [variance_of(crossed(rng)) for _ in range(4000)]
    spread = np.std([f.value for f in found], ddof=1)
    # Unbiased but for its lower bound, which costs a tenth where neither factor matters (the bias here);
    # heavy tails leave some 5% more after 4000 repetitions.
    said = math.sqrt(np.mean([f.standard_error**2 for f in found]))
    assert 0.93 * spread < said < 1.17 * spread
    spread = np.std([f.bias for f in found], ddof=1)
    said = math.sqrt(np.mean([f.bias_error**2 for f in found]))
    assert 0.97 * spread < said < 1.17 * spread


def test_shifts_of_one_set_are_no_further_sets():
    errors = np.repeat(crossed(np.random.default_rng(2))[:, :, None], 7, axis=2)
    assert dataclasses.astuple(variance_of(errors)) == pytest.approx(
        dataclasses.astuple(variance_of(errors[:, :, 0])), rel=1e-12
    )


def test_a_single_integrand_or_set_leaves_the_spread_over_the_other():
    errors = np.array([[1.0, 2.0, 3.0]])
    assert variance_of(errors).standard_error == pytest.approx(np.std([1, 4, 9], ddof=1) / math.sqrt(3))
    assert variance_of(errors.T).standard_error == pytest.approx(np.std([1, 4, 9], ddof=1) / math.sqrt(3))
    assert math.isnan(variance_of([[2.0]]).standard_error)
    assert math.isnan(variance_of([[2.0]]).low)


def test_a_power_law_is_found_with_the_error_that_repetitions_have():
    rng = np.random.default_rng(3)
    n = (16, 64, 256, 1024)
    slopes = []
    for _ in range(600):
        hard = np.exp(rng.standard_normal(10))  # the same integrands at every n
        errors = [
            np.sqrt(hard)[:, None] * m**-0.75 * rng.standard_normal((10, sets))
            for m, sets in zip(n, (12, 9, 9, 6), strict=True)
        ]
        slopes.append(slope_of(n, errors))
    values = np.array([s.value for s in slopes])
    assert values.mean() == pytest.approx(-1.5, abs=4 * values.std() / math.sqrt(600) + 0.01)
    assert math.sqrt(np.mean([s.standard_error**2 for s in slopes])) == pytest.approx(
        values.std(ddof=1), rel=0.2
    )


def test_an_exact_power_law_has_no_scatter_and_a_bent_one_has():
    n = (4, 16, 64)
    exact = slope_of(n, [np.full((3, 2), m**-1.0) for m in n])
    assert exact.value == pytest.approx(-2, rel=1e-12, abs=0)
    assert exact.standard_error == pytest.approx(0, abs=1e-12)
    assert exact.scatter == pytest.approx(0, abs=1e-12)
    bent = slope_of(n, [np.full((3, 2), v) for v in (1.0, 1.0, 0.1)])  # variances 1, 1, 0.01
    # Least squares through 0, 0, -2 decades: residuals 1/3, -2/3, 1/3.
    assert bent.scatter == pytest.approx(math.sqrt((1 + 4 + 1) / 9 / 3), rel=1e-12, abs=0)


def test_a_variance_of_zero_has_no_slope():
    assert math.isnan(slope_of((4, 16), [np.ones((2, 2)), np.zeros((2, 2))]).value)


@pytest.mark.parametrize("errors", [[], [1.0, 2.0], np.zeros((0, 3)), np.zeros((2, 2, 2, 2))])
def test_other_shapes_are_refused(errors):
    with pytest.raises(InputError, match="integrands, sets"):
        variance_of(errors)


def test_a_slope_needs_two_sizes_and_the_same_integrands():
    with pytest.raises(InputError, match="two different n"):
        slope_of((16, 16), [np.ones((2, 2))] * 2)
    with pytest.raises(InputError, match="same integrands"):
        slope_of((16, 64), [np.ones((2, 2)), np.ones((3, 2))])
