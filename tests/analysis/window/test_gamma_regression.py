"""Gamma regression and profile likelihood against simulations and a direct search."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import minimize

from gbnbench.analysis.window.gamma_regression import (
    NORMAL_95,
    errors,
    gamma_regression,
    profile_interval,
)

U = np.linspace(0.1, 1, 8)
DESIGN = np.stack([np.ones(8), U, U**2], axis=1)


def _mean_powers(truth, degrees, rng):
    return DESIGN @ truth * rng.gamma(degrees, 1 / degrees)


def test_coefficients_and_errors_are_those_put_in():
    rng = np.random.default_rng(0)
    degrees, truth = np.full(8, 100.0), np.array([0.6, 1.0, 0.5])
    found, stated = [], []
    for _ in range(300):
        s = _mean_powers(truth, degrees, rng)
        fit = gamma_regression(DESIGN, s, degrees, np.array([1.0, 0.0, 0.0]))
        counted, independent = errors(DESIGN / fit.means[:, None], np.diag(1 / degrees))
        assert counted == pytest.approx(independent, rel=1e-9)  # nothing goes together here
        found.append(fit.coefficients)
        stated.append(np.sqrt(np.diag(counted)))
    z = (np.array(found) - truth) / stated
    assert np.abs(z.mean(axis=0)).max() < 4 / math.sqrt(300) + 0.1
    assert z.var(axis=0) == pytest.approx(1, abs=0.3)


def test_a_profile_interval_ends_where_a_direct_search_says():
    rng = np.random.default_rng(1)
    degrees = np.array([6.0, 9, 14, 20, 26, 32, 38, 44])
    s = _mean_powers(np.array([0.3, 1.5, -0.2]), degrees, rng)
    fit = gamma_regression(DESIGN, s, degrees, np.array([1.0, 0.0, 0.0]))

    def least(value):
        def deviance(rest):
            mean = value + DESIGN[:, 1:] @ rest
            return 2 * degrees @ (np.log(mean) + s / mean) if mean.min() > 0 else 1e9

        begin = np.array([(s.mean() - min(value, 0)) / U[0], 0.0])
        found = minimize(
            deviance,
            begin,
            method="Nelder-Mead",
            options={"xatol": 1e-9, "fatol": 1e-11, "maxiter": 5000, "maxfev": 5000},
        )
        return found.fun

    for end in profile_interval(DESIGN, s, np.diag(1 / degrees), fit):
        assert least(end) - fit.deviance == pytest.approx(NORMAL_95**2, abs=1e-4)


@pytest.mark.slow
def test_profile_intervals_hold_with_few_variables_that_overlap():
    rng = np.random.default_rng(2)
    parts, truth, sets = 5, np.array([0.5, 0.8, 0.3]), 400
    true = DESIGN @ truth
    covariance = np.zeros((8, 8))
    for i in range(8):
        for j in range(8):
            covariance[i, j] = max(0, 2 - abs(i - j)) / (2 * 2 * parts)
    held = 0
    for _ in range(sets):
        shared = rng.gamma(parts, 1 / parts, 9)
        s = true * (shared[:-1] + shared[1:]) / 2  # neighbours share half of their variables
        fit = gamma_regression(DESIGN, s, 1 / np.diag(covariance), np.array([1.0, 0.0, 0.0]))
        low, high = profile_interval(DESIGN, s, covariance, fit)
        held += low <= truth[0] <= high
    assert held / sets > 0.95 - 4 * math.sqrt(0.95 * 0.05 / sets)
