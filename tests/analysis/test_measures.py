"""All measures together: every key always there, errors that match the spread, reasons where undefined."""

from __future__ import annotations

import math

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis.measure_definitions import BY_NAME, DEFINITIONS
from gbnbench.analysis.measures import analyse, measures
from gbnbench.analysis.spectrum.limits import default_fmax
from gbnbench.core.errors import InputError
from tests.published_sets import published_files

PROMISED = {
    *("noise_floor", "power_at_1", "profile_epsilon", "profile_c", "evacuated_energy", "peak", "peak_nu"),
    *("anisotropy_db", "min_distance", "mean_distance", "bond_order", "psi6", "valence6"),
    *("effective_nyquist", "oscillations", "powerlaw_exponent"),
}


def test_the_catalogue_defines_every_promised_measure_once():
    assert set(BY_NAME) >= PROMISED
    assert len(BY_NAME) == len(DEFINITIONS)
    assert {d.better for d in DEFINITIONS} == {"lower", "higher"}
    assert all(d.text and d.source and d.title for d in DEFINITIONS)


@pytest.mark.parametrize(
    "shape", [(60, 2), (3, 60, 2), (1, 2), (2, 2), (40, 1), (50, 3), (2, 30, 8), (20, 12)]
)
def test_every_key_is_there_and_what_is_undefined_has_a_reason(shape):
    found = measures(np.random.default_rng(1).random(shape))
    assert list(found) == [d.name for d in DEFINITIONS]
    for name, value in found.items():
        assert math.isnan(value) == (name in found.reasons)
        assert not math.isinf(value)
        if len(shape) == 2 or name in found.reasons:
            assert math.isnan(found.standard_error[name])


def test_means_over_sets_and_of_the_mean_spectrum():
    x = np.random.default_rng(2).random((5, 100, 2))
    together, each = measures(x), [measures(one) for one in x]
    for name in ("noise_floor", "power_at_1", "evacuated_energy", "min_distance", "mean_distance", "psi6"):
        values = np.array([one[name] for one in each])
        assert together[name] == pytest.approx(values.mean(), rel=1e-9)
        assert together.standard_error[name] == pytest.approx(values.std(ddof=1) / math.sqrt(5), rel=1e-9)


@pytest.mark.slow
def test_standard_errors_of_the_mean_spectrum_match_the_spread_over_repetitions():
    rng = np.random.default_rng(3)
    found = [measures(rng.random((8, 36, 2))) for _ in range(40)]
    for name in ("profile_c", "powerlaw_exponent", "anisotropy_db"):
        spread = np.std([m[name] for m in found], ddof=1)
        stated = np.sqrt(np.mean([m.standard_error[name] ** 2 for m in found]))
        assert stated == pytest.approx(spread, rel=0.5), name


def test_a_set_cut_at_the_border_is_called_so_and_toroidal_ones_are_not():
    rng = np.random.default_rng(4)
    inside = (np.stack(np.meshgrid(*[np.arange(16)] * 2), -1).reshape(-1, 2) + rng.random((256, 2))) / 16
    assert analyse(inside).warnings == ()
    assert analyse(rng.random((256, 2))).warnings == ()
    assert analyse(np.stack(np.meshgrid(*[np.arange(15) / 15] * 2), -1).reshape(-1, 2)).warnings == ()
    for cut in (inside * 0.97 + 0.015, inside * [0.9, 1.0]):
        (warning,) = analyse(cut).warnings
        assert "not toroidal" in warning


def test_everything_a_report_draws_is_there_in_the_plane_and_only_what_means_something_elsewhere():
    flat = analyse(np.random.default_rng(5).random((2, 100, 2)))
    assert flat.spectrum.power.shape == (43, 43)
    assert list(flat.rdf.columns) == ["r", "g"]
    assert np.diff(flat.rdf.r) == pytest.approx(0.1)  # PSA's bins would be two thirds of a spacing wide
    assert list(flat.valence.columns)[:2] == ["degree", "share"]
    assert flat.zone_plate.shape[0] == flat.zone_plate.shape[1]
    deep = analyse(np.random.default_rng(5).random((2, 100, 5)))
    assert deep.zone_plate is None
    assert deep.valence is None


def test_the_range_follows_the_request_and_the_means():
    assert default_fmax(1024, 2) == 65  # one beyond nu = 2, whose ring is then whole
    assert default_fmax(4096, 3) == 33
    assert default_fmax(1, 2) == 3
    assert default_fmax(1024, 8) == 3
    assert default_fmax(10**6, 2) == 250  # no more than the noise floor needs


def test_bad_points_are_refused():
    with pytest.raises(InputError, match=r"\[0, 1\)"):
        gbnbench.measures([[0.5, 1.0]])
    with pytest.raises(InputError, match="fmax"):
        gbnbench.measures([[0.5, 0.5]], fmax=0)


def test_published_sets_measure_as_published():
    bnot = measures(np.array([gbnbench.load(p) for p in published_files("bnot-1024/*")]))
    assert 6e-8 < bnot["power_at_1"] < 3e-7
    assert bnot["noise_floor"] == pytest.approx(1.2e-4, rel=0.1)
    assert bnot["powerlaw_residual_db"] < bnot["profile_residual_db"]
    gbn = measures(np.array([gbnbench.load(p) for p in published_files("gbn-1024/*")]))
    assert gbn["power_at_1"] == pytest.approx(3e-10, rel=0.5)
    assert gbn["noise_floor"] == pytest.approx(7e-10, rel=0.2)
    assert gbn["evacuated_energy"] == pytest.approx(23.08, abs=0.5)
    assert gbn["profile_c"] == pytest.approx(4 * math.pi**2, rel=0.02)
    assert gbn["profile_residual_db"] < gbn["powerlaw_residual_db"]
