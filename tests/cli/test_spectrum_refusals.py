"""``gbnbench spectrum`` refuses in one line, replaces nothing that it reads, and keeps what is finished."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gbnbench
import gbnbench.cli.spectrum_run
from gbnbench.io.points import save
from tests.cli.spectrum_files import Said


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([], "name a FILE of points"),
        (["nowhere.txt"], "nowhere.txt: cannot be read: no such file"),
        (["bad.txt"], "bad.txt, line 2"),
        (["a.txt", "c.txt"], "a.txt has n=40, d=2, c.txt has n=30, d=2; --each"),
        (["a.txt", "--half", "--shells"], "--half and --shells do not go together"),
        (["a.txt", "--half", "--band", "1,2"], "--half and --band do not go together"),
        (["a.txt", "--at", "bad.txt", "--fmax", "3"], "--at and --fmax do not go together"),
        (["a.txt", "-n", "40"], "FILE and -n do not go together"),
        (["a.txt", "--at", "bad.txt"], "bad.txt, line 1: '0.5' is not an integer"),
        (["a.txt", "--weights", "bad.txt"], "bad.txt, line 1: 2 numbers in a line"),
        (["a.txt", "c.txt", "--each", "--weights", "bad.txt"], "weights are for sets of one size"),
        (["a.txt", "--fmax", "0"], "--fmax"),
        (["d3.npy", "--fmax", "100000"], "the largest fmax that fits is"),
        (["a.txt", "--fmax", "9" * 30], "more than 2^63"),
        (["a.txt", "--band", "3"], "the least and the largest |f|, such as 2,8"),
        (["a.txt", "--band", "3,nan"], "0 <= LOW <= HIGH"),
        (["a.txt", "--band", "1,9", "--fmax", "4"], "ask for fmax=9"),
        (["a.txt", "--floor", "1e-60"], "out of reach"),
        (["a.txt", "-o", "x.txt"], "written as .npz, .npy, .csv, .png, .pdf; got extension '.txt'"),
        (["a.txt", "-o", "no/x.npz"], "there is no folder no"),
        (["a.txt", "--shells", "-o", "x.npy"], "no room for the |f| of shells"),
        (["a.txt", "--at", "at.txt", "-o", "x.png"], "listed frequencies make no picture"),
        (["a.txt", "--fmax", "1500", "-o", "x.csv"], "write .npz or .npy"),
        (["b.csv", "-o", "./b.csv"], "is read here, and writing would replace it"),
        (["a.txt", "--band", "0,0"], "|f| in 0,0 (DC is left out)"),
        (["a.txt", "--explain", "--weights", "w30.txt"], "w30.txt: 30 numbers where 40 points need 40"),
        (["--explain", "-n", "40", "--weights", "w30.txt"], "w30.txt: 30 numbers where 40 points need 40"),
        (["cube.npz"], "cube.npz: is a spectrum, not points"),
        (["a.txt", "radial.npz"], "radial.npz: is a spectrum, not points"),
        (["a.txt", "--at", "cube.npz"], ".npz lists are not read"),
    ],
)
def test_what_cannot_be_is_one_line_and_exit_2(
    said: Said, arguments: list[str], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("bad.txt").write_text("0.5 0.5\n0.5 x\n")
    Path("at.txt").write_text("1 2\n")
    Path("w30.txt").write_text("1\n" * 30)
    said("a.txt", "--fmax", 2, "-o", "cube.npz")
    said("a.txt", "--shells", "--fmax", 2, "-o", "radial.npz")
    before = {path: path.read_bytes() for path in Path().iterdir()}
    out, err = said(*arguments, code=2)
    assert out == ""
    assert err.startswith("gbnbench: error: ")
    assert err.count("\n") == 1
    assert words in err
    assert {path: path.read_bytes() for path in Path().iterdir()} == before


def test_each_never_replaces_what_is_read(said: Said, sets: np.ndarray) -> None:
    for k in range(2):
        save(f"pts_{k}.csv", sets[k])
    os.link("pts_1.csv", "link.csv")
    Path("far").symlink_to(Path.cwd())
    Path("w_0.csv").write_text("1\n" * 40)
    Path("f_1.csv").write_text("1 2\n")
    kept = {path: path.read_bytes() for path in Path().iterdir() if path.is_file()}
    for arguments, name in (
        (["pts_0.csv", "pts_1.csv", "-o", "pts.csv"], "pts_0.csv"),
        (["a.txt", "pts_1.csv", "-o", "far/pts.csv"], "far/pts_1.csv"),
        (["a.txt", "link.csv", "-o", "pts.csv"], "pts_1.csv"),
        (["s.npz", "--weights", "w_0.csv", "-o", "w.csv"], "w_0.csv"),
        (["s.npz", "--at", "f_1.csv", "-o", "f.csv"], "f_1.csv"),
    ):
        reach = [] if "--at" in arguments else ["--fmax", 2]
        out, err = said(*arguments, "--each", *reach, code=2)
        expected = f"{name} is read here, and --each would replace it; choose another name"
        assert (out, err) == ("", f"gbnbench: error: {expected}\n")
    assert {path: path.read_bytes() for path in Path().iterdir() if path.is_file()} == kept
    said("a.txt", "b.csv", "--each", "--fmax", 2, "-o", "b.csv")  # b_0.csv and b_1.csv, not b.csv
    assert Path("b.csv").read_bytes() == kept[Path("b.csv")]
    assert Path("b_1.csv").is_file()


def test_a_run_that_is_stopped_says_what_it_keeps(said: Said, monkeypatch: pytest.MonkeyPatch) -> None:
    find, calls = gbnbench.analysis.spectrum.settings.SpectrumSettings.evaluate, []

    def stopped(*arguments: Any) -> Any:
        calls.append(1)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return find(*arguments)

    monkeypatch.setattr(gbnbench.analysis.spectrum.settings.SpectrumSettings, "evaluate", stopped)
    _, err = said("s.npz", "a.txt", "b.csv", "--each", "--fmax", 2, "-o", "q.npy", code=130)
    assert err == "gbnbench: stopped; 2 of 4 files are written and kept\n"
    assert sorted(path.name for path in Path().glob("q*")) == ["q_0.npy", "q_1.npy"]
