"""Indicators of half spaces: integrals against exact sums over corners."""

from __future__ import annotations

import itertools
import math

import mpmath
import numpy as np
import pytest
from scipy.stats import qmc

from gbnbench.analysis.integration.integrands.half_space import HalfSpace, HalfSpaces
from gbnbench.core.errors import InputError


def corners(half: HalfSpace) -> float:
    """Barrow & Smith's sum in 400 digits, over all corners."""
    with mpmath.workdps(400):
        normal = [mpmath.mpf(v) for v in half.normal if v]
        point = [mpmath.mpf(p) for p, v in zip(half.point, half.normal, strict=True) if v]
        d = len(normal)
        level = mpmath.fdot(normal, point)
        total = mpmath.mpf(0)
        for corner in itertools.product((0, 1), repeat=d):
            rest = mpmath.fdot(normal, corner) - level
            if rest > 0:
                total += (-1) ** (d - sum(corner)) * rest**d
        return float(total / (mpmath.factorial(d) * mpmath.fprod(normal)))


@pytest.mark.parametrize("d", [1, 2, 3, 5, 8, 12])
def test_the_integral_is_that_of_all_corners_in_many_digits(d: int) -> None:
    rng = np.random.default_rng(d)
    for _ in range(6 if d < 12 else 1):
        half = HalfSpaces().draw(d, rng)
        assert half.integral == pytest.approx(corners(half), abs=2e-16)
        series = half.by_series()
        assert series is None or series == pytest.approx(half.integral, abs=2e-14)


@pytest.mark.parametrize("d", [9, 12, 13, 14])
def test_series_and_whole_numbers_agree(d: int) -> None:
    rng = np.random.default_rng(d)
    for _ in range(3):
        half = HalfSpaces().draw(d, rng)
        assert half.by_series() == pytest.approx(half.by_corners(), abs=5e-15)
        assert half.integral == (half.by_corners() if d <= 12 else half.by_series())


@pytest.mark.parametrize("d", [1, 2, 3, 5, 8, 12, 16, 20])
def test_halves_fill_the_box_and_equal_sides_are_those_of_irwin_and_hall(d: int) -> None:
    rng = np.random.default_rng(d)
    half = HalfSpaces().draw(d, rng)
    other = HalfSpace(half.point, -half.normal)
    assert half.integral + other.integral == pytest.approx(1, abs=1e-14)
    for level in (0.3 * d, 0.5 * d, 0.61 * d):
        whole = HalfSpace(np.full(d, level / d), np.ones(d))
        with mpmath.workdps(60):
            at = mpmath.fdot(whole.point, np.ones(d))
            terms = [(-1) ** k * math.comb(d, k) * (at - k) ** d for k in range(d + 1) if at > k]
            assert whole.integral == pytest.approx(
                1 - float(mpmath.fsum(terms) / mpmath.factorial(d)), abs=2e-14
            )


def test_sides_of_zero_and_planes_beyond_the_box_are_served() -> None:
    assert HalfSpace(np.array([0.25, 0.9]), np.array([1.0, 0.0])).integral == 0.75
    assert HalfSpace(np.full(20, 0.25), np.eye(20)[3]).integral == 0.75  # its series would not end
    assert HalfSpace(np.array([0.5, 0.0]), np.array([-1.0, -1.0])).integral == 0.125
    assert HalfSpace(np.array([2.0, 2.0]), np.array([1.0, 1.0])).integral == 0
    assert HalfSpace(np.array([2.0, 2.0]), np.array([-1.0, -1e-200])).integral == 1
    assert HalfSpace(np.full(16, 1.5), np.ones(16)).integral == 0
    assert HalfSpace(np.full(16, -0.5), np.ones(16)).integral == 1
    with pytest.raises(InputError, match="normal that is not 0"):
        HalfSpace(np.zeros(2), np.zeros(2))


@pytest.mark.parametrize("d", [2, 5, 12, 20])
def test_values_have_the_integral(d: int) -> None:
    half = HalfSpaces().draw(d, np.random.default_rng(7 * d))
    x = qmc.Sobol(d, seed=1).random_base2(16)
    assert half(x).mean() == pytest.approx(half.integral, abs=0.004)
    assert set(np.unique(half(x))) <= {0.0, 1.0}


def test_it_has_no_frequencies() -> None:
    assert HalfSpaces().frequencies(3, 0.1).shape == (0, 3)
    assert "d = 1 to 20" in str(HalfSpaces().refusal(0))
