"""Measures where no cube of frequencies is affordable: shells as far as they go, the rest with its cost."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis import affordable_powers
from gbnbench.analysis.measures import analyse, measures
from gbnbench.analysis.spectrum.listed_shells import half_ball
from tests.oracles.power import direct_power

OF_THE_PLANE = {"bond_order", "psi6", "valence6", "effective_nyquist", "oscillations"}
FITS = {
    "profile_epsilon", "profile_c", "profile_residual_db", "powerlaw_exponent", "powerlaw_residual_db"
}  # fmt: skip


def sets(d: int, n: int, realizations: int) -> np.ndarray:
    return np.random.default_rng(d).random((realizations, n, d))


@pytest.mark.parametrize(("d", "n"), [(20, 12), (50, 8)])
def test_what_is_affordable_is_what_direct_sums_give(d: int, n: int) -> None:
    x = sets(d, n, 2)
    found = measures(x)
    square, f = half_ball(d, 2)
    each = np.array([direct_power(one, f) for one in x])
    first = each[:, square == 1].mean(axis=1)
    assert found["power_at_1"] == pytest.approx(first.mean(), rel=1e-12)
    assert found.standard_error["power_at_1"] == pytest.approx(abs(first[0] - first[1]) / 2, rel=1e-9)
    below = square < n ** (2 / d) * (1 - 1e-9)
    energy = -2 * np.where(each < 1, np.log(each), 0)[:, below].sum(axis=1) / n
    assert found["evacuated_energy"] == pytest.approx(energy.mean(), rel=1e-11)
    missing = {name for name in found if math.isnan(found[name])}
    assert missing == set(found.reasons)
    assert missing >= OF_THE_PLANE | FITS
    assert not missing & {"noise_floor", "anisotropy_db", "discrepancy_wd", "discrepancy_star"}
    assert ("min_distance" in missing) == (d > 24)


def test_what_is_too_far_says_what_the_next_shell_costs() -> None:
    reason = measures(sets(50, 16, 1)).reasons["peak"]
    assert "shells up to |f|^2 = 3 are affordable by default, the next one would make it" in reason
    assert "3.8e+06 frequencies" in reason  # 1 + 100 + 4,900 + 156,800 + 3,684,900 = 3,846,701


@pytest.mark.parametrize(("n", "d"), [(1, 20), (2, 20), (1, 100), (2, 100)])
def test_one_and_two_points_have_their_first_shell(n: int, d: int) -> None:
    x = sets(d, n, 1)
    found = measures(x)
    phases = np.exp(-2j * np.pi * x[0]).sum(axis=0)
    assert found["power_at_1"] == pytest.approx(float(np.mean(np.abs(phases) ** 2)) / n, rel=1e-12)
    assert {name for name in found if math.isnan(found[name])} == set(found.reasons)


def test_shells_beyond_a_small_cube_extend_it_and_change_nothing_of_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    x = sets(10, 48, 3)
    whole = analyse(x)
    monkeypatch.setattr(affordable_powers, "affordable_square", lambda *_: 1)
    alone = analyse(x)
    for name, value in alone.measures.items():
        if not math.isnan(value):
            assert whole.measures[name] == value
            assert whole.measures.standard_error[name] == alone.measures.standard_error[name]
    assert {"peak", "anisotropy_db"} <= set(alone.measures.reasons)
    assert not {"peak", "anisotropy_db"} & set(whole.measures.reasons)
    ends = len(alone.radial.power)
    assert np.array_equal(whole.radial.power[:ends], alone.radial.power)
    square, f = half_ball(10, 4)
    power = np.mean([direct_power(one, f) for one in x], axis=0)
    expected = [power[square == k].mean() for k in (1, 2, 3, 4)]
    assert whole.radial.power[:4] == pytest.approx(expected, rel=1e-12)
    assert np.all(np.diff(whole.radial.frequency) > 0)


def test_a_ball_measures_what_a_cube_does(monkeypatch: pytest.MonkeyPatch) -> None:
    x = sets(4, 20, 3)
    cube = measures(x)
    monkeypatch.setattr(affordable_powers, "MOST_CUBE", 0)
    ball = measures(x)
    assert set(ball.reasons) == set(cube.reasons)
    for name in cube:
        assert ball[name] == pytest.approx(cube[name], rel=1e-10, nan_ok=True)
        assert ball.standard_error[name] == pytest.approx(cube.standard_error[name], rel=1e-6, nan_ok=True)
