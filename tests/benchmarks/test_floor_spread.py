"""The benchmark of Gaussian Blue Noise by workers: its rows are those of one process, but for the clock."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest

from gbnbench.benchmarks.gbn import floor_cases, spread
from gbnbench.benchmarks.gbn.benchmark import run
from gbnbench.benchmarks.gbn.spread import run_by_workers
from gbnbench.benchmarks.timing.row_folder import RowFolder
from gbnbench.core.errors import InputError, UnfinishedError
from gbnbench.execution.progress import Progress

CLOCKS = {"cpu_s", "their_cpu_s", "ratio", "ratio_min", "ratio_max", "cpu_ms", "cpu_ms_median", "rounds"}


def timeless(out: Path, name: str) -> pd.DataFrame:
    table = pd.read_csv(out / f"{name}.csv")
    return table.drop(columns=[column for column in table if column in CLOCKS])


def test_rows_are_read_as_they_were_written(tmp_path):
    folder = RowFolder(tmp_path / "rows", {})
    nan = float("nan")
    folder.write("a/1", {"rows": [{"x": nan, "y": 1 / 3, "z": "whole", "k": 2}], "machine": {"cores": 2}})
    found = folder.read("a/1")
    assert repr(found["rows"]) == repr([{"x": nan, "y": 1 / 3, "z": "whole", "k": 2}])
    assert found["machine"] == {"cores": 2}
    assert folder.read("a/2") is None


@pytest.mark.slow
def test_workers_measure_what_one_process_does_and_go_on_where_they_were(tmp_path, monkeypatch):
    plan = floor_cases.tiny()
    run(tmp_path / "alone", plan, Progress())
    out = tmp_path / "spread"
    keep = spread.written

    def stopped(*_: object) -> None:
        raise UnfinishedError("stopped before the tables")

    monkeypatch.setattr(spread, "written", stopped)
    with pytest.raises(UnfinishedError):
        run_by_workers(out, plan, 2, Progress())
    races = sorted(path.relative_to(out) for path in out.rglob("*.json") if path.parent.parent.name == "rows")
    assert len(races) == sum(case.sets for case in plan.cases) + len(plan.forces)
    (out / races[0]).unlink()
    with pytest.raises(InputError, match="with other settings"):
        run_by_workers(out, floor_cases.quick(), 2, Progress())
    monkeypatch.setattr(spread, "written", keep)
    kept = {path: (out / path).stat().st_mtime_ns for path in races[1:]}
    assert kept
    run_by_workers(out, plan, 2, Progress())
    for name in ("floor_time", "forces", "speedup"):
        pd.testing.assert_frame_equal(timeless(out, name), timeless(tmp_path / "alone", name))
    assert sorted(path.name for path in out.iterdir()) == [
        "floor_time.csv", "forces.csv", "machine.json", "speedup.csv",
    ]  # fmt: skip
    machine = json.loads((out / "machine.json").read_text())
    assert "machines" not in machine
    alone = json.loads((tmp_path / "alone" / "machine.json").read_text())
    assert machine["opencl"].pop("compute_units") == 1  # a worker has one thread
    del alone["opencl"]["compute_units"]
    assert machine == alone
