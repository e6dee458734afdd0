"""Reading options on every command that reads points: the same numbers as from fractions of the box."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from gbnbench.cli import gbnbench
from gbnbench.cli.options import READING
from gbnbench.io.points import ReadingOptions, save
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


def test_a_rectangle_is_measured_in_its_own_lengths(tmp_path: Path) -> None:
    """Two copies of a set side by side, in pixels: distances and neighbours are those of one."""
    x = np.random.default_rng(0).random((40, 2))
    one, long = tmp_path / "one.csv", tmp_path / "long.csv"
    np.savetxt(one, x, delimiter=",", header="x,y", comments="")
    pixels = np.concatenate([x * 256, x * 256 + [256, 0]])
    np.savetxt(long, pixels, delimiter=",", header="x,y", comments="")
    [expected], [given] = (
        json.loads(run("analyze", path, *period, "--json").stdout)
        for path, period in ((one, ()), (long, ("--period", "512,256")))
    )
    assert "sides" not in expected
    assert given["sides"] == pytest.approx([2**0.5, 0.5**0.5])
    for name in ("min_distance", "mean_distance", "psi6", "valence6", "bond_order"):
        assert given["measures"][name] == pytest.approx(expected["measures"][name], rel=1e-9), name
    [spectrum] = json.loads(run("spectrum", long, "--period", "512,256", "--fmax", 4, "--json").stdout)
    assert spectrum["sides"] == given["sides"]
    assert spectrum["rows"][0]["frequency"] == pytest.approx(0.5**0.5)
    assert "sides 2:1" in run("spectrum", long, "--period", "512,256", "--fmax", 4).stdout
    assert "|f_a| <= 5, 2" in run("spectrum", long, "--period", "512,256", "--fmax", 4, "--explain").stdout
    assert "  2:1  " in run("analyze", long, "--period", "512,256").stdout


@pytest.mark.parametrize("arguments", [["integrate", "--instances", 1], ["analyze", "--box"]])
def test_what_a_rectangle_cannot_have_is_refused(
    arguments: list[object], pixels: tuple[Path, Path], tmp_path: Path
) -> None:
    command, *more = arguments
    out = ["--out", tmp_path / "run"] if command == "integrate" else []
    done = run(command, pixels[0], "--period", "512,1024", *more, *out)
    assert done.exit_code != 0
    assert "box has unequal sides" in done.output + str(done.exception)


def test_spectra_of_rectangles_are_written_in_every_format(pixels: tuple[Path, Path], tmp_path: Path) -> None:
    def write(name: str, *more: object) -> Path:
        done = run("spectrum", pixels[0], "--period", "512,1024", "--fmax", 4, *more, "-o", tmp_path / name)
        assert done.exit_code == 0, done.output
        return tmp_path / name

    with np.load(write("box.npz")) as box, np.load(write("half.npz", "--half")) as half:
        np.testing.assert_allclose(box["sides"], [0.5**0.5, 2**0.5])
        assert box["power"].shape == (2 * 2 + 1, 2 * 5 + 1)
        np.testing.assert_array_equal(half["power"], box["power"][2:])
        rows = np.loadtxt(write("box.csv"), delimiter=",", skiprows=1)
        np.testing.assert_array_equal(rows[:, 2], box["power"].ravel())
        np.testing.assert_array_equal(np.load(write("box.npy")), box["power"])
    shells = np.genfromtxt(write("shells.csv", "--shells"), delimiter=",", names=True)
    assert shells["frequency"][0] == pytest.approx(0.5**0.5)
    assert (write("box.png").stat().st_size, write("shells.pdf", "--shells").stat().st_size) > (1000, 1000)


def test_a_source_is_another_when_read_otherwise(pixels: tuple[Path, Path]) -> None:
    there, _ = pixels
    one, other, none = (
        resolve([there], (1,), (1,), 1, reading)[0][0]
        for reading in (
            ReadingOptions(period=(512.0,)),
            ReadingOptions(period=(1024.0,)),
            ReadingOptions(bounds=(0.0, 512.0, 0.0, 512.0)),
        )
    )
    assert one.identity()["reading"] == {"period": [512.0]}
    assert len({one.digest, other.digest, none.digest}) == 3
    assert (one.sides, one.toroidal, none.toroidal) == ((512.0, 512.0), True, None)


def test_options_without_a_file_are_refused() -> None:
    done = run("compare", "random", "--period", "3", "--wrap")
    assert done.exit_code != 0
    assert "period, wrap say how files are read, and no source is a file" in str(done.exception)


@pytest.mark.slow
def test_a_file_that_is_no_torus_says_so(tmp_path: Path) -> None:
    rows = "".join(f"{a!r} {b!r}\n" for a, b in np.random.default_rng(1).random((9, 2)).tolist())
    (tmp_path / "window.edat").write_text("0 0\n1 1\n0\n" + rows)
    told = "says that its box is no torus, and it is measured as one"
    assert f"window.edat: {told}" in run("analyze", tmp_path / "window.edat").output
    done = run("compare", tmp_path / "window.edat", "--out", tmp_path / "run", "--jobs", 1, "--quiet")
    assert f"warning: window (n=9, d=2): the file {told}" in done.output


@pytest.mark.slow
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
