"""``gbnbench export``: what it writes and says, its warnings, and one line for what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gbnbench.cli import run
from gbnbench.io.points import load, save


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_sets_with_projections_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["export", "jittered", "-n", "64", "-d", "3", "-o", "sets.h", "--copies", "2"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0] == "wrote sets.h: 2 sets of 64 points, d=3, float32"
    assert said[1].startswith("set 1: set 0 of the source; ")
    assert [line.split()[0] for line in said[4:11]] == ["all", "0", "1", "2", "0+1", "0+2", "1+2"]
    assert said[-1] == "noise floor and P(1) are 1 for random points; of 2 sets, as written"
    assert run(["export", "jittered", "-n", "64", "-d", "3", "-o", "sets.h"]) == 0
    assert capsys.readouterr().out.startswith(
        "wrote sets.h: 1 set of 64 points, d=3, float32, replacing what"
    )


def test_transforms_of_a_file(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    x = np.random.default_rng(2).random((20, 2))
    save("in.txt", x)
    call = ["export", "in.txt", "-o", "out.json", "--swap", "0,1", "--flip", "1", "--shift", "0.5,0"]
    assert run([*call, "--repeat", "2x2"]) == 0
    out = capsys.readouterr().out
    assert "a tile of 2 x 2, each point scaled to the whole" in out
    assert "set 0: set 0 of the source; axes in the order 1,0; flipped on 1; shifted by 0.5,0.0" in out
    expected = np.stack([(x[:, 1] + 0.5) % 1, 1 - x[:, 0]], axis=1) / 2
    assert load("out.json")[:20] == pytest.approx(expected, abs=1e-15)


def test_binary_and_json_output(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["export", "stealthy", "-n", "256", "-o", "sets.bin", "--json"]) == 0
    said = capsys.readouterr()
    record = json.loads(said.out)
    assert record["files"] == ["sets.bin", "sets.bin.json"]
    assert record["noise_floor_before_rounding"] < 1e-27 < record["quality"][0]["noise_floor"]
    assert said.err.startswith("gbnbench: warning: rounding to float32 raises the noise floor from ")
    assert run(["export", "stealthy", "-n", "256", "-o", "sets.bin", "--type", "float64"]) == 0
    assert capsys.readouterr().err == ""


def test_a_mask(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["export", "--mask", "24x16", "-o", "mask.png", "--bits", "16", "--seed", "2"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0] == "wrote mask.png: mask of 24 x 16 pixels, 16 bits a pixel"
    assert said[2].split() == ["level", "ones", "below", "f/2", "below", "f/4"]
    values = np.asarray(Image.open("mask.png"))
    assert values.shape == (16, 24)
    assert run(["export", "--mask", "8x4x3", "-o", "mask.bin", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["shape"] == [3, 4, 8]


def test_a_folder_of_a_generators_name_is_not_read(here: Path) -> None:
    (here / "jittered").mkdir()
    for _ in range(2):
        assert run(["export", "jittered", "-n", "16", "-o", "jittered/sets.npy", "--quiet"]) == 0


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["-o", "x.h"], "name sets, such as gbn or sets.npz, or a mask by --mask 64: one of the two"),
        (["gbn", "--mask", "8", "-o", "x.h"], "one of the two"),
        (["--mask", "8", "-n", "64", "-o", "x.h"], "-n belongs to sets: leave it out"),
        (["--mask", "8", "--type", "float32", "-o", "x.h"], "--type belongs to sets"),
        (["gbn", "--sigma", "2", "-o", "x.h"], "--sigma belongs to masks"),
        (
            ["--mask", "8x", "-o", "x.h"],
            "--mask takes whole numbers, such as 64, 128x64 or 64x64x16;",
        ),
        (["gbn", "--repeat", "2,2", "-o", "x.h"], "--repeat takes whole numbers, such as 2x2; got '2,2'"),
        (["gbn", "--flip", "x", "-o", "x.h"], "--flip takes axes counted from 0"),
        (["gbn", "--swap", "0", "-o", "x.h"], "swap must name two axes of 0 to 1"),
        (["gbn", "--shift", "a", "-o", "x.h"], "--shift takes random or numbers"),
        (["nowhere.txt", "-o", "x.h"], "nowhere.txt"),
        (["empty.txt", "-o", "x.h"], "empty.txt: the file is empty"),
        (["nan.txt", "-o", "x.h"], "nan.txt, line 1"),
        (["good.txt", "-o", "good.txt"], "good.txt is read here, and writing would replace it"),
        (["./sets", "-o", "sets/b.txt"], "sets/b.txt is read here, and writing would replace it"),
        (["points.bin.json", "-o", "points.bin"], "points.bin.json is read here, and writing would replace"),
        (["good.txt", "-o", "x.doc"], "sets are exported as .h, .bin, .raw, "),
        (["good.txt", "-o", "folder.h"], "is a directory"),
    ],
)
def test_what_is_refused_is_one_line(here: Path, capsys: pytest.CaptureFixture[str], arguments, said) -> None:
    (here / "empty.txt").write_text("")
    (here / "nan.txt").write_text("nan 0.5\n0.2 0.3\n")
    (here / "good.txt").write_text("0.1 0.5\n0.2 0.3\n")
    (here / "folder.h").mkdir()
    (here / "sets").mkdir()
    (here / "sets" / "a.txt").write_text("0.1 0.5\n0.2 0.3\n")
    (here / "sets" / "b.txt").write_text("0.4 0.5\n0.2 0.3\n")
    (here / "points.bin.json").write_text('{"points": [[0.1, 0.5], [0.2, 0.3]]}')
    before = sorted(here.rglob("*"))
    assert run(["export", *arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith("gbnbench: error: ")
    assert error.count("\n") == 1
    assert said in error
    assert sorted(here.rglob("*")) == before
