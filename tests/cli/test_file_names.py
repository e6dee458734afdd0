"""Names of files that are no UTF-8, and wide ones: in tables, JSON, CSV, pictures, reports and folders."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import gbnbench
from gbnbench.core.text_table import display_width
from gbnbench.io.data_files import read_csv, read_json, to_csv, to_json
from gbnbench.reports.html.page import page
from gbnbench.runs.comparison_result import Run
from tests.reports import samples

ODD = os.fsdecode(b"caf\xe9")


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    try:
        np.savetxt(f"{ODD}.txt", np.random.default_rng(1).random((16, 2)))
    except OSError:
        pytest.skip("this file system takes UTF-8 alone")
    return tmp_path


def command(*words: object, **environment: str) -> subprocess.CompletedProcess[bytes]:
    done = subprocess.run(
        [sys.executable, "-m", "gbnbench", *map(str, words)], capture_output=True, check=False, timeout=300,
        env={**os.environ, **environment},
    )  # fmt: skip
    assert b"Traceback" not in done.stderr
    return done


def test_odd_names_in_text_and_json(here: Path) -> None:
    done = command("analyze", f"{ODD}.txt")
    assert done.returncode == 0
    assert done.stdout.splitlines()[1].startswith(b"caf\xe9.txt ")
    done = command("analyze", f"{ODD}.txt", "--json", PYTHONIOENCODING="ascii", LC_ALL="C")
    (row,) = json.loads(done.stdout.decode("ascii"))
    assert row["path"] == f"{ODD}.txt"


def test_odd_names_are_read_back_from_json_and_csv(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_bytes(to_json({"label": ODD, "wide": "蓝"}))
    assert read_json(tmp_path / "a.json") == {"label": ODD, "wide": "蓝"}
    assert "蓝" in (tmp_path / "a.json").read_text(encoding="utf-8")
    table = pd.DataFrame({"source": [ODD, "蓝", r"C:\users\dc80"], "n": [1, 2, 3]})
    (tmp_path / "a.csv").write_bytes(to_csv(table))
    (tmp_path / "a.csv").read_text(encoding="utf-8")
    assert read_csv(tmp_path / "a.csv", text=("source",)).source.tolist() == table.source.tolist()


def test_odd_names_in_the_report() -> None:
    source = samples.source(ODD, samples.random(9, 2, 2), 3)
    assert "caf\N{REPLACEMENT CHARACTER}" in page(Run({}, (source,)))


@pytest.mark.slow
def test_odd_names_in_a_whole_run(here: Path) -> None:
    Path(f"{ODD} dir").mkdir()
    np.savetxt(Path(f"{ODD} dir", "\udcff.txt"), np.random.default_rng(2).random((16, 2)))
    words = ("compare", f"{ODD}.txt", f"{ODD} dir", "-o", f"run {ODD}", "--quiet")
    assert command(*words).returncode == 0
    made = gbnbench.Comparison.read(f"run {ODD}")
    assert [source.label for source in made.sources] == [ODD, f"{ODD} dir"]
    again = command(*words, PYTHONIOENCODING="ascii", LC_ALL="C")
    assert b"2 of 2 pieces reused" in again.stdout
    done = command("compare", f"{ODD}.txt", "-o", "b", "--quiet", "--baseline", f"run {ODD}")
    assert done.returncode == 0
    done = command("spectrum", f"{ODD}.txt", "-o", f"{ODD}.png")
    assert done.returncode == 0
    assert Path(f"{ODD}.png").stat().st_size > 1000
    done = command("integrate", f"{ODD}.txt", "--instances", 2, "-o", f"i {ODD}", "--quiet")
    assert done.returncode == 0
    assert gbnbench.Integration.read(f"i {ODD}").table.source.tolist() == [ODD] * 2


def test_wide_names_keep_the_columns(here: Path) -> None:
    np.savetxt("蓝噪声采样.txt", np.random.default_rng(1).random((16, 2)))
    done = command("analyze", "蓝噪声采样.txt", f"{ODD}.txt", PYTHONIOENCODING="utf-8")
    head, first, *_ = done.stdout.decode("utf-8", "replace").splitlines()
    assert display_width(first[: first.index(" 16  2 ") + 3]) == len(head[: head.index(" n ") + 2])
