"""``gbnbench analyze --window``: text, JSON, picture, and what is refused."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

from gbnbench.cli import gbnbench


@pytest.fixture(name="pixels")
def _pixels(tmp_path):
    path = tmp_path / "my pixels.csv"
    x = np.random.default_rng(0).random((200, 2)) * [512, 256]
    x[0] = [512, 256]  # the border is part of the window
    np.savetxt(path, x, delimiter=",", header="x,y", comments="")
    return path


def _run(*arguments):
    return CliRunner().invoke(gbnbench, ["analyze", *map(str, arguments)])


def test_text_has_scalars_and_both_tables(pixels):
    result = _run(pixels, "--window", "0,512,0,256")
    assert result.exit_code == 0, result.output
    assert "200 points, d=2, in the window 0,512,0,256" in result.stdout
    assert "+-" in result.stdout
    assert "structure factor" in result.stdout
    assert "pair correlation" in result.stdout


def test_json_has_all_and_only_finite_numbers(pixels):
    result = _run(pixels, "--window", "0,512,0,256", "--json")
    (found,) = json.loads(result.stdout)
    assert found["n"] == 200
    assert found["window"] == {"low": [0, 0], "high": [512, 256]}
    assert found["estimates"]["intensity"] == pytest.approx(200 / 512 / 256)
    assert found["standard_errors"]["nu_peak"] is None
    assert {"k", "S", "standard_error", "resolved"} <= set(found["structure_factor"][0])
    assert {"r", "g", "standard_error"} <= set(found["pair_correlation"][0])


def test_a_picture_is_written_for_each_set(tmp_path):
    path = tmp_path / "sets.npy"
    np.save(path, np.random.default_rng(1).random((2, 30, 2)))
    result = _run(path, "--window", "0,1,0,1", "-o", tmp_path / "out.png")
    assert result.exit_code == 0, result.output
    assert [p.name for p in sorted(tmp_path.glob("*.png"))] == ["out-0.png", "out-1.png"]


def test_the_box_of_a_file_is_its_window(tmp_path):
    path = tmp_path / "box.edat"
    x = np.random.default_rng(2).random((50, 2)) * [3, 2]
    rows = "\n".join(f"{a!r} {b!r}" for a, b in x.tolist())
    path.write_text(f"0 0\n3 2\n0\n{rows}\n")
    result = _run(path, "--window", "file", "--json")
    assert result.exit_code == 0, result.output
    assert json.loads(result.stdout)[0]["window"]["high"] == [3, 2]


def test_a_file_without_a_box_says_so(tmp_path):
    np.savetxt(tmp_path / "unit.txt", np.random.default_rng(3).random((30, 2)))
    result = _run(tmp_path / "unit.txt", "--window", "file")
    assert result.exit_code == 2
    assert "tells no box" in result.output


def test_errors_of_the_box_speak_of_the_window(tmp_path):
    boxed, pixels = tmp_path / "box.edat", tmp_path / "pixels.txt"
    boxed.write_text("0 0\n3 2\n0\n0.5 0.5\n")
    pixels.write_text("12.5 7.5\n1.5 2.5\n")
    for path, window, said in (
        (boxed, "0,12,0,20", "which --window contradicts; --window file takes that"),
        (pixels, "file", "no box is told: give the window's ends for 'file', such as 0,512,0,256"),
        (pixels, "0,20", "--window 0,20 is of 1 axis, and its points have d=2: write 0,20,0,20 for all"),
        (pixels, "0,5,0,9", "coordinate 12.5 is not in [0, 5], the window; give one that holds all points"),
    ):
        result = _run(path, "--window", window)
        assert result.exit_code == 2
        assert said in result.output
        assert "--bounds" not in result.output
    result = _run(pixels, "--window", "abc")
    assert "such as 0,512,0,512; got 'abc'; 'file' takes the box" in str(result.exception)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (["--window", "0,100,0,256"], "my pixels.csv"),
        (["--window", "0,512,0"], "--window"),
        (["--window", "5,5"], "--window"),
        (["--window", "0,512,0,256", "--period", "512"], "leave out"),
        (["--window", "0,512,0,256", "-o", "x.tiff"], ".png"),
        (["--window", "0,512,0,256", "--box"], "--box"),
        (["-o", "x.png"], "--window"),
    ],
)
def test_errors_are_one_line_and_exit_code_2(pixels, more, said):
    result = _run(pixels, *more)
    assert result.exit_code == 2 or isinstance(result.exception, ValueError)
    assert said in f"{result.output}{result.exception}"
