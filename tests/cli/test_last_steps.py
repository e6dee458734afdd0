"""What a command shows and keeps where a value is missing, a name is two things, or its last step fails."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.cli import run
from gbnbench.cli.integrate_text import as_lines, as_record
from gbnbench.cli.json_text import json_text
from gbnbench.core.footnotes import footnotes
from gbnbench.reports.comparison import figure_files
from gbnbench.runs.source_names import double_meanings
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
    assert double_meanings(["sobol[1].txt", "sobol", "gbn[sigma=1]", Path("sobol[1].txt")]) == [
        "sobol[1].txt is the file of that name; as settings of a generator it cannot be read"
    ]


def test_a_folder_that_a_generator_hides_is_told() -> None:
    Path("gbn").mkdir()
    assert double_meanings(["gbn", "random", "gbn"]) == [
        "gbn is the generator; the folder of that name is ./gbn"
    ]


COMPARE = ["compare", "random", "jittered", "-n", "16", "--realizations", "2", "--quiet", "-o", "run"]


@pytest.mark.slow
def test_a_picture_that_fails_takes_nothing_with_it(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object) -> None:
        raise ValueError("an odd curve")

    drawn = {name: figure_files.FIGURES[name] for name in ("radial", "points")}
    monkeypatch.setattr(figure_files, "FIGURES", drawn)
    with monkeypatch.context() as patch:
        patch.setitem(drawn, "radial", figure_files.Kind(broken, lambda _: True))
        assert run(COMPARE) == 2
    said = capsys.readouterr()
    assert re.search(r"^jittered", said.out, re.MULTILINE)
    assert said.err.splitlines()[-1] == (
        "gbnbench: error: what comes last could not be made: figure radial: an odd curve. "
        "All results are in run, and the same command tries the pictures again"
    )
    assert {path.stem for path in (here / "run" / "figures").iterdir()} == {"points"}
    assert (here / "run" / "report.html").exists()
    assert len((here / "run" / "table.csv").read_text().splitlines()) == 3
    assert run([*COMPARE, "--json"]) == 0
    again = capsys.readouterr()
    assert "6 of 6 pieces reused" in again.err
    rows = json.loads(again.out)
    for row in rows:
        assert {name for name, value in row.items() if value is None} == set(row["reasons"])
    assert (here / "run" / "figures" / "radial.png").exists()


@pytest.mark.slow
def test_a_report_that_cannot_be_written(here: Path) -> None:
    assert run(COMPARE) == 0
    (here / "run" / "manifest.json").unlink()  # as where a run was stopped before its end
    (here / "run" / "report.html").unlink()
    (here / "run" / "report.html").mkdir()  # no file can be written there
    done = subprocess.run(
        [sys.executable, "-m", "gbnbench", *COMPARE], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 2
    assert re.search(r"^jittered", done.stdout, re.MULTILINE)
    assert re.fullmatch(
        r"gbnbench: error: what comes last could not be made: report.html: "
        r".*'run/report.html'\. All results are in run.*",
        done.stderr.strip(),
    )
    assert not list(here.rglob("*.tmp"))


def test_a_spectrum_that_cannot_be_kept_is_shown(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(path: Path, _: bytes) -> None:
        raise OSError(28, "No space left on device", str(path))

    np.savetxt("mine.txt", points())
    monkeypatch.setattr("gbnbench.cli.spectrum_output.write_atomically", full)
    assert run(["spectrum", "mine.txt", "-o", "mine.csv", "--quiet"]) == 2
    said = capsys.readouterr()
    assert "P(|f|=1)" in said.out
    assert said.err == "gbnbench: error: mine.csv: No space left on device\n"


def test_reasons_of_a_spectrum(capsys: pytest.CaptureFixture[str]) -> None:
    np.savetxt("one.txt", points(1))
    assert run(["spectrum", "one.txt", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)
    assert found["measures"]["peak"] == 1
    assert all(row["anisotropy_db"] is None for row in found["rows"])
    assert set(found["reasons"]) == {"anisotropy_db"}
    assert run(["spectrum", "one.txt", "--fmax", "1", "--shells", "--json"]) == 0
    (short,) = json.loads(capsys.readouterr().out)
    missing = {name for name, value in short["measures"].items() if value is None}
    assert missing == {"peak", "peak_nu"} == set(short["reasons"]) - {"anisotropy_db"}
    assert run(["spectrum", "one.txt", "--fmax", "1", "--shells"]) == 0
    out = capsys.readouterr().out
    assert f"  no peak: {short['reasons']['peak']}" in out
    assert "- anisotropy_db: the powers of such a ring are 0" in out
    assert run(["spectrum", "one.txt", "--band", "3,4", "--json"]) == 0
    (band,) = json.loads(capsys.readouterr().out)
    assert set(band["reasons"]) == {"noise_floor", "power_at_1", "peak", "peak_nu", "anisotropy_db"}


def test_reasons_of_integrals() -> None:
    np.savetxt("mine.txt", points(9))
    made = gbnbench.integrate(
        ["random", "mine.txt"], n=[8, 16], realizations=1, instances=1, integrands=["half-space"],
        out="i", quiet=True, jobs=1, pictures=False,
    )  # fmt: skip
    out = " ".join(" ".join(as_lines(made.study)).split())
    for line in (
        "- n=8; n=9; n=16: this source has no sets of that size",
        "- standard error: a standard error needs two integrands or two sets; both are single here",
        "- prediction: nothing is predicted: not periodic,",
        "- slope: a slope needs two sizes n or more",
    ):
        assert line in out
    found = json.loads(json_text(as_record(made.study)))
    for row in found["variance"] + found["slopes"]:
        assert {name for name, value in row.items() if value is None} == set(row["reasons"])


def test_twenty_dimensions_are_told_as_far_as_they_go(capsys: pytest.CaptureFixture[str]) -> None:
    x = points(32, 20)
    np.savetxt("wide.csv", x, delimiter=",", header=",".join(f"x{a}" for a in range(20)), comments="")
    assert run(["spectrum", "wide.csv", "--quiet"]) == 0
    out = capsys.readouterr().out
    assert "4 shells, |f| from 1 to 2" in out
    phases = np.exp(-2j * np.pi * x).sum(axis=0)
    first = float(np.mean(np.abs(phases) ** 2) / 32)
    assert f"{first:.4g}" in out
