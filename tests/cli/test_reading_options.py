"""Reading options on every command that reads points: the same numbers as from fractions of the box."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from gbnbench.analysis.measures import measures
from gbnbench.cli import gbnbench
from gbnbench.cli.options import READING
from gbnbench.io.points import ReadingOptions, load, save
from gbnbench.runs.sources import resolve

READERS = ("analyze", "spectrum", "compare", "convert", "integrate", "figures")


def run(*arguments: object) -> Result:
    return CliRunner().invoke(gbnbench, [str(argument) for argument in arguments])


@pytest.fixture
def pixels(tmp_path: Path) -> tuple[Path, Path]:
    """A file of pixels, and one of the same points as fractions of 512."""
    x = np.random.default_rng(3).integers(0, 512, (30, 2))
    (tmp_path / "pixels.txt").write_text("".join(f"{a} {b}\n" for a, b in x))
    save(tmp_path / "unit.txt", x / 512)
    return tmp_path / "pixels.txt", tmp_path / "unit.txt"


@pytest.mark.parametrize("name", READERS)
def test_every_command_that_reads_points_has_all_of_them_in_one_section(name: str) -> None:
    shown = run(name, "--help").output.split("\nReading options:\n")[1].split("\n\n")[0]
    assert {word for word in shown.split() if word in READING} == READING


def test_analyze_measures_fractions_of_the_box(pixels: tuple[Path, Path]) -> None:
    there, unit = pixels
    given = json.loads(run("analyze", there, "--period", "512,512", "--json").stdout)
    expected = json.loads(run("analyze", unit, "--json").stdout)
    assert given[0]["measures"] == expected[0]["measures"]
    refused = run("analyze", there)
    assert refused.exit_code == 2
    assert f"{there}, line " in refused.output
    assert "such as --period 512,512" in refused.output


def test_spectrum_measures_fractions_of_the_box(pixels: tuple[Path, Path]) -> None:
    there, unit = pixels
    given = run("spectrum", there, "--period", "512", "--fmax", 4, "--json")
    expected = run("spectrum", unit, "--fmax", 4, "--json")
    assert json.loads(given.stdout)[0]["rows"] == json.loads(expected.stdout)[0]["rows"]


def test_analyze_measures_lengths_in_the_units_of_a_rectangle(pixels: tuple[Path, Path]) -> None:
    there, unit = pixels
    x = load(unit)
    (given,) = json.loads(run("analyze", there, "--period", "512,1024", "--json").stdout)
    halved = np.array(x) * [1, 0.5]
    expected = measures(halved, sides=(512, 1024))
    found = {name: np.nan if value is None else value for name, value in given["measures"].items()}
    assert found == pytest.approx(dict(expected), nan_ok=True, rel=1e-12)


def test_a_source_is_another_when_read_otherwise(pixels: tuple[Path, Path]) -> None:
    there, _ = pixels
    one, other, none = (
        resolve([there], (1,), (1,), 1, reading)[0][0]
        for reading in (
            ReadingOptions(period=(512.0,)),
            ReadingOptions(period=(1024.0,)),
            ReadingOptions(bounds=(0.0, 512.0)),
        )
    )
    assert one.identity()["reading"] == {"period": [512.0]}
    assert len({one.digest, other.digest, none.digest}) == 3
    assert (one.sides, one.toroidal, none.toroidal) == ((512.0, 512.0), True, None)


def test_options_without_a_file_are_refused() -> None:
    done = run("compare", "random", "--period", "3", "--wrap")
    assert done.exit_code != 0
    assert "period, wrap say how files are read, and no source is a file" in str(done.exception)


def test_a_file_that_is_no_torus_says_so(tmp_path: Path) -> None:
    rows = "".join(f"{a!r} {b!r}\n" for a, b in np.random.default_rng(1).random((9, 2)).tolist())
    (tmp_path / "window.edat").write_text("0 0\n1 1\n0\n" + rows)
    told = "says that its box is no torus, and it is measured as one"
    assert f"window.edat: {told}" in run("analyze", tmp_path / "window.edat").output
    done = run("compare", tmp_path / "window.edat", "--out", tmp_path / "run", "--jobs", 1, "--quiet")
    assert f"warning: window (n=9, d=2): the file {told}" in done.output


def test_a_resumed_folder_notices_other_options(pixels: tuple[Path, Path], tmp_path: Path) -> None:
    there, unit = pixels
    call = ["integrate", there, "--instances", 2, "--out", tmp_path / "study", "--jobs", 1, "--quiet"]
    first = run(*call, "--period", "512,512")
    assert first.exit_code == 0, first.output
    assert run(*call, "--period", "512,512").exit_code == 0
    other = run(*call, "--period", "1024,1024")
    assert other.exit_code != 0
    same = run("integrate", unit, "--instances", 2, "--jobs", 1, "--quiet", "--json", "--out", tmp_path / "b")
    again = run(*call, "--period", "512,512", "--json")
    values = [[row["variance"] for row in json.loads(done.stdout)["variance"]] for done in (same, again)]
    assert values[0] == values[1]
