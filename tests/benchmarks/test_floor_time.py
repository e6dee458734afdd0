"""The benchmark of Gaussian Blue Noise: its runs are the generator's, its forces exact, its tables whole."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from gbnbench.benchmarks.gbn import floor_cases
from gbnbench.benchmarks.gbn.benchmark import FloorTables, run
from gbnbench.benchmarks.gbn.cutoffs import FORCES, exact_forces
from gbnbench.benchmarks.gbn.floor_cases import Curve, FloorCase
from gbnbench.benchmarks.gbn.floor_time import FLOOR_TIME, measured, race
from gbnbench.benchmarks.gbn.speedups import SPEEDUP
from gbnbench.benchmarks.timing import machine
from gbnbench.cli.bench_gbn import draw, report
from gbnbench.core.errors import InputError
from gbnbench.execution.progress import Progress
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.protocol import realization_rng
from tests import smallest_sizes
from tests.oracles.power import direct_power

COMMAND = [sys.executable, "-m", "gbnbench", "bench", "gbn"]
SMALLEST = [*smallest_sizes.COMMAND, "bench", "gbn"]


class Counting(Progress):
    """Counts the steps told."""

    total = done = 0

    def start(self, total, done, doing):
        self.total, self.done = total, done

    def advance(self, doing, steps=1):
        self.done += steps


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> tuple[Path, FloorTables, Counting]:
    out = tmp_path_factory.mktemp("bench") / "here"
    teller = Counting()
    outcome = run(out, floor_cases.tiny(), teller)
    draw(outcome, out)
    return out, outcome, teller


def test_the_ladder_is_geometric_and_ends_where_it_should():
    assert Curve("descent", 1000).stops() == [10, 18, 32, 56, 100, 178, 316, 562, 1000]
    assert Curve("nesterov", 7).stops() == [7]
    for stops in (curve.stops() for case in floor_cases.full().cases for curve in case.curves):
        assert (np.diff(np.log(stops)) < math.log(2.2)).all()
        assert (np.diff(np.log(stops)) > math.log(1.2)).all()


def test_every_curve_of_every_plan_can_be_drawn():
    for plan in (floor_cases.full(), floor_cases.quick(), floor_cases.tiny()):
        for case in plan.cases:
            assert any(c.step == "authors" for c in case.curves) or case.d <= 2 or case.sets == 1
            for curve in case.curves:
                settings = {"cutoff": curve.cutoff, "step": curve.step, "precision": curve.precision}
                assert GaussianBlueNoise(**settings).refusal(case.n, case.d) is None


@pytest.mark.parametrize(
    ("curve", "generator"),
    [
        (Curve("nesterov", 30), GaussianBlueNoise(gradients=30)),
        (Curve("nesterov", 30, "float"), GaussianBlueNoise(gradients=30, precision="float")),
        (Curve("nesterov", 30, cutoff=4.0), GaussianBlueNoise(gradients=30, cutoff=4.0)),
        (Curve("descent", 30), GaussianBlueNoise(iterations=30)),
        (Curve("descent", 30, step="authors"), GaussianBlueNoise(iterations=30, step="authors")),
    ],
)
def test_what_is_timed_is_what_the_generator_does(curve, generator):
    rows = list(race(FloorCase(200, 2, (curve,), sets=2)))
    assert [(row["set"], row["gradients"]) for row in rows] == [(k, g) for k in (0, 1) for g in (10, 18, 30)]
    for row in rows[2::3]:
        x = generator(200, 2, realization_rng(0, row["set"]))
        assert {name: row[name] for name in measured(x)} == pytest.approx(measured(x), rel=1e-9)
        assert row["cpu_s"] > 0


@pytest.mark.parametrize(("n", "d"), [(90, 1), (150, 2), (100, 3), (40, 6)])
def test_the_floor_measured_is_the_mean_power_of_the_low_band(n, d):
    x = np.random.default_rng(d).random((n, d))
    side = n ** (1 / d)
    f = np.indices((2 * max(1, int(side)) + 1,) * d).reshape(d, -1).T - max(1, int(side))
    radius = np.sqrt((f**2).sum(axis=1))
    low = (radius > 0) & (radius <= max(0.25 * side, 1.0))
    found = measured(x)
    assert found["noise_floor"] == pytest.approx(direct_power(x, f[low]).mean(), rel=1e-9)
    assert found["power_at_1"] == pytest.approx(direct_power(x, f[radius == 1]).mean(), rel=1e-9)
    assert math.isnan(found["psi6"]) == (d != 2)
    assert math.isnan(found["peak"]) == (d > 3)


@pytest.mark.parametrize(("n", "d"), [(50, 1), (150, 2), (60, 3), (20, 5)])
def test_exact_forces_are_the_slope_of_the_energy(n, d):
    """By central differences of the sum of Gaussians over all pairs and images, and against the device."""
    x = np.random.default_rng(n).random((n, d))
    side = n ** (1 / d)

    def energy(at):
        between = (at - np.delete(x, 3, axis=0))[:, :, None] + np.arange(-14, 15)
        return np.exp(-((between * side) ** 2) / 2).sum(axis=2).prod(axis=1).sum()

    found = exact_forces(x, 1.0, np.array([3, 0]))
    step = 1e-5 * np.eye(d) / side
    slopes = [(energy(x[3] + h) - energy(x[3] - h)) / 2e-5 for h in step]
    assert found[0].astype(float) == pytest.approx(slopes, abs=1e-8)
    on_device = energy_evaluation(n, d, 1.0, "double")(x[None]).gradient[0, [3, 0]]
    assert on_device == pytest.approx(found.astype(float), abs=1e-12)


@pytest.mark.slow
def test_forces_grow_exact_with_the_cutoff(whole):
    rows = whole[1].forces
    double = rows[(rows.precision == "double") & (rows.kernel == "cut off")].sort_values("cutoff")
    assert list(double.cutoff) == [3.0, 4.0, 5.0, 6.0, 7.5, 9.0]
    assert (np.diff(np.log(double.error_rms)) < -1).all()
    # A pair at the cut-off c pulls by c exp(-c^2 / 2); those beyond it partly balance.
    beyond = double.cutoff * np.exp((1 - double.cutoff**2) / 2)
    assert (double.error_rms[:-1] < 10 * beyond[:-1]).all()
    assert (double.error_rms[:-1] > 0.05 * beyond[:-1]).all()
    kept = rows[rows.kernel == "whole"].set_index("precision")
    assert kept.error_rms["double"] < 1e-14
    assert 1e-8 < kept.error_rms["float"] < 2e-6
    assert (rows.cpu_ms <= rows.cpu_ms_median).all()


@pytest.mark.slow
def test_the_tables_are_whole_and_floors_fall(whole):
    out, outcome, teller = whole
    assert {p.name for p in out.iterdir()} == {
        "floor_time.csv", "forces.csv", "speedup.csv", "machine.json", "floor_time.png", "floor_time.pdf",
    }  # fmt: skip
    floors = pd.read_csv(out / "floor_time.csv")
    assert tuple(floors.columns) == FLOOR_TIME
    assert tuple(pd.read_csv(out / "forces.csv").columns) == FORCES
    assert tuple(pd.read_csv(out / "speedup.csv").columns) == SPEEDUP
    assert json.loads((out / "machine.json").read_text())["device"] == machine.describe()["device"]
    assert teller.done == teller.total == floor_cases.tiny().steps
    kept = floors[(floors.kernel == "whole") & floors.d.isin([2, 3])]
    for _, part in kept.groupby(["case", "curve", "precision", "set"]):
        assert (np.diff(part.cpu_s) > 0).all()
        assert part.excess.is_monotonic_decreasing
        assert part.noise_floor.iloc[-1] < part.noise_floor.iloc[0] / 2
    for _, part in kept.groupby(["case", "set"]):
        ends = part[part.gradients == part[part.method == "nesterov"].gradients.max()]
        (ours,) = ends[(ends.method == "nesterov") & (ends.precision == "double")].itertuples()
        (single,) = ends[(ends.method == "nesterov") & (ends.precision == "float")].itertuples()
        descent = ends[ends.method == "descent"]
        assert (ours.excess < descent.excess / 2).all()
        assert (ours.noise_floor < descent.noise_floor / 2).all()
        assert single.excess == pytest.approx(ours.excess, rel=0.02)
    near, far = (floors[floors.cutoff.eq(c) & (floors.kernel == "cut off")] for c in (3, 9))
    assert near.noise_floor.iloc[-1] > 100 * far.noise_floor.iloc[-1]
    gradients = outcome.speedups.their_gradients / outcome.speedups.gradients
    assert (gradients[outcome.speedups.case == "n=100 2D"] > 2).all()


@pytest.mark.slow
def test_the_picture_and_the_report_say_what_was_measured(whole):
    out, outcome, _ = whole
    assert (out / "floor_time.png").read_bytes().startswith(b"\x89PNG")
    assert (out / "floor_time.pdf").read_bytes().startswith(b"%PDF")
    text = "\n".join(report(outcome))
    for words in (
        "n=100 2D", "descent, authors' step", "kernel to 3 sigma", "6.6e-10", "over sets", "rms error",
        outcome.machine["device"],
    ):  # fmt: skip
        assert words in text


@pytest.mark.slow
def test_bad_use_is_refused_in_words(tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(InputError, match="must be a folder"):
        run(tmp_path / "file", floor_cases.tiny(), Progress())
    done = subprocess.run(
        [*SMALLEST, "--quick", "--out", "file"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert "--out must be a folder; file is a file" in done.stderr
    assert "Traceback" not in done.stderr
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_a_run_that_is_stopped_keeps_its_rows(tmp_path):
    running = subprocess.Popen(
        [*COMMAND, "--quick", "--quiet", "--out", "here"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    table = tmp_path / "here" / "floor_time.csv"
    until = time.monotonic() + 120
    while time.monotonic() < until and not (table.exists() and table.read_text().count("\n") > 2):
        time.sleep(0.05)
    os.kill(running.pid, signal.SIGINT)
    _, error = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "what was measured is in here" in error
    assert "Traceback" not in error
    rows = pd.read_csv(table)
    assert len(rows) >= 2
    assert (rows.noise_floor > 0).all()
    assert (tmp_path / "here" / "machine.json").exists()
