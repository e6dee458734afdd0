"""``gbnbench stipple`` of several images into a folder: the same files, and what goes wrong with some."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

from gbnbench.cli import run

pytestmark = pytest.mark.slow

QUICK = ("-n", 40, "--method", "gbn[gradients=4]", "--quiet")


@pytest.fixture
def pictures(here: Path) -> Path:
    """Two grey ramps as a.png and b.png, a white sheet, and a file that is no image."""
    for name, most in (("a", 200), ("b", 240)):
        ramp = np.tile(np.linspace(0, most, 40), (30, 1))
        Pillow.fromarray(ramp.astype(np.uint8)).save(f"{name}.png")
    Pillow.fromarray(np.full((30, 40), 255, np.uint8)).save("white.png")
    Path("bad.png").write_text("no image")
    return here


def command(*arguments: object) -> int:
    return run(["stipple", *map(str, arguments)])


@pytest.mark.parametrize("suffix", ["svg", "txt", "png"])
def test_each_file_is_that_of_its_image_alone(pictures, suffix):
    page = () if suffix == "txt" else ("--width-mm", 50)
    assert command("a.png", "b.png", "-o", "out/", "--format", suffix, "--jobs", 2, *page, *QUICK) == 0
    for name in ("a", "b"):
        assert command(f"{name}.png", "-o", f"alone.{suffix}", *page, *QUICK) == 0
        assert Path(f"out/{name}.{suffix}").read_bytes() == Path(f"alone.{suffix}").read_bytes()


def test_a_bad_image_costs_only_itself(pictures, capsys):
    files = ("a.png", "bad.png", "white.png", "gone.png", "b.png")
    assert command(*files, "-o", "out/", "--format", ".csv", *QUICK) == 2
    said = capsys.readouterr()
    assert [line.split(":")[0] for line in said.out.splitlines()] == ["wrote out/a.csv", "wrote out/b.csv"]
    assert "3 of 5 images could not be drawn, and the same command tries only them again" in said.err
    assert "gone.png: there is no such file" in said.err
    assert "bad.png: is no image" in said.err
    assert "white.png has no place for points" in said.err
    assert "Traceback" not in said.err
    assert sorted(path.name for path in Path("out").iterdir()) == [".gbnbench", "a.csv", "b.csv"]


def test_what_was_drawn_is_kept_unless_anything_of_it_has_changed(pictures, capsys):
    asked = ("-o", "out", "--format", "txt", "--jobs", 1, *QUICK)
    assert command("a.png", "b.png", *asked) == 0
    capsys.readouterr()

    def verbs(*arguments: object) -> list[str]:
        assert command(*arguments) == 0
        return [line.split()[0] for line in capsys.readouterr().out.splitlines()]

    assert verbs("a.png", "b.png", *asked) == ["kept", "kept"]
    Path("b.png").write_bytes(Path("a.png").read_bytes())
    assert verbs("a.png", "b.png", *asked) == ["kept", "wrote"]
    Path("out/a.txt").write_text("scribbled over")
    assert verbs("a.png", "b.png", *asked) == ["wrote", "kept"]
    assert verbs("a.png", "b.png", *asked, "--seed", 1) == ["wrote", "wrote"]
    Path("out/.gbnbench/stippled.json").write_text("{")
    assert verbs("a.png", *asked, "--seed", 1) == ["wrote"]
    assert set(json.loads(Path("out/.gbnbench/stippled.json").read_text())["files"]) == {"a.txt"}


def test_an_image_by_its_name_is_drawn_too(here):
    assert command("coins", "-o", "out/", "--format", "txt", "--jobs", 1, *QUICK) == 0
    assert command("coins", "-o", "alone.txt", *QUICK) == 0
    assert Path("out/coins.txt").read_bytes() == Path("alone.txt").read_bytes()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (
            ("a.png", "b.png", "-o", "all.svg"),
            "into a folder: write -o all/ --format svg",
        ),
        (("a.png", "b.png", "-o", "bad.png"), "and bad.png is a file"),
        (("a.png", "b.png", "-o", "out/", "--format", "gif"), ".gif is drawn of one image at a time"),
        (("a.png", "b.png", "-o", "out/", "--format", "bmp"), "stipplings are written as"),
        (("a.png", "b.png", "-o", "out/", "--preview"), "--preview is of one image"),
        (("a.png", "./b/../a.png", "-o", "out/"), "would both be written as out/a.png"),
        (("a.png", "b.png", "-o", "."), "is the image itself"),
        (("a.png", "-o", "x.svg", "--format", "svg"), "--format is of the files in a folder"),
        (("a.png", "-o", "x.svg", "--jobs", 2), "--jobs and --executor share out the images of a folder"),
        ((), "Missing argument"),
    ],
)
def test_errors_say_what_was_wrong(pictures, capsys, arguments, says):
    before = sorted(pictures.iterdir())
    assert command(*arguments, *QUICK) == 2
    assert says in capsys.readouterr().err
    assert sorted(pictures.iterdir()) == before
