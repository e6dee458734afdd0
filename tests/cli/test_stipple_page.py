"""Pages of ``gbnbench stipple``: margins and colours, as a browser and a PDF reader show them."""

from __future__ import annotations

import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

from gbnbench.cli import run

SVG = "{http://www.w3.org/2000/svg}"
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


def drawing(name: str) -> ElementTree.Element:
    return ElementTree.parse(name).getroot()  # noqa: S314 - it is our own


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("chromium") is None, reason="no chromium on PATH to open the drawing with")
@pytest.mark.parametrize(
    "colours", [(), ("--invert", "--ink", "gold", "--paper", "#024"), ("--toroidal", "--colour", "cmyk")]
)
def test_chromium_shows_an_svg_as_the_png_is(picture, colours):
    for suffix, dpi in (("svg", ()), ("png", ("--dpi", 127))):  # 800 pixels
        assert command("x.png", "-n", 200, "-o", f"o.{suffix}", *dpi, *colours, *QUICK) == 0
    image = f'<img src="{(picture / "o.svg").as_uri()}" width="800">'
    Path("page.html").write_text(f'<body style="margin:0">{image}</body>')
    chromium = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]
    chromium += ["--window-size=800,620", f"--user-data-dir={picture / 'profile'}"]
    address = (picture / "page.html").as_uri()
    subprocess.run(
        [*chromium, f"--screenshot={picture / 'shot.png'}", address],
        check=True,
        capture_output=True,
        timeout=120,
    )
    with Pillow.open("shot.png") as shot, Pillow.open("o.png") as drawn:
        shown = np.asarray(shot.convert("RGB"), float)[: drawn.height, :800]
        expected = np.asarray(drawn.convert("RGB"), float)
    assert np.abs(shown - expected).mean() < 2  # of 255: both smooth the rims of dots


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("pdftoppm") is None, reason="no pdftoppm on PATH to open the page with")
@pytest.mark.parametrize(
    "colours",
    [
        (),
        ("--invert",),
        ("--colour", "cmyk"),
        ("--invert", "--ink", "gold", "--paper", "#024"),
        ("--toroidal", "--colour", "cmyk"),
    ],
)
def test_a_pdf_reader_shows_the_page_as_the_png_is(picture, colours):
    for suffix, dpi in (("pdf", ()), ("png", ("--dpi", 127))):
        assert command("x.png", "-n", 200, "-o", f"o.{suffix}", *dpi, *colours, *QUICK) == 0
    reader = ["pdftoppm", "-r", "127", "-png", "-singlefile", "o.pdf", "shot"]
    subprocess.run(reader, check=True, capture_output=True, timeout=60)
    with Pillow.open("shot.png") as shot, Pillow.open("o.png") as drawn:
        rows = min(shot.height, drawn.height)  # a page's last row of pixels may be a part of one
        shown, expected = (np.asarray(one.convert("RGB"), float)[:rows, :800] for one in (shot, drawn))
    assert np.abs(shown - expected).mean() < 3  # of 255: both smooth the rims of dots


def test_no_dot_hangs_over_the_border(picture):
    Pillow.fromarray(np.zeros((30, 40), np.uint8)).save("black.png")
    for name, options in (("own", ()), ("told", ("--margin-mm", 12.5)), ("pen", ("--dot-mm", 3))):
        assert command("black.png", "-n", 300, "-o", f"{name}.svg", *options, *QUICK) == 0
        root = drawing(f"{name}.svg")
        width, height = (float(side) for side in root.get("viewBox").split()[2:])
        circles = root.iter(f"{SVG}circle")
        x, y, r = np.array([[float(c.get(key)) for key in ("cx", "cy", "r")] for c in circles]).T
        margin = {"own": r.max(), "told": 12.5, "pen": 1.5}[name]
        assert width == 160
        assert (height - 2 * margin) / (160 - 2 * margin) == pytest.approx(30 / 40, abs=1e-4)
        assert min(x.min(), y.min(), width - x.max(), height - y.max()) >= margin - 1e-4
        assert np.ptp(x) > 0.9 * (width - 2 * margin)
    assert command("black.png", "-n", 300, "-o", "pen.gcode", "--margin-mm", 12.5, *QUICK) == 0
    moves = re.findall(r"^G0 X(\S+) Y(\S+)$", Path("pen.gcode").read_text(), re.MULTILINE)[:300]
    places = np.array(moves, float)
    assert (places.min(axis=0) >= 12.5).all()
    assert (places.max(axis=0) <= np.array([160, 135 * 3 / 4 + 25]) - 12.5).all()


