"""``gbnbench stipple`` with palettes, in progressive order, and as moving pictures."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from PIL import Image as Pillow
from PIL import ImageSequence

from gbnbench.api.drawing import draw_inks
from gbnbench.api.stipple import stipple
from gbnbench.cli import run
from gbnbench.core.errors import InputError
from gbnbench.reports.stippling import animation
from gbnbench.studies.stippling.darkness import Darkness

QUICK = ("--method", "gbn[gradients=5]", "--quiet")


@pytest.fixture
def picture(here: Path) -> Path:
    """Red on the left, half of it in the middle, black on the right, as c.png; a grey ramp as x.png."""
    values = np.zeros((24, 36, 3), np.uint8)
    values[:, :12], values[:, 12:24] = (200, 0, 0), (228, 128, 128)
    Pillow.fromarray(values).save("c.png")
    Pillow.fromarray(np.tile(np.linspace(0, 250, 40).astype(np.uint8), (30, 1))).save("x.png")
    return here


def command(*arguments: object) -> int:
    return run(["stipple", *map(str, arguments)])


def shown(name: str) -> list[np.ndarray]:
    with Pillow.open(name) as file:
        return [np.asarray(frame.convert("RGB"), float) for frame in ImageSequence.Iterator(file)]


def test_dots_of_a_palette_lie_on_their_colours(picture):
    palette = ("--palette", "#c80000,#000")
    for suffix, dpi in (("csv", ()), ("svg", ()), ("png", ("--dpi", 60))):
        assert command("c.png", "-n", 150, "-o", f"o.{suffix}", *palette, *dpi, *QUICK) == 0
    table = pd.read_csv("o.csv")
    red, black = (table[table.ink == ink] for ink in ("#c80000", "#000000"))
    assert len(table) == 150
    assert len(black) == pytest.approx(60, abs=2)
    assert black.x.min() >= 2 / 3
    assert red.x.max() < 2 / 3
    assert 'inkscape:label="#c80000" fill="#c80000"' in Path("o.svg").read_text()
    with Pillow.open("o.png") as drawn:
        assert (200, 0, 0) in {colour for _, colour in drawn.getcolors(1 << 20)}


def test_a_palette_is_found(picture):
    assert command("c.png", "-n", 40, "-o", "f.csv", "--palette", 2, *QUICK) == 0
    assert list(pd.read_csv("f.csv").ink.unique()) == ["#c80000", "#000000"]
    assert command("c.png", "-n", 40, "-o", "g.csv", "--colour", "palette", *QUICK) == 0
    assert list(pd.read_csv("g.csv").ink.unique()) == ["#c80000", "#000000"]  # there are no four


def test_inks_share_an_energy_only_with_gbn():
    inks = {name: Darkness(np.full((16, 16), 0.2), name) for name in ("red", "blue")}
    counts = {"red": 30, "blue": 30}

    def nearest(method):
        red, blue = (one.points for one in draw_inks(inks, counts, method=method).values())
        return np.sqrt(((red[:, None] - blue) ** 2).sum(axis=2).min())

    assert nearest("gbn[union=1]") > 2 * nearest("gbn[union=0]")
    with pytest.raises(InputError, match="rejection does not show"):
        draw_inks(inks, counts, method="rejection", seen=lambda _: None)


def test_a_progressive_file_is_the_same_dots_in_an_order(picture):
    assert command("x.png", "-n", 120, "-o", "d.csv", *QUICK) == 0
    assert command("x.png", "-n", 120, "-o", "p.csv", "--progressive", *QUICK) == 0
    drawn, ordered = (pd.read_csv(name) for name in ("d.csv", "p.csv"))
    assert {*map(tuple, drawn.to_numpy())} == {*map(tuple, ordered.to_numpy())}
    halves = [abs(table.x[:60].mean() - table.x.mean()) for table in (drawn, ordered)]
    assert halves[1] < 0.03  # 0.22 / sqrt(120) = 0.02 at random; the start's order is along a curve
    made = stipple("x.png", 120, method="gbn[gradients=5]", progressive=True)
    assert np.array_equal(made.points, ordered[["x", "y"]])


def test_frames_show_more_and_more_dots(picture):
    size = ("--width-mm", 40, "--margin-mm", 0, "--dpi", 50)
    assert command("x.png", "-n", 60, "-o", "p.gif", "--progressive", "--frames", 6, *size, *QUICK) == 0
    frames = shown("p.gif")
    dark = [255 - frame.mean() for frame in frames]
    assert len(frames) == 6
    assert frames[0].shape[:2] == (59, 79)
    assert all(more > less for less, more in pairwise(dark))
    assert command("x.png", "-n", 60, "-o", "p.png", "--progressive", *size, *QUICK) == 0
    assert np.abs(frames[-1] - shown("p.png")[0]).mean() < 1


def test_frames_show_how_dots_find_their_places(picture):
    size = ("--width-mm", 36, "--dpi", 50)
    assert command("c.png", "-n", 60, "-o", "f.gif", "--palette", "#c80000,#000", *size, *QUICK) == 0
    frames = shown("f.gif")
    assert len(frames) == 6  # the start and five gradients
    assert command("c.png", "-n", 60, "-o", "f.png", "--palette", "#c80000,#000", *size, *QUICK) == 0
    assert np.abs(frames[-1] - shown("f.png")[0]).mean() < 3  # 256 colours
    assert np.abs(frames[0] - frames[-1]).mean() > 5


MP4 = ("x.png", "-n", 30, "-o", "p.mp4", "--progressive", "--frames", 3, "--dpi", 30, *QUICK)


@pytest.mark.parametrize("which", ["the package's", "the PATH's"])
def test_an_mp4_is_written_by_the_ffmpeg_that_is_there(which, picture, monkeypatch):
    if which == "the PATH's":
        monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
        program = shutil.which("ffmpeg")
    else:
        program = animation.ffmpeg() if importlib.util.find_spec("imageio_ffmpeg") else None
    if program is None:
        pytest.skip(f"{which} ffmpeg is not installed")
    assert command(*MP4) == 0
    assert Path("p.mp4").read_bytes()[4:8] == b"ftyp"
    subprocess.run([program, "-v", "error", "-i", "p.mp4", "f%02d.png"], check=True)
    assert len(list(Path().glob("f??.png"))) == 2 + 40  # the last stays for two seconds
    size = ("--width-mm", 160, "--dpi", 30)
    assert command("x.png", "-n", 30, "-o", "p.png", "--progressive", *size, *QUICK) == 0
    last, still = (np.asarray(Pillow.open(name).convert("L"), float) for name in ("f42.png", "p.png"))
    assert np.abs(last[: still.shape[0], : still.shape[1]] - still).mean() < 3


def test_an_mp4_says_what_it_needs_or_why_ffmpeg_failed(picture, capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    monkeypatch.setattr(shutil, "which", lambda _: None)
    assert command(*MP4) == 2
    said = capsys.readouterr().err
    assert (
        "MP4 needs ffmpeg: pip install 'gbnbench[video]' or put ffmpeg on the PATH, or write a .gif" in said
    )
    failing = tmp_path / "ffmpeg"
    failing.write_text("#!/bin/sh\necho \"Unknown encoder 'libx264'\" >&2\nexit 1\n")
    failing.chmod(0o755)
    monkeypatch.setattr(shutil, "which", lambda _: str(failing))
    assert command(*MP4) == 2
    assert "ffmpeg wrote no MP4: Unknown encoder 'libx264'" in capsys.readouterr().err
    assert not Path("p.mp4").exists()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("-o", "o.svg", "--progressive", "--order", "tour"), "--progressive is an order of the dots"),
        (("-o", "o.svg", "--frames", 5), "--frames goes with -o FILE.gif or FILE.mp4; got o.svg"),
        (("-o", "o.gif", "--frames", 7), "there are 6 states while dots find their places: --frames must be"),
        (("-o", "o.gif", "--progressive", "--frames", 31), "there are 30 dots: --frames must be at most 30"),
        (("-o", "o.gif", "--method", "secord"), "secord does not show how its dots find their places"),
        (("-o", "o.gif", "--method", "gbn[gradients=0]"), "gbn[gradients=0] moves no dots"),
        (("-o", "o.gif", "--dpi", 1400), "6 frames of"),
        (("-o", "o.svg", "--palette", "#00"), "'#00' is no colour"),
        (("-o", "o.svg", "--palette", "#000", "--colour", "cmyk"), "leave out --colour cmyk"),
        (("-o", "o.svg", "--palette", "#000", "--invert"), "invert goes with one ink"),
    ],
)
def test_errors_say_what_was_wrong(picture, capsys, arguments, says):
    assert command("x.png", "-n", 30, *arguments, *(() if "--method" in arguments else QUICK)) == 2
    assert says in capsys.readouterr().err
    assert not Path(arguments[1]).exists()
