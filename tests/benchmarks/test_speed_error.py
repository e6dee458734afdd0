"""The periodogram's benchmark: every rival is right, times add up, the command leaves what it says."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from gbnbench.benchmarks.spectra import cases, cores
from gbnbench.benchmarks.spectra.rivals import half_space, rivals
from gbnbench.benchmarks.spectra.scaling import SCALING, slopes
from gbnbench.benchmarks.spectra.speed_error import SPEED
from gbnbench.benchmarks.timing import machine
from gbnbench.benchmarks.timing.interleaved import Timing, interleave, timed
from gbnbench.benchmarks.timing.machine import Rows
from gbnbench.benchmarks.timing.threads import _libraries, one_blas_thread
from tests import smallest_sizes
from tests.oracles.power import direct_power

COMMAND = [sys.executable, "-m", "gbnbench", "bench", "periodogram"]
SMALLEST = [*smallest_sizes.COMMAND, "bench", "periodogram"]


@pytest.mark.parametrize(
    ("n", "d", "fmax", "sets"), [(70, 1, 20, 2), (70, 2, 13, 3), (50, 3, 3, 1), (40, 5, 1, 2)]
)
def test_every_rival_gives_the_mean_power_and_keeps_nothing(n, d, fmax, sets):
    rng = np.random.default_rng(d)
    x = rng.random((sets, n, d))
    f = np.indices((2 * fmax + 1,) * d).reshape(d, -1).T - fmax
    truth = np.mean([direct_power(one, f) for one in x], axis=0)
    names = set()
    for rival in rivals(n, d, fmax, sets, longest=1.0):
        names.add(rival.name)
        call = rival.prepare(x, fmax)
        power = call()
        assert power.shape == (2 * fmax + 1,) * d
        to_tolerance = rival.family.startswith(("FINUFFT", "ducc0"))
        allowed = float(rival.name.split()[-1]) * 30 if to_tolerance else 1e-11
        allowed = 3e-5 if rival.precision == "float" else max(allowed, 1e-11)
        assert power.ravel() == pytest.approx(truth, abs=allowed * n), rival.name
        before = power.copy()
        power[...] = -1
        assert np.array_equal(call(), before), rival.name
    assert names >= {"gbnbench double", "gbnbench float", "naive kernel", "numpy separable"}
    assert ("zgemm on ready tables" in names) == (d >= 4)


def test_the_half_space_is_half_of_the_cube_and_its_centre():
    half = half_space(3, 2)
    assert half[0].tolist() == [0, 0]
    every = {tuple(f) for f in np.concatenate([half, -half]).tolist()}
    assert len(half) == 25
    assert len(every) == 49


def test_methods_are_timed_in_turn_and_slow_ones_less():
    order = []

    def quick():
        order.append("quick")
        time.sleep(0.006)

    def slow():
        order.append("slow")
        time.sleep(0.05)

    timings = interleave({"quick": quick, "slow": slow}, seconds=0.4)
    assert order[-1] == "quick"
    assert len(timings["slow"].cpu) == 3 < len(timings["quick"].cpu)
    assert 0.05 <= timings["slow"].wall.min() < 0.09
    assert timings["slow"].cpu.max() < 0.02  # sleeping is not work
    ratio = Timing(np.array([2.0, 4.0, 8.0]), np.ones(3)).over(Timing(np.array([1.0, 2.0]), np.ones(2)))
    assert ratio.tolist() == [2.0, 2.0]
    cpu, wall = timed(lambda: sum(range(100_000)), times=3)
    assert 0 < cpu < 1
    assert 0 < wall < 1


def test_blas_is_held_to_one_thread_and_let_go():
    np.ones((4, 4)) @ np.ones((4, 4))
    before = [count() for count, _ in _libraries()]
    with one_blas_thread() as found:
        assert found == bool(before)
        assert [count() for count, _ in _libraries()] == [1] * len(before)
    assert [count() for count, _ in _libraries()] == before


def test_rows_are_on_disk_as_soon_as_they_are_added(tmp_path):
    with Rows(tmp_path / "a.csv", ("name", "value")) as rows:
        rows.add({"name": "x, y", "value": 1 / 3})
        assert (tmp_path / "a.csv").read_text() == 'name,value\n"x, y",0.333333\n'
    assert rows.kept == [{"name": "x, y", "value": 1 / 3}]


def test_slopes_are_fitted_where_work_is_large():
    work = np.array([1e5, 1e7, 1e8, 1e9])
    frame = pd.DataFrame(
        {
            "sweep": "n",
            "method": "m",
            "flops": work,
            "cpu_ms": [9.0, 1.0, 10.0, 200.0],
            "share_of_peak": [0, 0.4, 0.6, 0.5],
        }
    )
    (row,) = slopes(frame).itertuples()
    assert (row.sizes, row.share_least, row.share_most) == (3, 0.4, 0.6)
    assert row.slope == pytest.approx(np.log10(200) / 2)
    assert row.steepest == pytest.approx(np.log10(20))
    assert np.isnan(slopes(frame[:2]).slope.iloc[0])


def test_sweeps_are_long_enough_for_a_slope_and_never_too_long_to_run():
    for sweep in cases.full().sweeps.values():
        work = [c.flops for c in sweep]
        assert len(sweep) >= 6
        assert max(work) <= 1e10


def test_two_cores_are_told_apart_or_the_reason_is(monkeypatch):
    assert "2.00" in str(cores.Throughput((100.0, 90.0), (200.0, 190.0)))
    assert "over 1 round;" in str(cores.Throughput((100.0,), (200.0,)))
    assert "not measured, because" in str(cores.Throughput(reason="because"))
    monkeypatch.setattr(cores, "_child", lambda threads, seconds, device: 10.0 * threads)
    told = cores.throughput(0.1, 2)
    assert told.reason or told.ratio == 2.0


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> tuple[Path, subprocess.CompletedProcess[str]]:
    folder = tmp_path_factory.mktemp("bench")
    done = subprocess.run(
        [*SMALLEST, "--quick", "--out", "here"], cwd=folder, capture_output=True, text=True, check=False
    )
    return folder / "here", done


@pytest.mark.slow
def test_the_command_leaves_tables_and_pictures(whole):
    out, done = whole
    assert done.returncode == 0, done.stderr
    assert {p.name for p in out.iterdir()} == {
        "periodogram.csv", "scaling.csv", "hard_cases.csv", "machine.json", "speed_error.png",
        "speed_error.pdf", "scaling.png", "scaling.pdf",
    }  # fmt: skip
    speed = pd.read_csv(out / "periodogram.csv")
    assert tuple(speed.columns) == SPEED
    assert speed.case.nunique() == len(cases.tiny().cases)
    measured = speed[speed["rounds"] > 0]
    assert (measured.cpu_ms > 0).all()
    assert (measured.cpu_ms <= measured.cpu_ms_median).all()
    assert (measured.ratio_min <= measured.ratio).all()
    assert (measured.ratio <= measured.ratio_max).all()
    assert (measured.ratio[measured.method == "gbnbench double"] == 1).all()
    assert (measured.error_rms[measured.method == "gbnbench double"] < 1e-15).all()
    assert measured.error_rms[measured.method == "gbnbench float"].between(1e-9, 1e-6).all()
    assert measured.share_of_peak.dropna().between(0, 1).all()
    (quoted,) = speed[speed["rounds"] == 0].itertuples()
    assert quoted.cpu_ms == 1550
    assert tuple(pd.read_csv(out / "scaling.csv").columns) == SCALING
    hard = pd.read_csv(out / "hard_cases.csv")
    assert hard.held.all()
    described = json.loads((out / "machine.json").read_text())
    assert described["device"] == machine.describe()["device"]
    assert set(described["fma_flops_a_second"]) == {"double", "float"}


@pytest.mark.slow
def test_the_command_prints_its_tables_and_names_the_device(whole):
    _, done = whole
    assert machine.describe()["device"] in done.stdout
    for words in (
        "n=64 2D F=8, 3 sets",
        "numpy separable",
        "PSA v1.1 (quoted)",
        "slope",
        "the error met is within the stated worst case",
        "P to 1%",
    ):
        assert words in done.stdout
    assert "not measured" in done.stdout
    assert "Traceback" not in done.stderr


@pytest.mark.slow
def test_without_finufft_it_says_so_and_how_to_add_it(whole):
    out, done = whole
    there = pd.read_csv(out / "periodogram.csv").family.eq("FINUFFT").any()
    assert ("FINUFFT is not installed: pip install finufft to add it" in done.stdout) == (not there)


@pytest.mark.slow
def test_bad_use_is_refused_in_words(tmp_path):
    (tmp_path / "file").write_text("mine")
    for arguments, says in ((["--out", "file"], "must be a folder"), (["--fast"], "No such option")):
        done = subprocess.run(
            [*SMALLEST, "--quick", *arguments], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 2
        assert says in done.stderr
        assert "Traceback" not in done.stderr
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_a_run_that_is_stopped_keeps_its_rows(tmp_path):
    running = subprocess.Popen(
        [*COMMAND, "--quick", "--out", "here"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    table = tmp_path / "here" / "periodogram.csv"
    until = time.monotonic() + 60
    while time.monotonic() < until and not (table.exists() and table.read_text().count("\n") > 2):
        time.sleep(0.05)
    os.kill(running.pid, signal.SIGINT)
    _, error = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "what was measured is in here" in error
    assert "Traceback" not in error
    with table.open() as file:
        rows = list(csv.DictReader(file))
    assert rows[0]["method"] == "gbnbench double"
    assert all(row["cpu_ms"] for row in rows)


def test_the_tile_is_slower_than_the_peak_and_both_are_speeds():
    from gbnbench.benchmarks.spectra.tile import tile_share

    tile, peak = tile_share("double")
    assert 1e8 < tile < 1.1 * peak