def test_inverted_dots_are_white_on_black(picture, capsys):
    x = np.asarray(Pillow.open("x.png"), float)
    for name, options in (("white", ()), ("gold", ("--ink", "gold", "--paper", "#024"))):
        for suffix in ("png", "svg", "pdf", "eps", "gcode"):
            no_paper = options[:2] if suffix == "gcode" else options
            assert command("x.png", "-n", 900, "--invert", "-o", f"{name}.{suffix}", *no_paper, *QUICK) == 0
    assert "negative" not in capsys.readouterr().err
    with Pillow.open("white.png") as drawn:
        assert drawn.mode == "L"
        tones = np.asarray(drawn.resize((4, 3), Pillow.Resampling.BOX), float)
    expected = np.asarray(Pillow.fromarray(x.astype(np.uint8)).resize((4, 3), Pillow.Resampling.BOX), float)
    assert np.corrcoef(tones.ravel(), expected.ravel())[0, 1] > 0.97
    assert tones[:, 0].max() < 60
    assert tones[:, 3].min() > 150  # where dots would cover all if none overlapped
    with Pillow.open("gold.png") as drawn:
        seen = {colour for _, colour in drawn.getcolors(1 << 20)}
    assert {(255, 215, 0), (0, 34, 68)} <= seen
    root = drawing("gold.svg")
    assert [(g.get("fill"), g.get("style")) for g in root.findall(f"{SVG}g")] == [("#ffd700", None)]
    assert root.get("style") == "background:#002244"
    assert [child.get("pagecolor") for child in root if child.tag.startswith("{http://sodi")] == ["#002244"]
    assert "rectfill" in Path("gold.eps").read_text()
    assert "; dots of #ffd700: 900\n" in Path("gold.gcode").read_text()
    assert "; dots of white: 900\n" in Path("white.gcode").read_text()


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("--paper", "black"), "dots are lighter than the paper and dense where the image is dark; add"),
        (("--invert", "--paper", "white"), "darker than the paper and dense where the image is light; leave"),
    ],
)
def test_a_negative_is_told(picture, capsys, options, says):
    assert command("x.png", "-n", 50, "-o", "o.png", *options, *QUICK) == 0
    assert says in capsys.readouterr().err


@pytest.mark.parametrize("diameter", [2e-5, 3e-9])
def test_the_smallest_dots_do_not_vanish(picture, diameter):
    for suffix in ("svg", "pdf", "eps"):
        assert command("x.png", "-n", 20, "-o", f"o.{suffix}", "--dot-mm", f"{diameter}", *QUICK) == 0
    stream = re.search(rb"/FlateDecode >>\nstream\n(.*?)\nendstream", Path("o.pdf").read_bytes(), re.DOTALL)
    found = {
        "svg": [circle.get("r") for circle in drawing("o.svg").iter(f"{SVG}circle")],
        "eps": re.findall(r"^\S+ \S+ (\S+) d$", Path("o.eps").read_text(), re.MULTILINE),
        "pdf": re.findall(r"^q (\S+) 0 0 ", zlib.decompress(stream[1]).decode(), re.MULTILINE),
    }
    for radii in found.values():
        assert len(radii) == 20
        assert [float(radius) for radius in radii] == pytest.approx([diameter / 2] * 20, rel=5e-3)
