"""Step, peak, staircase and spectra of one's own: how near the ring means come, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import FormatError, InputError, RefusalError
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import find, generate
from gbnbench.generators.spectral_control.named_profiles import widest_step
from gbnbench.generators.spectral_control.single_peak import SinglePeak
from gbnbench.generators.spectral_control.staircase import Staircase
from gbnbench.generators.spectral_control.step import Step
from gbnbench.generators.spectral_control.target_fit import target_fit
from gbnbench.generators.spectral_control.targeted import Targeted


@pytest.mark.parametrize(("n", "d"), [(256, 2), (200, 3), (100, 4)])
def test_a_step_is_empty_below_its_edge_and_flat_above(n, d):
    generator = Step()
    fit = target_fit(generator(n, d, realization_rng(0, 0)), generator.profile(d), generator.highest_nu(d))
    assert fit.stray < 1e-7
    assert fit.rms_db < 0.01


@pytest.mark.parametrize(("n", "d"), [(200, 3), (150, 4)])
def test_a_peak_beyond_the_plane_is_met_though_its_foot_falls_within_a_ring(n, d):
    generator = SinglePeak()
    fit = target_fit(generator(n, d, realization_rng(0, 0)), generator.profile(d), generator.highest_nu(d))
    assert fit.stray < 1e-7
    assert fit.rms_db < 0.01


def test_in_one_dimension_it_takes_longer():
    generator = Step(iterations=300)
    fit = target_fit(generator(128, 1, realization_rng(0, 0)), generator.profile(1), generator.highest_nu(1))
    assert fit.stray < 1e-2
    assert fit.rms_db < 0.5


def test_the_widest_step_leaves_no_pair_at_distance_0():
    for d, ball in ((2, math.pi), (3, 4 / 3 * math.pi)):
        assert ball * widest_step(d) ** d == pytest.approx(1)


def test_pairs_keep_the_core():
    x = generate("step", n=256, seed=1)
    from gbnbench.core.torus import toroidal_distance

    nearest = min(toroidal_distance(x[[k]], np.delete(x, k, axis=0)).min() for k in range(len(x)))
    assert nearest * 16 > 0.24  # spacings; the soft core of 0.26 gives way a little


@pytest.mark.parametrize("generator", [SinglePeak(), Staircase()])
def test_spectra_that_no_process_has_are_met_within_a_decibel(generator):
    fit = target_fit(generator(400, 2, realization_rng(0, 0)), generator.profile(2), 2.0)
    assert fit.rms_db < 0.8
    assert fit.stray < 2e-3


def test_a_generator_measures_its_own_fit():
    generator = Staircase(iterations=20)
    x = np.stack([generator(100, 2, realization_rng(1, k)) for k in range(2)])
    fit, same = generator.fit(x), target_fit(x, generator.profile(2), 2.0)
    assert (fit.rms_db, fit.stray, fit.highest) == (same.rms_db, same.stray, 2.0)


def green(nu: FloatArray) -> FloatArray:
    return 1 - 0.9 * np.exp(-((nu - 0.8) ** 2) / 0.02)


class TestTargeted:
    def test_a_function_a_table_and_a_file_are_one_target(self, tmp_path):
        nu = np.linspace(0, 1.5, 61)
        rows = np.stack([nu, green(nu)], axis=1)
        path = tmp_path / "green.csv"
        np.savetxt(path, rows, delimiter=",", header="nu,power", comments="")
        by_file = find(f"targeted[target={path}]")
        assert specification(by_file) == f"targeted[target={path}]"
        x = by_file(256, 2, realization_rng(0, 0))
        assert np.abs(x - generate("targeted", n=256, target=rows)).max() < 1e-9
        fit = target_fit(x, green, 1.5)
        assert fit.rms_db < 0.15  # the table's straight lines in ln P lie up to 0.3 dB below the curve
        assert generate("targeted", n=64, target=green, highest=1.5).shape == (64, 2)

    def test_names_are_those_of_the_generators(self):
        for name in ("step", "peak", "staircase"):
            quick = {"n": 64, "seed": 2, "iterations": 3}
            assert np.array_equal(generate("targeted", target=name, **quick), generate(name, **quick))

    def test_what_is_no_target_is_refused(self, tmp_path):
        with pytest.raises(FormatError, match=r"nowhere\.csv: a target cannot be read"):
            find("targeted[target=nowhere.csv]")
        with pytest.raises(InputError, match="target must be one of step, peak, staircase, a file"):
            find("targeted[target=none]")
        for method in ("power", "correlation"):
            for wrong in (lambda nu: nu - 0.5, lambda nu: np.full(len(nu), np.nan)):
                with pytest.raises(InputError, match="target must be finite and >= 0 below the edge"):
                    generate("targeted", n=64, target=wrong, method=method)
            for given in (np.ones(3), "one"):
                with pytest.raises(InputError, match="target must give a power for each nu; got"):
                    generate("targeted", n=64, target=lambda nu, given=given: given, method=method)
        with pytest.raises(InputError, match="highest must be at most the last nu of the target, 1"):
            Targeted(target=[[0.0, 1.0], [1.0, 1.0]], highest=1.5)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("step[edge=0]", r"edge must lie in \[1e-09, 1e\+09\]"),
        ("step[highest=-1]", "highest must be above 0 and finite"),
        ("step[core=-1]", "core must be >= 0 spacings"),
        ("step[iterations=-1]", "iterations must be >= 0"),
        ("peak[power=-1]", r"power must lie in \[0, 1e\+06\]"),
        ("peak[width=0]", "width must be above 0 and finite"),
        ("staircase[level=0]", r"level must be above 0 and at most 1e\+06"),
        ("staircase[edge=0.8,end=0.8]", "end must be above the edge, 0.8; got 0.8"),
    ],
)
def test_settings_out_of_range_are_refused(text, says):
    with pytest.raises(InputError, match=says):
        find(text)


def test_more_work_than_can_be_done_is_refused():
    assert Step().refusal(16_384, 2) is None
    with pytest.raises(RefusalError, match=r"n=1048576 points in d=2 .* too much work"):
        generate("step", n=2**20)


def test_work_on_a_line_and_of_few_points_up_to_high_frequencies_is_counted_whole():
    """On a line tables are what takes time, of few points in many waves the listed frequencies."""
    assert Step().refusal(4096, 1) is None
    assert "too much work" in str(Step().refusal(16_384, 1))
    assert Step(highest=100).refusal(64, 2) is None  # half a minute
    assert "too much work" in str(Step(highest=400).refusal(64, 2))


def test_progress_is_told_of_every_set():
    told: list[tuple[int, int, str]] = []
    monitor = Monitor(progress=lambda *now: told.append(now))
    together = generate("step", n=64, seed=2, realizations=2, iterations=5, monitor=monitor)
    assert np.array_equal(together[1], Step(iterations=5)(64, 2, realization_rng(2, 1)))
    assert [done for done, _, _ in told] == list(range(1, 11))
    assert {total for _, total, _ in told} == {10}
    assert told[-1][2].startswith("set 2, cost")


@pytest.mark.slow
def test_published_step_facts():
    """PSA's of step blue noise; ours has an emptier band, so that its effective Nyquist is one step more."""
    x = generate("step", n=1024, realizations=4)
    found = measures(x)
    assert found["min_distance"] == pytest.approx(0.23, abs=0.03)
    assert found["mean_distance"] == pytest.approx(0.65, abs=0.015)
    assert found["bond_order"] == pytest.approx(0.36, abs=0.015)
    assert found["effective_nyquist"] == pytest.approx(0.57, abs=0.0055)
    assert found["noise_floor"] < 6e-3
    each = np.mean([measures(one)["oscillations"] for one in x])
    assert 0.10 < each < 0.20  # published: 0.11 to 0.15; of four sets together less, 0.10
