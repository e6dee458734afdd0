"""``gbnbench library`` from end to end: plan, making, kills, damage found, errors in words."""

from __future__ import annotations

import signal
import subprocess
from pathlib import Path

import click
import numpy as np
import pytest

import gbnbench
from gbnbench.cli import run
from gbnbench.cli.size_ranges import NumberRanges
from tests.cli.test_interruption import wait_for
from tests.processes import COMMAND
from tests.processes import command as process


def command(*arguments: object) -> int:
    return run(["library", *map(str, arguments)])


ASKED = ("jittered", "bnot", "-n", "16", "-d", "2-3", "--realizations", 2, "--jobs", 1)


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small library, made by the command once."""
    out = tmp_path_factory.mktemp("made") / "sets"
    assert command(*ASKED, "-o", out, "--quiet") == 0
    return out


def test_the_plan_says_what_is_made_and_what_is_refused_by_which_rule(here, capsys):
    assert command("bnot", "gbn", "-d", "2,3", "-n", "16-64,100", "--dry-run") == 0
    said = capsys.readouterr().out
    # 212 points in all of the sizes; 8 sets of bnot in 2D and of gbn in 2D and 3D, 8 bytes a coordinate
    assert f"12 files to be made: 96 sets, {212 * (2 + 2 + 3) * 8 * 8 / 1e6:.3g} MB" in said
    assert "refused, bnot, 4 files (3D, n=16..100), such as: bnot cuts the plane into power cells" in said
    assert "CPU time of one core: " in said
    assert list(here.iterdir()) == []


def test_the_plan_tells_what_is_there(library, capsys):
    assert command("jittered", "-n", "16,64", "-d", 2, "--realizations", 2, "-o", library, "--dry-run") == 0
    assert "1 file to be made, 1 there already: 2 sets" in capsys.readouterr().out


def test_what_is_made_can_be_listed_checked_and_loaded(library, capsys):
    assert command("--list", library) == 0
    said = capsys.readouterr().out
    assert "jittered/2d/jittered-2d-16.npy" in said
    assert "noise floor" in said
    assert "2 files, seed 0" in said
    assert command("--check", library) == 0
    assert capsys.readouterr().out == f"{library}: 2 of 2 files whole\n"
    x = gbnbench.ready_set("jittered", n=16, realization=1, library=library)
    assert np.array_equal(x, gbnbench.generate("jittered", n=16, realizations=2)[1])


def test_what_was_unpacked_can_be_added_to(library, here, capsys):
    assert command("--unpack", library, "-o", "copy") == 0
    asked = ("jittered", "-n", "16,64", "-d", 2, "--realizations", 2, "-o", "copy", "--jobs", 1)
    assert command(*asked, "--quiet") == 0
    assert "3 files (1 made, 1 found; " in capsys.readouterr().out


def test_a_damaged_file_is_named_with_exit_code_1(library, here, capsys):
    assert command("--unpack", library, "-o", "copy") == 0
    file = Path("copy/bnot/2d/bnot-2d-16.npy")
    data = bytearray(file.read_bytes())
    data[-3] ^= 4
    file.write_bytes(data)
    capsys.readouterr()
    assert command("--check", "copy") == 1
    out, err = capsys.readouterr()
    assert err == f"gbnbench: {file} was changed: its SHA-256 is not that of the manifest\n"
    assert out == "copy: 1 of 2 files whole; the command that made the library makes the rest again\n"
    assert command(*ASKED, "-o", "copy", "--quiet") == 0  # as is said: what was unpacked is a library too
    assert command("--check", "copy") == 0


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((), "give -o FOLDER or -o FILE.zip, or --dry-run"),
        (("bnot", "-d", "3", "--dry-run"), "bnot cuts the plane into power cells; got d=3, use d=2"),
        (("bnto", "--dry-run"), "no generator is named 'bnto'"),
        (("--check", "nothing"), "there is no folder or archive nothing"),
        (("--unpack", "bundled"), "--unpack goes with -o FOLDER"),
        (("--list", "bundled", "--check", "bundled"), "are done one at a time"),
        (("-o", "missing/sets.zip"), "there is no folder missing; make it first"),
        (("-n", "64-16", "--dry-run"), "a range must begin at 1 or more and not above its end; got 64-16"),
        (("-n", "17-31", "--dry-run"), "a range is of powers of two, and there is none in 17-31"),
        (("-d", "1-9999", "--dry-run"), "a range must hold at most 1000 numbers"),
        (("-d", "two", "--dry-run"), "must be whole numbers"),
    ],
)
def test_errors_are_words(here, capsys, arguments, says):
    assert command(*arguments) == 2
    assert says in capsys.readouterr().err
    assert list(here.iterdir()) == []


def test_a_file_in_the_way_is_refused(here, capsys):
    Path("sets").write_text("precious")
    assert command("-o", "sets") == 2
    assert "sets is a file; a library is a folder" in capsys.readouterr().err
    assert Path("sets").read_text() == "precious"


@pytest.mark.parametrize(
    ("text", "doubling", "numbers"),
    [
        ("16-128", True, (16, 32, 64, 128)),
        ("10-70,1000", True, (16, 32, 64, 1000)),
        ("1-3,8", False, (1, 2, 3, 8)),
        ("5", False, (5,)),
        ("2-3,3-4", False, (2, 3, 4)),
    ],
)
def test_ranges_are_of_powers_of_two_or_of_all_numbers(text, doubling, numbers):
    kind: click.ParamType = NumberRanges(doubling=doubling)
    assert kind.convert(text, None, None) == numbers


@pytest.mark.slow
def test_killed_in_the_middle_it_goes_on_to_the_same_bits(tmp_path):
    asked = ["library", "lloyd", "jittered", "-n", "144", "-d", "2", "--realizations", "6", "--quiet"]
    busy = subprocess.Popen([*COMMAND, *asked, "-o", "sets.zip", "--jobs", "1"], cwd=tmp_path)
    pieces = tmp_path / "sets.zip.unfinished" / "pieces"
    wait_for(lambda: len(list(pieces.rglob("*.npz"))) >= 3, busy)
    busy.kill()
    assert busy.wait() == -signal.SIGKILL
    kept = {path: path.read_bytes() for path in pieces.rglob("*.npz")}
    assert kept
    assert not (tmp_path / "sets.zip").exists()
    went_on = process(*asked, "-o", "sets.zip", "--jobs", "2", cwd=tmp_path)
    assert went_on.returncode == 0, went_on.stderr
    assert process(*asked, "-o", "straight", cwd=tmp_path).returncode == 0
    assert not pieces.exists()
    for name in ("lloyd", "jittered"):
        sets = gbnbench.ready_set(name, n=144, realization=None, library=tmp_path / "sets.zip")
        straight = np.load(tmp_path / "straight" / f"{name}/2d/{name}-2d-144.npy")
        assert sets.tobytes() == straight.tobytes()


@pytest.mark.slow
def test_a_worker_of_dask_makes_the_same_bits(tmp_path):
    asked = ["library", "stealthy", "-n", "16,64", "-d", "1-2", "--realizations", "3", "--quiet"]
    for name, *options in (("here", "--jobs", "1"), ("dask", "--executor", "dask:local", "--jobs", "2")):
        done = process(*asked, "-o", name, *options, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    for path in (tmp_path / "here").rglob("*.npy"):
        assert path.read_bytes() == (tmp_path / "dask" / path.relative_to(tmp_path / "here")).read_bytes()
