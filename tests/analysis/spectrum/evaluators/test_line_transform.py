"""Spectra on a line by the gridded FFT, whose kernel deals points to runs, against long double sums."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.evaluators.gridded_fft import host_transform
from gbnbench.analysis.spectrum.evaluators.gridded_fft.dealt_points import DealtPoints
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import real_grid
from gbnbench.analysis.spectrum.evaluators.gridded_fft.powers import fft_powers
from tests.oracles.power import mean_power, on_grid, root_distance

UNIT = {"double": 2.0**-53, "float": 2.0**-24}


def check(precision, x, fmax, weights=None, coincident=1):
    power, errors = fft_powers(precision_of(precision), x, fmax, weights)
    f = np.arange(-fmax, fmax + 1)[:, None]
    met = root_distance(power, mean_power(x, f, None if weights is None else weights[0]))
    assert met.max() <= errors.bound
    assert np.sqrt(np.mean(met**2)) <= max(16 * UNIT[precision], 2 * errors.rms) * np.sqrt(coincident)
    return power


@pytest.mark.parametrize("library", ["scipy", "ducc0"])
@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(
    ("n", "fmax", "sets"), [(1, 3, 1), (2, 40, 2), (1001, 20, 1), (3000, 100, 2), (600, 7, 3)]
)
def test_points_of_any_number_in_few_and_many_runs(library, precision, n, fmax, sets, monkeypatch):
    if library == "ducc0" and not host_transform.ducc_available():
        pytest.skip("ducc0 is not installed")
    monkeypatch.setattr(host_transform, "ducc_available", lambda: library == "ducc0")
    x = on_grid((sets, n, 1), n)
    check(precision, x, fmax)
    check(precision, x, fmax, np.random.default_rng(n).random((1, n)) + 0.1)


def test_crowded_bins_are_dealt_to_runs_in_any_order_of_points():
    p, fmax, n = precision_of("double"), 30, 2000
    x = np.concatenate([on_grid((1, n // 2, 1), 1), on_grid((1, n // 2, 1), 2) / 256], axis=1)
    grid = real_grid(1, fmax, "double")
    points = DealtPoints(p, grid, 1, n, 1, grid.nodes)
    points(p.runtime.readable(x), None, 1, n)
    p.runtime.finish()
    assert all(runs > 5 for _, runs in points.crowds())
    power = check("double", x, fmax)
    for order in (np.argsort(x[0, :, 0]), np.arange(n)[::-1]):
        assert root_distance(power, fft_powers(p, x[:, order], fmax)[0]).max() < 1e-13
    again, _ = fft_powers(p, x, fmax)
    assert np.array_equal(power, again)


@pytest.mark.parametrize("precision", ["double", "float"])
def test_points_at_the_ends_of_the_line(precision):
    ends = np.array([0.0, np.nextafter(1.0, 0.0), 2.0**-60, 0.5, np.nextafter(0.5, 0.0), 1 - 2.0**-32])
    check(precision, np.tile(ends, 41)[None, :, None], 25, coincident=41)  # which err alike
