"""The example renderers: built and run with what the command exports, they err less than by chance."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gbnbench.cli import run
from tests.compilers import built, said
from tests.paths import DOCS

RENDERERS = DOCS / "renderers"


def exported(folder: Path, head: str, *arguments: str) -> None:
    """Export what the head of a renderer says; the name of the file comes behind -o."""
    assert f"gbnbench export {' '.join(arguments)}" in head
    at = arguments.index("-o") + 1
    assert run(["export", *arguments[:at], str(folder / arguments[at]), *arguments[at + 1 :]]) == 0


def test_the_renderer_in_cpp(tmp_path: Path):
    """At most 0.6 of the error of random samples; 0.51 was measured, as of four times as many samples."""
    source = tmp_path / "soft_shadow.cpp"
    shutil.copy(RENDERERS / source.name, source)
    text = source.read_text()
    exported(tmp_path, text, "gbn", "-n", "16", "-o", "sets.h", "--copies", "8")
    exported(tmp_path, text, "--mask", "64", "-o", "mask.h")
    program = built(source, "c++11", tmp_path)
    blue, random = (said(program, how) for how in ("blue", "random"))
    assert 0.005 < float(blue.stderr) < 0.6 * float(random.stderr)
    kind, width, height, top, *pixels = blue.stdout.split()
    assert (kind, width, height, top) == ("P2", "128", "128", "255")
    picture = np.array(pixels, int).reshape(128, 128)
    assert (picture == 0).mean() == pytest.approx(0.1, abs=0.05)  # the shadow
    assert picture.max() > 240


def test_the_renderer_in_python(tmp_path: Path):
    """At most 0.5 of the error of random samples; 0.41 was measured."""
    source = RENDERERS / "zone_plate.py"
    text = source.read_text()
    exported(tmp_path, text, "gbn", "-n", "16", "-o", "sets.bin")
    exported(tmp_path, text, "--mask", "64", "-o", "mask.png")
    errors = []
    for how in ("blue", "random"):
        command = [sys.executable, str(source), how, f"{how}.png"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path, timeout=120)
        assert done.returncode == 0, done.stderr
        errors.append(float(done.stdout))
    assert 0.01 < errors[0] < 0.5 * errors[1]
    picture = np.asarray(Image.open(tmp_path / "blue.png"))
    assert picture.shape == (128, 128)
    assert picture[-16:, -16:].mean() == pytest.approx(127, abs=3)  # rings that a pixel cannot hold are grey
