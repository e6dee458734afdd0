"""The descent by the pair correlation function: counts, forces, its target, and how near sets come."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import toroidal_distance
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate
from gbnbench.generators.spectral_control.correlation_descent import CorrelationDescent, step_correlation
from gbnbench.generators.spectral_control.named_profiles import PeakProfile, StepProfile
from gbnbench.generators.spectral_control.single_peak import SinglePeak
from gbnbench.generators.spectral_control.step import Step
from gbnbench.generators.spectral_control.target_correlation import pair_correlation_of

EDGE = 1 / math.sqrt(math.pi)


def test_a_step_has_the_correlation_of_its_transform() -> None:
    r = np.linspace(0.05, 4, 40)
    numeric = pair_correlation_of(StepProfile(EDGE), 2, 2.0, r)
    assert step_correlation(EDGE, r) == pytest.approx(numeric, abs=2e-3)  # its midpoint rule at a jump


def test_pairs_are_counted_and_smoothed() -> None:
    n = 100
    x = realization_rng(0, 0).random((n, 2))
    descent = CorrelationDescent(n, StepProfile(EDGE), 2.0)
    distances = np.concatenate([toroidal_distance(x[k + 1 :], x[k]) for k in range(n - 1)])
    edges = np.linspace(0, 0.5, n + 1)
    counted = np.histogram(distances, edges)[0] / (n * (n - 1) / 2 * math.pi * np.diff(edges**2))
    k = np.arange(n)
    window = np.exp(-((k[:, None] - k) ** 2) / (2 * 8.0**2)) * (np.abs(k[:, None] - k) <= 40)
    assert descent.correlation(x) == pytest.approx(window @ counted / window.sum(axis=1), rel=1e-9)


def test_the_correlation_of_random_points_is_one() -> None:
    descent = CorrelationDescent(400, StepProfile(EDGE), 2.0)
    mean = np.mean([descent.correlation(realization_rng(0, k).random((400, 2))) for k in range(10)], axis=0)
    assert mean[60:] == pytest.approx(1, abs=0.03)  # of 1e4 pairs and more in a smoothed bin
    assert descent.misfit(np.ones(400)) == pytest.approx(math.sqrt(0.5 * np.mean((descent.target - 1) ** 2)))


def test_forces_are_those_of_all_pairs() -> None:
    n = 70
    x = realization_rng(1, 0).random((n, 2))
    descent = CorrelationDescent(n, StepProfile(EDGE), 2.0)
    g = descent.correlation(x)
    h = 0.5 / n
    table = np.cumsum(h * (g - descent.target)) / (n * np.r_[1 / n, (np.arange(1, n) * h) ** 2])
    table[int(0.49 / h) :] = 0
    expected = np.zeros((n, 2))
    for i in range(n):
        apart = x[i] - np.delete(x, i, axis=0)
        apart -= np.rint(apart)
        r = np.sqrt(np.sum(apart**2, axis=1))
        expected[i] = np.interp(r / h, np.arange(n), table, right=0.0) @ apart
    assert descent.forces(x, g) == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("target", [StepProfile(EDGE), PeakProfile(0.8, 0.21, 0.05)])
def test_the_misfit_falls(target: StepProfile | PeakProfile) -> None:
    start = realization_rng(2, 0).random((128, 2))
    descent = CorrelationDescent(128, target, 2.0)
    end = descent.run(start, 120, None)
    before, after = (descent.misfit(descent.correlation(x)) for x in (start, end))
    assert after < before / 2


def test_a_set_of_any_size_comes_out_and_progress_with_it() -> None:
    told: list[tuple[int, int, str]] = []
    for n in (1, 2, 20):
        x = Step(method="correlation", iterations=3).draw(
            n, 2, [realization_rng(0, 0)], Monitor(lambda *said: told.append(said))
        )
        assert x.shape == (1, n, 2)
    assert told[-1][2].startswith("set 1, misfit")
    assert all(0 <= done <= most for done, most, _ in told)


def test_what_cannot_be_had_is_refused() -> None:
    assert "nearest is 2" in str(SinglePeak(method="correlation").refusal(100, 3))
    with pytest.raises(RefusalError, match="nearest is 4096"):
        generate("step[method=correlation]", n=5000)
