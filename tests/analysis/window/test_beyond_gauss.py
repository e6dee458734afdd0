"""Powers of thinned patterns go together as their fourth cumulants say, which widens the errors of fits."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.window.gamma_regression import errors, gamma_regression, profile_interval
from gbnbench.analysis.window.hyperuniformity import FOURTH_CUMULANTS, beyond_gauss


@pytest.mark.parametrize("kept", [0.2, 0.42, 0.5, 0.8])
def test_powers_of_a_thinned_grid_have_the_covariance_of_the_formula(kept):
    sites, sets = 32, 150_000
    rng = np.random.default_rng(0)
    there = (rng.random((sets, sites)) < kept).astype(np.float64)
    there = there[there.any(axis=1)]
    waves = np.exp(-2j * np.pi * np.outer(np.arange(sites) / sites, [3, 7]))
    powers = np.abs(there @ waves) ** 2 / there.sum(axis=1, keepdims=True)
    powers /= powers.mean(axis=0)
    found = np.mean((powers[:, 0] - 1) * (powers[:, 1] - 1))
    q, n = 1 - kept, kept * sites
    stated = ((1 - 6 * kept * q) / q - 2 * (1 - 2 * kept) + q) / n
    assert found == pytest.approx(stated, abs=4 / np.sqrt(sets) + 1.5 / n**2)
    assert stated >= -FOURTH_CUMULANTS / n


def test_the_constant_is_the_least_that_the_formula_gives():
    p = np.linspace(0.001, 0.999, 9_981)
    q = 1 - p
    least = ((1 - 6 * p * q) / q - 2 * (1 - 2 * p) + q).min()
    assert -FOURTH_CUMULANTS <= least < -FOURTH_CUMULANTS + 0.01
    assert beyond_gauss(100, 2) == pytest.approx(0.54 * 2.25 / 100)


def test_the_allowance_adds_the_square_of_all_weights_and_widens_the_interval():
    u = np.linspace(0.1, 1, 6)
    design, degrees = np.stack([np.ones(6), u], axis=1), np.full(6, 20.0)
    s = np.array([0.4, 0.6, 0.5, 0.8, 0.7, 0.9])
    fit = gamma_regression(design, s, degrees, np.array([0.5, 0.0]))
    covariance, slopes = np.diag(1 / degrees), design / fit.means[:, None]
    gauss, independent = errors(slopes, covariance)
    wide, _ = errors(slopes, covariance, 0.01)
    weights = independent @ (slopes * degrees[:, None]).T
    for a in range(2):
        assert wide[a, a] - gauss[a, a] == pytest.approx(0.01 * np.abs(weights[a]).sum() ** 2)
    narrow, wider = (profile_interval(design, s, covariance, fit, more) for more in (0.0, 0.01))
    assert wider[0] < narrow[0] < narrow[1] < wider[1]
