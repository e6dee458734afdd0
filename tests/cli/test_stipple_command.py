"""``gbnbench stipple``: files of every kind hold the same dots, and bad input is one line."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from PIL import Image as Pillow

from gbnbench.api.stipple import stipple
from gbnbench.cli import run

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
QUICK = ("--method", "gbn[gradients=5]", "--quiet")


@pytest.fixture
def picture(here: Path) -> Path:
    """A grey ramp with a white margin on the right, as x.png."""
    values = np.full((30, 40), 255, np.uint8)
    values[:, :32] = np.linspace(0, 250, 32)
    Pillow.fromarray(values).save("x.png")
    return here


def command(*arguments: object) -> int:
    return run(["stipple", *map(str, arguments)])


def page(suffix: str, width: float) -> tuple[object, ...]:
    """Options of a page without margin, which text has none of."""
    return () if suffix in ("csv", "txt") else ("--width-mm", width, "--margin-mm", 0)


def drawing(name: str) -> ElementTree.Element:
    return ElementTree.parse(name).getroot()  # noqa: S314 - it is our own


def test_every_format_holds_the_same_dots(picture, capsys):
    for suffix in ("svg", "pdf", "eps", "gcode", "csv", "txt", "png"):
        assert command("x.png", "-n", 50, "-o", f"o.{suffix}", *page(suffix, 80), *QUICK) == 0
    said = capsys.readouterr().out
    assert "wrote o.svg: 50 dots of black, " in said
    assert "mm across, on 80 x 60 mm" in said
    made = stipple("x.png", 50, method="gbn[gradients=5]")
    mm = made.pixels * 2
    table = pd.read_csv("o.csv")
    assert np.array_equal(table[["x", "y", "amplitude"]], np.column_stack([made.points, made.amplitudes]))
    assert np.array_equal(np.loadtxt("o.txt"), np.column_stack([made.points, made.amplitudes]))
    circles = list(drawing("o.svg").iter(f"{SVG}circle"))
    found = np.array([[float(c.get("cx")), float(c.get("cy"))] for c in circles])
    assert found == pytest.approx(mm, abs=6e-5)
    assert float(circles[0].get("r")) == pytest.approx(2 * made.radius, abs=6e-5)
    dots = re.findall(r"^(\S+) (\S+) (\S+) d$", Path("o.eps").read_text(), re.MULTILINE)
    assert np.array(dots, float)[:, :2] == pytest.approx(mm, abs=6e-5)
    moves = re.findall(r"^G0 X(\S+) Y(\S+)$", Path("o.gcode").read_text(), re.MULTILINE)
    assert np.array(moves, float)[:50] == pytest.approx(np.array([0, 60]) + mm * [1, -1], abs=6e-4)
    stream = re.search(rb"/FlateDecode >>\nstream\n(.*?)\nendstream", Path("o.pdf").read_bytes(), re.DOTALL)
    drawn = re.findall(r"^q (\S+) 0 0 \S+ (\S+) (\S+) cm /D Do Q$", zlib.decompress(stream[1]).decode(), re.M)
    assert np.array(drawn, float)[:, 1:] == pytest.approx(mm, abs=6e-5)
    with Pillow.open("o.png") as shown:
        assert shown.size == (945, 709)
        assert shown.info["dpi"] == pytest.approx((300, 300), abs=0.01)


def test_svg_is_a_page_in_millimetres_with_layers(picture):
    Pillow.fromarray(np.random.default_rng(1).integers(0, 256, (20, 30, 3), np.uint8)).save("c.png")
    assert command("c.png", "-n", 90, "-o", "c.svg", "--colour", "cmyk", *page("svg", 160), *QUICK) == 0
    root = drawing("c.svg")
    assert (root.get("width"), root.get("viewBox")) == ("160mm", "0 0 160 106.6667")
    layers = root.findall(f"{SVG}g")
    assert [g.get(f"{INKSCAPE}label") for g in layers] == ["yellow", "magenta", "cyan", "black"]
    assert {g.get(f"{INKSCAPE}groupmode") for g in layers} == {"layer"}
    assert len({g.get("fill") for g in layers}) == 4
    assert sum(len(g.findall(f"{SVG}circle")) for g in layers) == 90
    assert all(
        child.tag.removeprefix(SVG) in ("title", "desc", "g") for child in root
    )  # nothing else to plot
    assert command("c.png", "-n", 90, "-o", "c.csv", "--colour", "cmyk", *QUICK) == 0
    assert pd.read_csv("c.csv").ink.value_counts().sum() == 90
    for suffix in ("pdf", "eps", "png", "gcode", "txt"):
        assert command("c.png", "-n", 90, "-o", f"o.{suffix}", "--colour", "cmyk", *QUICK) == 0
    with Pillow.open("o.png") as shown:
        assert shown.mode == "RGB"


def test_an_ink_that_is_not_needed_has_no_layer(here):
    Pillow.fromarray(np.full((9, 9, 3), (255, 0, 0), np.uint8)).save("red.png")
    assert command("red.png", "-n", 20, "-o", "red.csv", "--colour", "cmyk", *QUICK) == 0
    assert pd.read_csv("red.csv").ink.value_counts().to_dict() == {"yellow": 10, "magenta": 10}


def test_dots_of_a_size_are_as_many_as_cover_what_is_dark(here, capsys):
    Pillow.fromarray(np.full((20, 20), 127, np.uint8)).save("g.png")
    assert command("g.png", "-o", "h.csv", "--dot-mm", 0.001, *QUICK) == 2
    assert not Path("h.csv").exists()
    assert command("g.png", "-o", "g.csv", "--dot-mm", 1, "--width-mm", 40, *QUICK) == 0
    wanted = round(39**2 * (128 / 255) / (np.pi / 4))  # half a dot is left free on each side
    assert len(pd.read_csv("g.csv")) == wanted
    assert f"{wanted:,} dots of black\n" in capsys.readouterr().out


def test_dots_by_tone_cover_what_is_dark(picture):
    for suffix in ("svg", "csv"):
        tone = ("--dots", "tone", *page(suffix, 160))
        assert command("x.png", "-n", 400, "-o", f"t.{suffix}", *tone, *QUICK) == 0
    circles = drawing("t.svg").iter(f"{SVG}circle")
    x, r = np.array([[float(c.get("cx")) / 4, float(c.get("r")) / 4] for c in circles]).T
    dark = np.zeros(40)
    dark[:32] = 1 - np.floor(np.linspace(0, 250, 32)) / 255
    assert np.pi * (r**2).sum() == pytest.approx(30 * dark.sum(), rel=1e-3)
    for low, high in ((0, 8), (8, 16), (16, 24)):
        inside = (x >= low) & (x < high)
        assert np.pi * (r[inside] ** 2).sum() == pytest.approx(30 * dark[low:high].sum(), rel=0.1)
    assert r[x < 8].mean() > 1.2 * r[x > 20].mean()


def test_a_tour_is_shorter_and_its_length_is_told(picture, capsys):
    assert command("x.png", "-n", 300, "-o", "d.csv", *QUICK) == 0
    capsys.readouterr()
    assert command("x.png", "-n", 300, "-o", "t.csv", "--order", "tour", *QUICK) == 0
    said = capsys.readouterr().out
    told = float(re.search(r"tour of black: (\S+) m", said)[1])
    drawn, toured = (pd.read_csv(name).to_numpy() for name in ("d.csv", "t.csv"))
    assert {*map(tuple, drawn)} == {*map(tuple, toured)}
    lengths = [np.hypot(*np.diff(x[:, :2] * (40, 30), axis=0).T).sum() for x in (drawn, toured)]
    assert lengths[1] < 0.95 * lengths[0]
    assert "m on a page 160 mm wide\nwrote t.csv: 300 dots of black\n" in said  # points have no size
    assert command("x.png", "-n", 300, "-o", "t.svg", "--order", "tour", *QUICK) == 0
    said = capsys.readouterr().out
    assert f"tour of black: {told:.4g} m\n" in said
    across = float(re.search(r"(\S+) mm across", said)[1])  # half of it is left free on each side
    assert told == pytest.approx(lengths[1] * (160 - across) / 40 / 1000, rel=1e-3)


def test_gcode_follows_a_template(picture):
    Path("pen.toml").write_text(
        'start = "M3"\nmove = "X{x:.1f}Y{y:.1f}"\ndown = "D"\nup = "U"\ny_up = false\n'
    )
    assert command("x.png", "-n", 2, "-o", "o.gcode", "--gcode-template", "pen.toml", *QUICK) == 0
    lines = Path("o.gcode").read_text().splitlines()
    assert lines[0] == "M3"
    assert [line[0] for line in lines[3:9]] == ["X", "D", "U", "X", "D", "U"]


def test_a_preview_is_braille(picture, capsys):
    assert command("x.png", "-n", 60, "-o", "o.csv", "--preview", *QUICK) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if line[0] >= "⠀"]
    assert {len(line) for line in lines} == {76}
    assert 50 <= sum((ord(sign) - 0x2800).bit_count() for line in lines for sign in line) <= 60


def test_one_dot_and_fine_ones_are_told(picture, capsys):
    assert command("x.png", "-n", 1, "-o", "o.svg", "--dot-mm", 0.00001, *QUICK) == 0
    assert "wrote o.svg: 1 dot of black, 0.00001 mm across" in capsys.readouterr().out
    assert "<desc>1 dot of black; " in Path("o.svg").read_text()


def test_an_animation_is_said(here, capsys):
    first, second = (Pillow.fromarray(np.full((9, 9), grey, np.uint8)) for grey in (0, 99))
    first.save("a.gif", save_all=True, append_images=[second])
    assert command("a.gif", "-n", 5, "-o", "o.csv", *QUICK) == 0
    assert "a.gif has 2 frames: the first is taken" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (
            ("x.png", "-o", "o.jpg"),
            "stipplings are written as .png, .svg, .pdf, .eps, .gcode, .txt, .csv, .gif, .mp4",
        ),
        (("x.png", "-o", "x.png"), "x.png is the image itself: name another file"),
        (("x.png", "-o", "no/o.svg"), "there is no folder no"),
        (("no.png", "-o", "o.svg"), "no.png: there is no such file"),
        (("kamera", "-o", "o.svg"), "did you mean 'camera'?"),
        (("bad.png", "-o", "o.svg"), "bad.png: is no image that Pillow reads"),
        (("part.png", "-o", "o.svg"), "part.png: is a damaged image, or only a part of one"),
        (("nan.npy", "-o", "o.svg"), "nan.npy: 1 of the pixels' values are nan"),
        (("volume.npy", "-o", "o.svg"), "volume.npy is a volume"),
        (("white.png", "-o", "o.svg"), "white.png has no place for points"),
        (("white.png", "-o", "o.svg", "--colour", "cmyk"), "white.png has no place for points"),
        (("x.png", "-o", "o.svg", "--width-mm", "0"), "--width-mm must be above 0"),
        (("x.png", "-o", "o.svg", "--width-mm", "20000"), "a page is at most 10000 mm"),
        (("x.png", "-o", "o.svg", "--dot-mm", "-1"), "--dot-mm must be above 0"),
        (("x.png", "-o", "o.svg", "--dot-mm", "1", "--dots", "tone"), "--dot-mm is of dots of one size"),
        (("x.png", "-o", "o.svg", "--gcode-template", "t.toml"), "--gcode-template goes with -o FILE.gcode"),
        (("x.png", "-o", "o.gcode", "--gcode-template", "t.toml"), "t.toml: move holds {z}; it can hold {x}"),
        (("x.png", "-o", "o.gcode", "--gcode-template", "no.toml"), "no.toml: there is no such file"),
        (("x.png", "-o", "o.svg", "--gamma", "-1"), "gamma must be above 0"),
        (("x.png", "-o", "o.svg", "--method", "gnb"), "did you mean 'gbn'?"),
        (("x.png", "-o", "o.png", "--dpi", "99999"), "dpi must be at least 1"),
        (("x.png", "-o", "o.png", "--dpi", "0"), "dpi must be at least 1"),
        (("x.png", "-o", "o.svg", "--dot-mm", "161"), "--dot-mm 161 is as wide as the page or wider"),
        (("x.png", "-o", "o.svg", "--margin-mm", "80"), "--margin-mm must be at least 0 and less than half"),
        (
            ("x.png", "-o", "o.csv", "--margin-mm", "0"),
            "holds points and no page: leave out --margin-mm",
        ),
        (
            ("x.png", "-o", "o.txt", "--width-mm", "90"),
            "o.txt holds points and no page: leave out --width-mm",
        ),
        (("x.png", "-o", "o.csv", "--dot-mm", "2"), "o.csv holds points and no page: leave out --dot-mm"),
        (("x.png", "-o", "o.txt", "--width-mm", "9", "--dot-mm", "2"), "leave out --width-mm and --dot-mm"),
        (("x.png", "-o", "o.txt", "--paper", "red"), "holds points and no page: leave out --paper"),
        (("x.png", "-o", "o.gcode", "--paper", "red"), "is drawn on the paper that lies there"),
        (("x.png", "-o", "o.svg", "--paper", "rad"), "'rad' is no colour"),
        (("x.png", "-o", "o.svg", "--ink", "#fff"), "ink and paper are both #ffffff"),
        (("x.png", "-o", "o.svg", "--ink", "red", "--palette", "2"), "--paper and --ink are of one ink"),
        (("x.png", "-o", "o.svg", "--dpi", "300"), "--dpi is for pixels, which .png, .gif and .mp4 have"),
        (("x.png", "-o", "o.gif", "--order", "tour"), "--order tour is not to be seen in o.gif"),
        (("x.png", "-o", "o.gcode", "--gcode-template", "still.toml"), "dots would lie in one place"),
        (("x.png", "-o", "o.svg", "--colour", "cmyk", "--invert"), "invert goes with one ink"),
    ],
)
def test_errors_say_what_was_wrong(picture, capsys, arguments, says):
    Path("bad.png").write_text("hello")
    Path("part.png").write_bytes(Path("x.png").read_bytes()[:-40])
    np.save("nan.npy", np.array([[0.5, np.nan]]))
    np.save("volume.npy", np.ones((5, 6, 7)))
    Pillow.fromarray(np.full((4, 4), 255, np.uint8)).save("white.png")
    Path("t.toml").write_text('move = "G0 {z}"')
    Path("still.toml").write_text('move = "G0"')
    before = sorted(picture.iterdir())
    assert command(*arguments, "-n", 9, *(() if "--method" in arguments else QUICK)) == 2
    assert says in capsys.readouterr().err
    assert sorted(picture.iterdir()) == before
