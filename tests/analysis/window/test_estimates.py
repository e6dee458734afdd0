"""All estimates together: stated errors against closed forms, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

import gbnbench
from gbnbench.benchmarks.experiments.window_coverage import coverage, markdown
from gbnbench.benchmarks.experiments.window_processes import PROCESSES, ginibre, perturbed_lattice, poisson
from gbnbench.core.errors import InputError

BY_NAME = {process.name: process for process in PROCESSES}


def _held(table, sets):
    """Means of z within four standard errors of 0, variances near 1, intervals that hold.

    Of S and g a set has many values, whose z go together: a fifth of them count as independent.
    """
    for row in table.itertuples():
        independent = sets * max(1, row.values / 5)
        least, most = stats.chi2.ppf([1e-4, 1 - 1e-4], independent) / independent
        assert abs(row.z_mean) < 4 / math.sqrt(independent) + 0.1, row
        assert 0.5 * least < row.z_variance < 1.25 * most, row
        assert row.covered > 0.95 - 4 * math.sqrt(0.95 * 0.05 / independent) - 0.01, row


@pytest.mark.slow
@pytest.mark.parametrize(
    "process",
    [poisson((24.0, 16.0), 400), perturbed_lattice((24.0, 16.0), "uniform"), ginibre(18.0)],
    ids=lambda process: process.name,
)
def test_stated_errors_hold(process):
    table = coverage(process, sets=10, seed=5)
    assert {"S", "s_zero", "exponent", "intensity"} <= set(table["quantity"])
    _held(table, 10)


@pytest.mark.slow
@pytest.mark.parametrize("name", BY_NAME)
def test_stated_errors_hold_over_many_sets(name):
    table = coverage(BY_NAME[name], sets=60, seed=6)
    _held(table, 60)
    assert markdown(table).count("\n") == 2


def test_a_deep_gap_is_said_to_lie_below_the_side_lobes():
    x = gbnbench.generate("gbn[iterations=60]", n=400, d=2, seed=0)
    found = gbnbench.in_window(x, 0, 1)
    assert math.isnan(found.scalars["s_zero"])
    assert "side lobes" in found.scalars.reasons["s_zero"]
    assert "side lobes" in found.scalars.reasons["hyperuniformity"]


def test_intervals_hold_their_value_and_are_in_the_frame():
    found = gbnbench.in_window(np.random.default_rng(2).random((300, 2)), 0, 1)
    table = found.to_frame().set_index("measure")
    stated = table[np.isfinite(table["standard_error"])]
    assert {"s_zero", "hyperuniformity", "exponent", "intensity", "mean_distance"} <= set(stated.index)
    assert ((stated["low"] < stated["value"]) & (stated["value"] < stated["high"])).all()
    assert table.loc["resolution", ["low", "high"]].isna().all()
    above, below = table["high"] - table["value"], table["value"] - table["low"]
    assert above["s_zero"] > below["s_zero"]  # small powers vary less
    assert above["exponent"] == pytest.approx(below["exponent"])


def test_few_points_say_why_there_is_no_fit():
    found = gbnbench.in_window(np.random.default_rng(1).random((16, 3)), 0, 1)
    assert "more points" in found.scalars.reasons["exponent"]
    assert found.to_frame()["reason"].str.len().max() > 10
    assert found.scalars["intensity"] == 16


def test_the_same_seed_gives_the_same_estimates():
    x = np.random.default_rng(2).random((100, 4))
    one, two = (gbnbench.in_window(x, 0, 1, seed=3) for _ in range(2))
    assert one.structure_factor.equals(two.structure_factor)
    assert one.scalars["intensity"] == 100


@pytest.mark.parametrize(
    ("points", "low", "high", "more", "said"),
    [
        ([[0.5, 0.5]] * 16, 0, 1, {}, "one point"),
        (np.zeros((3, 2)), 0, 1, {}, "at least 16"),
        (np.zeros((30, 20)), 0, 1, {}, "up to 8 dimensions"),
        (np.zeros((2, 20, 2)), 0, 1, {}, r"\(n, d\)"),
        (np.eye(16)[:, :2], 0, [1, 1, 1], {}, "high must be one number or 2"),
        (np.eye(16)[:, :2], 1, 0, {}, "low must be below high"),
        (np.eye(16)[:, :2], 0, math.inf, {}, "finite"),
        (np.eye(16)[:, :2] * 1e-100, 0, 1e-100, {}, "in another unit"),
        (np.eye(16)[:, :2], 0, 0.5, {}, "coordinate 0 of point 0 is 1.0"),
        (np.full((16, 2), math.nan), 0, 1, {}, "nan"),
        ([["a", "b"]] * 16, 0, 1, {}, "real numbers"),
        (np.eye(16)[:, :2], 0, 1, {"nu_max": 0}, "nu_max"),
        (np.eye(16)[:, :2], 0, 1, {"tapers": (1, 2, 3)}, "tapers"),
    ],
)
def test_what_cannot_be_estimated_is_refused(points, low, high, more, said):
    with pytest.raises(InputError, match=said):
        gbnbench.in_window(points, low, high, **more)
