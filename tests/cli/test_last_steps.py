"""What a command shows and keeps where a value is missing, a name is two things, or its last step fails."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from gbnbench.api import comparison as comparison_module
from gbnbench.cli import run
from gbnbench.core.footnotes import footnotes
from gbnbench.reports.comparison import figure_files
from gbnbench.runs.source_names import hidden_paths
from gbnbench.runs.sources import resolve


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def points(n: int = 25, d: int = 2) -> np.ndarray:
    return np.random.default_rng(n).random((n, d))


def test_every_missing_measure_has_its_reason(capsys: pytest.CaptureFixture[str]) -> None:
    np.savetxt("pairs.csv", np.repeat(points(), 2, axis=0), delimiter=",", header="x,y", comments="")
    assert run(["analyze", "pairs.csv", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)
    missing = {name for name, value in row["measures"].items() if value is None}
    assert missing == set(row["reasons"])
    assert missing >= {"psi6", "valence6", "bond_order"}
    assert run(["analyze", "pairs.csv"]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "Q6; psi6; v6: Delaunay neighbours need distinct points; some of these n=50 coincide" in out


def test_footnotes_are_wrapped_and_told_once() -> None:
    lines = footnotes([("a", "x " * 60), ("b", "x " * 60), ("c", "")], 50)
    assert lines[0].startswith("- a; b: x")
    assert all(len(line) <= 50 for line in lines)
    assert " ".join(lines).count("- ") == 1


def test_a_file_with_brackets_in_its_name_is_a_file() -> None:
    np.savetxt("sobol[1].txt", points())
    (source,), _ = resolve(["sobol[1].txt"], [16], [2], 1)
    assert (source.kind, source.n) == ("files", 25)
    assert hidden_paths(["sobol[1].txt", "sobol"]) == []


def test_a_folder_that_a_generator_hides_is_told() -> None:
    Path("gbn").mkdir()
    assert hidden_paths(["gbn", "random", "gbn"]) == [
        "gbn is the generator; the folder of that name is ./gbn"
    ]


@pytest.mark.slow
def test_results_are_kept_and_shown_where_the_report_fails(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    command = ["compare", "random", "jittered", "-n", "16", "--realizations", "2", "--quiet", "-o", "run"]
    with monkeypatch.context() as patch:
        patch.setattr(comparison_module, "write_report", full)
        patch.setattr(comparison_module, "write_figures", lambda *_: None)
        assert run(command) == 2
    said = capsys.readouterr()
    assert re.search(r"^jittered", said.out, re.MULTILINE)
    assert "report.html: [Errno 28] No space left on device. All results are in run" in said.err
    assert len((here / "run" / "table.csv").read_text().splitlines()) == 3
    assert run(command) == 0
    assert "6 of 6 pieces reused" in capsys.readouterr().out
    assert (here / "run" / "report.html").exists()


@pytest.mark.slow
def test_a_picture_that_fails_costs_only_itself(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object) -> None:
        raise ValueError("no such panel")

    with monkeypatch.context() as patch:
        patch.setitem(figure_files.FIGURES, "points", figure_files.FIGURES["points"]._replace(draw=broken))
        assert run(["compare", "random", "-n", "16", "--realizations", "2", "--quiet", "-o", "run"]) == 2
    said = capsys.readouterr()
    assert re.search(r"^random", said.out, re.MULTILINE)
    assert "could not be made: figure points: no such panel. All results are in run" in said.err
    made = {path.stem for path in (here / "run" / "figures").iterdir()}
    assert made >= {"gallery", "loglog", "spectrum", "radial"}
    assert "points" not in made
    assert (here / "run" / "report.html").exists()


def test_twenty_dimensions_are_told_as_far_as_they_go(capsys: pytest.CaptureFixture[str]) -> None:
    x = points(32, 20)
    np.savetxt("wide.csv", x, delimiter=",", header=",".join(f"x{a}" for a in range(20)), comments="")
    assert run(["spectrum", "wide.csv", "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "4 shells, |f| from 1 to 2" in out
    phases = np.exp(-2j * np.pi * x).sum(axis=0)
    first = float(np.mean(np.abs(phases) ** 2) / 32)
    assert f"{first:.4g}" in out
