"""``gbnbench generate`` watched: progress, traces and their spectra, checkpoints, and errors in words."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from gbnbench.cli import run
from gbnbench.generators.registry import find, generate


def command(*arguments: object) -> int:
    return run(["generate", *map(str, arguments)])


def test_a_trace_and_spectra_stand_beside_the_points(here, capsys):
    asked = ("gbn[gradients=30]", "-n", 200, "--realizations", 2, "-o", "x.npy")
    assert command(*asked, "--trace", "t.csv", "--spectra-at", "1,10,30") == 0
    assert np.array_equal(np.load("x.npy"), generate("gbn[gradients=30]", n=200, realizations=2))
    trace = pd.read_csv("t.csv")
    assert list(trace.columns) == ["set", "gradient", "energy", "excess", "largest", "step"]
    assert len(trace) == 60
    spectra = pd.read_csv("t-spectra.csv")
    assert sorted(set(spectra.gradients)) == [1, 10, 30]
    floors = [spectra[(spectra.gradients == at) & (spectra.nu <= 0.25)].power.mean() for at in (1, 10, 30)]
    assert floors[0] > 10 * floors[1] > 100 * floors[2]
    assert np.allclose(spectra.filtered, spectra.power * np.exp(-((2 * np.pi * spectra.nu) ** 2)))
    assert "1, 10, 30 gradients" in capsys.readouterr().out


def test_explain_needs_no_file(here, capsys):
    assert command("gbn", "-n", 4096, "--explain") == 0
    without = capsys.readouterr().out
    assert command("gbn", "-n", 4096, "--explain", "-o", "x.npy") == 0
    assert capsys.readouterr().out == without != ""
    assert list(Path().iterdir()) == []


def test_the_memory_of_a_large_set_is_stated_as_it_was_measured(here, capsys):
    """A million points in the plane took 0.76 to 0.88 GB, the more after a kill."""
    assert command("gbn", "-n", 1_000_000, "--explain") == 0
    assert "about 0.96 GB of memory at most" in capsys.readouterr().out


def test_sets_of_a_target_are_told_with_how_near_they_came(here, capsys):
    """By this process and by workers alike, of the sets in the file."""
    asked = ("targeted[target=staircase,iterations=20]", "-n", 100, "--realizations", 2, "-o", "x.npy")
    fit = find(asked[0]).fit(generate(asked[0], n=100, realizations=2))
    for more in ((), ("--jobs", 1)):
        assert command(*asked, *more) == 0
        assert capsys.readouterr().out.splitlines()[-1] == str(fit)


def test_a_checkpoint_is_removed_when_the_points_are_written(here):
    assert command("gbn[gradients=3]", "-n", 50, "-o", "x.txt", "--checkpoint", "state") == 0
    assert not Path("state").exists()
    assert Path("x.txt").exists()


def test_a_foreign_checkpoint_is_an_error_that_keeps_it(here, capsys):
    Path("notes.txt").write_text("precious")
    assert command("gbn[gradients=3]", "-n", 50, "-o", "x.txt", "--checkpoint", "notes.txt") == 2
    assert "notes.txt is no checkpoint of gbnbench" in capsys.readouterr().err
    assert Path("notes.txt").read_text() == "precious"
    assert not Path("x.txt").exists()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("gbn",), "Missing option '-o' / '--out'"),
        (("gbn", "-o", "x.txt", "--spectra-at", "10"), "--spectra-at goes with --trace"),
        (("gbn", "-o", "x.txt", "--trace", "t.txt"), "a trace is a .csv file; got t.txt"),
        (("random", "-o", "x.txt", "--trace", "t.csv"), "random has no trace"),
        (("random", "-o", "x.txt", "--checkpoint", "c"), "random has no checkpoint"),
        (("gbn[cutoff=2]", "-d", "8", "-o", "x.txt"), "d must be at most 3 where the kernel is cut off"),
        (("gbn[cutoff=9]", "-n", "64", "-o", "x.txt"), "n must be at least 324"),
        (("gbn[edge=0.01]", "-n", "64", "-o", "x.txt"), "edge must be at least 0.125"),
        (
            ("gbn", "-o", "x.txt", "--trace", "t.csv", "--spectra-at", "999"),
            "--spectra-at must be at most 320",
        ),
        (("gbn", "-o", "no/x.txt"), "there is no folder no"),
        (("gbn", "-o", "x.txt", "--trace", "no/t.csv"), "there is no folder no"),
        (("gbn", "-o", "x.txt", "--checkpoint", "no/c"), "there is no folder no"),
        (("gbn", "-o", "x.npz", "--checkpoint", "x.npz"), "a checkpoint needs a file of its own"),
        (("gbn", "-o", "x.txt", "-n", "10000000000000"), "GB of memory, and this machine has"),
        (("random", "-o", "x.txt", "--realizations", "100000000000"), "draw fewer at a time"),
        (("gbn[gradients=50,method=descent]", "-o", "x.txt"), "for the paper's descent say iterations"),
        (("gbn[projection_edge=0.3]", "-o", "x.txt"), "goes with projections"),
        (("gbn[cutoff=0.01]", "-o", "x.txt"), "nothing would move"),
        (("gbn[polish=5]", "-o", "x.txt"), "polish=5 binds"),
    ],
)
def test_errors_say_what_was_wrong(here, capsys, arguments, says):
    assert command(*arguments) == 2
    assert says in capsys.readouterr().err
    assert list(here.iterdir()) == []


def test_long_draws_say_how_far_they_are(here, capsys, monkeypatch):
    monkeypatch.setattr(sys.modules["gbnbench.cli.generate"], "PATIENCE", 0.0)
    monkeypatch.setattr("gbnbench.execution.progress.QUIET_SECONDS", 0.0)
    assert command("gbn[gradients=4]", "-n", 50, "-o", "x.txt") == 0
    told = capsys.readouterr().err
    assert "1/4 gbn[gradients=4], excess" in told
    assert "4/4 gbn[gradients=4], excess" in told
    assert command("gbn[gradients=4]", "-n", 50, "-o", "x.txt", "--quiet") == 0
    assert capsys.readouterr().err == ""


def test_an_array_that_is_no_checkpoint_is_refused(here, capsys):
    np.save("points.npy", np.zeros((3, 2)))
    assert command("gbn", "-n", 50, "-o", "x.txt", "--checkpoint", "points.npy") == 2
    assert "points.npy is no checkpoint" in capsys.readouterr().err


def test_ctrl_c_keeps_the_state_and_says_how_to_go_on(here, capsys, monkeypatch):
    from gbnbench.generators.gbn.optimiser import Nesterov

    expected = generate("gbn[gradients=20]", n=100)
    advance, calls = Nesterov.advance, []

    def stopped(self):
        calls.append(1)
        if len(calls) == 12:
            self.gradients += 1  # in the middle of a step
            raise KeyboardInterrupt
        advance(self)

    with monkeypatch.context() as patched:
        patched.setattr(Nesterov, "advance", stopped)
        assert command("gbn[gradients=20]", "-n", 100, "-o", "x.npy", "--checkpoint", "state") == 130
    assert "repeat the command to continue from state" in capsys.readouterr().err
    assert int(np.load("state")["gradients"]) == 11
    assert command("gbn[gradients=20]", "-n", 100, "-o", "x.npy", "--checkpoint", "state") == 0
    assert np.array_equal(np.load("x.npy"), expected)
