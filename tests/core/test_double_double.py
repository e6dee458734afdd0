"""Double-double arithmetic against exact fractions."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gbnbench.core.double_double import DoubleDouble, exact_sum, running_sum, two_product, two_sum

numbers = st.floats(-1e100, 1e100).filter(lambda v: v == 0 or abs(v) > 1e-100)


def value(number: DoubleDouble) -> Fraction:
    return Fraction(float(number.high)) + Fraction(float(number.low))


@given(numbers, numbers)
def test_sums_and_products_lose_nothing(a: float, b: float) -> None:
    total, rest = two_sum(a, b)
    assert Fraction(float(total)) + Fraction(float(rest)) == Fraction(a) + Fraction(b)
    product, rest = two_product(a, b)
    assert Fraction(float(product)) + Fraction(float(rest)) == Fraction(a) * Fraction(b)


@pytest.mark.slow
@given(*[st.fractions(-100, 100, max_denominator=10**9)] * 2)
def test_arithmetic_has_106_bits(a: Fraction, b: Fraction) -> None:
    x, y = DoubleDouble.of(a), DoubleDouble.of(b)
    assert abs(value(x) - a) <= abs(a) / 2**105
    assert abs(value(x * y) - a * b) <= abs(a * b) / 2**100
    assert abs(value(x + y) - (a + b)) <= (abs(a) + abs(b)) / 2**103
    assert abs(value(-abs(x)) + abs(a)) <= abs(a) / 2**105


@given(st.lists(st.floats(-1, 1), min_size=1, max_size=40), st.floats(0, 1e15))
def test_sums_beside_a_large_number_are_exact_to_many_digits(small: list[float], large: float) -> None:
    values = DoubleDouble.of(np.array([large, *small, -large]))
    exact = sum(map(Fraction, small), Fraction(0))
    size = 2 * Fraction(large) + sum(abs(Fraction(v)) for v in small)
    assert abs(exact_sum(values) - exact) <= size / 2**80
    around = values.below_less_above()
    total = Fraction(0)
    for k, entry in enumerate(values.high.tolist()):
        total += Fraction(entry)
        assert abs(value(around[np.array(k)]) - (2 * total - exact)) <= size / 2**80


def test_running_sums_of_many_numbers_round_once() -> None:
    values = np.random.default_rng(0).random((2, 100_000))
    for row, sums in zip(values, running_sum(values), strict=True):
        exact = np.cumsum([int(v * 2.0**53) for v in row.tolist()], dtype=object)
        for found, integer in zip(sums[::997].tolist(), exact[::997].tolist(), strict=True):
            assert abs(Fraction(found) - Fraction(integer, 2**53)) <= Fraction(found) / 2**52
