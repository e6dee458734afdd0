"""The Halton sequence: strata of its primes on every axis and in boxes."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.generators.registry import generate
from tests.oracles.power import direct_power

PRIMES = (2, 3, 5, 7, 11)


@pytest.mark.parametrize(("axis", "n"), [(0, 64), (1, 81), (2, 25), (3, 49), (4, 121)])
def test_a_whole_power_of_the_prime_is_a_shifted_grid_on_its_axis(axis: int, n: int) -> None:
    x = generate("halton", n=n, d=5)
    assert np.array_equal(np.sort(np.floor(x[:, axis] * n)), np.arange(n))
    f = np.zeros((2 * n, 5), dtype=int)
    f[:, axis] = np.arange(1, 2 * n + 1)
    power = direct_power(x, f)
    harmonic = f[:, axis] % n == 0
    assert np.allclose(power[harmonic], n, rtol=1e-9)
    assert power[~harmonic].max() < 1e-24


def test_boxes_of_two_primes_hold_one_point_each() -> None:
    x = generate("halton", n=4 * 9 * 5, d=3)
    assert len(np.unique(np.floor(x * [4, 9, 5]), axis=0)) == 180
