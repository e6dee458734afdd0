"""Standard errors against exact fractions: small spreads of large values, one set that outweighs all."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from gbnbench.analysis.standard_errors import jackknife, left_out_sums, mean_over_sets, sample_variance


def exact_variance(values: np.ndarray) -> Fraction:
    each = [Fraction(float(v)) for v in values]
    mean = sum(each, Fraction(0)) / len(each)
    return sum(((v - mean) ** 2 for v in each), Fraction(0)) / (len(each) - 1)


@pytest.mark.parametrize("offset", [0.0, 1.0, 1e6, -1e12])
@pytest.mark.parametrize("sets", [2, 3, 17, 1000])
def test_a_large_common_part_leaves_the_spread_its_digits(offset: float, sets: int) -> None:
    rng = np.random.default_rng(sets)
    values = (
        offset + np.spacing(abs(offset)) * rng.integers(0, 9, sets) + (rng.random(sets) if not offset else 0)
    )
    exact = exact_variance(values)
    assert float(sample_variance(values)) == pytest.approx(float(exact), rel=1e-13, abs=0)
    mean, error = mean_over_sets(values)
    assert mean == pytest.approx(float(sum(map(Fraction, values.tolist())) / sets), rel=1e-15, abs=0)
    assert error == pytest.approx(math.sqrt(exact / sets), rel=1e-13, abs=0)


def test_equal_values_have_no_spread() -> None:
    assert mean_over_sets(np.full(3, 0.1))[1] == 0
    assert mean_over_sets(np.full(7, 1e300))[1] == 0


@pytest.mark.parametrize("m", [2, 3, 8, 13])
def test_sums_of_the_others_keep_their_digits_beside_a_giant(m: int) -> None:
    values = 1e-20 * np.random.default_rng(m).random((m, 4))
    values[m // 2] = 1e6  # as a lattice's harmonic beside blue noise
    for k, total in enumerate(left_out_sums(values)):
        exact = [float(sum(map(Fraction, np.delete(values, k, axis=0)[:, j].tolist()))) for j in range(4)]
        assert total == pytest.approx(exact, rel=1e-15, abs=0)


def test_the_jackknife_of_a_mean_is_its_standard_error() -> None:
    values = np.array([1e-12, 3e-12, 2e-12, 1.0])
    whole = float(values.mean())
    others = ([float(total) / 3] for total in left_out_sums(values))
    ((value, error),) = jackknife([whole], others, 4)
    assert value == whole
    assert error == pytest.approx(math.sqrt(exact_variance(values) / 4), rel=1e-13, abs=0)
    ((_, unknown),) = jackknife([whole], iter(()), 1)
    assert math.isnan(unknown)
