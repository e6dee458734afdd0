"""Pictures of toroidal stipplings tile: what hangs over one border is drawn at the opposite one too."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

import gbnbench
from gbnbench.api.page_style import PageStyle, page_of
from gbnbench.api.stippled_frames import forming, growing
from gbnbench.api.stippled_page import write_stippling
from gbnbench.cli import run
from gbnbench.reports.stippling.gcode import GcodeTemplate, gcode
from gbnbench.reports.stippling.page import DotLayer, Page
from gbnbench.reports.stippling.png import pixels
from gbnbench.reports.stippling.tiles import drawn_layers

SVG = "{http://www.w3.org/2000/svg}"
# four dots on a page of 40 x 30 mm: inside, over the left border, over the lower one, over a corner
CENTRES = np.array([[20.0, 15.0], [1.0, 12.0], [30.0, 29.5], [39.0, 0.5]])
RADII = np.array([3.0, 2.0, 1.0, 2.5])
TILE = Page(40, 30, (DotLayer("black", "#000000", CENTRES, RADII),), toroidal=True)


def laid_2_by_2(page: Page) -> Page:
    """Lay four pages side by side by hand, each dot four times; the dots around them are left out."""
    [layer] = page.layers
    moves = [(x, y) for x in (-1, 0, 1, 2) for y in (-1, 0, 1, 2)]
    centres = np.concatenate([layer.centres + np.array(move) * (page.width, page.height) for move in moves])
    many = replace(layer, centres=centres, radii=np.tile(layer.radii, len(moves)))
    return Page(2 * page.width, 2 * page.height, (many,))


def test_a_png_laid_2_by_2_has_no_seam():
    tile = pixels(TILE, 254)
    whole = pixels(laid_2_by_2(TILE), 254)
    assert whole.shape == (600, 800)
    seam = np.abs(np.tile(tile, (2, 2)).astype(int) - whole)
    assert seam.max() <= 3  # levels of 255, where the renderer rounds the rims of discs
    cut = pixels(replace(TILE, toroidal=False), 254)
    assert np.abs(np.tile(cut, (2, 2)).astype(int) - whole).max() == 255


def test_dark_is_what_the_dots_cover():
    """None overlap, so that their areas add up: to what they are where no dot crosses a border."""
    dark = 1 - pixels(TILE, 254).mean() / 255
    assert dark == pytest.approx(np.pi * (RADII**2).sum() / (40 * 30), rel=4e-3)  # discs are drawn by cubics
    moved = replace(TILE.layers[0], centres=(CENTRES + np.array([5, 8])) % (40, 30))
    whole = 1 - pixels(Page(40, 30, (moved,)), 254).mean() / 255
    assert dark == pytest.approx(whole, rel=1e-3)
    assert 1 - pixels(replace(TILE, toroidal=False), 254).mean() / 255 < 0.85 * whole


def test_a_corner_has_four_copies_and_a_dot_inside_one():
    [layer] = drawn_layers(TILE)
    assert np.array_equal(layer.centres[:4], CENTRES)  # the dots themselves, in their order
    copies = {*map(tuple, layer.centres[4:].tolist())}
    assert copies == {(41, 12), (30, -0.5), (-1, 0.5), (39, 30.5), (-1, 30.5)}
    assert sorted(layer.radii[4:]) == [1, 2, 2.5, 2.5, 2.5]
    assert drawn_layers(replace(TILE, toroidal=False)) is TILE.layers


def test_a_dot_wider_than_the_page_covers_all_of_it():
    wide = DotLayer("black", "#000000", np.array([[3.0, 1.0]]), np.array([12.0]))
    page = Page(40, 5, (wide,), toroidal=True)
    assert np.abs(np.tile(pixels(page, 254), (2, 2)).astype(int) - pixels(laid_2_by_8(page), 254)).max() <= 3


def laid_2_by_8(page: Page) -> Page:
    """Lay two pages side by side and two above one another, with eight more on each side."""
    [layer] = page.layers
    moves = [(x, y) for x in range(-8, 10) for y in range(-8, 10)]
    centres = np.concatenate([layer.centres + np.array(move) * (page.width, page.height) for move in moves])
    many = replace(layer, centres=centres, radii=np.tile(layer.radii, len(moves)))
    return Page(2 * page.width, 2 * page.height, (many,))


def test_within_margins_the_picture_is_the_tile():
    moved = replace(TILE.layers[0], centres=CENTRES + 5)
    page = Page(50, 40, (moved,), margin=5, toroidal=True)
    inner = pixels(page, 254)[50:-50, 50:-50]
    assert np.abs(inner.astype(int) - pixels(TILE, 254)).max() <= 3


@pytest.fixture
def grey(here: Path) -> Path:
    """A flat grey of 20 x 20 pixels as g.png: a fifth is dark."""
    Pillow.fromarray(np.full((20, 20), 204, np.uint8)).save("g.png")
    return here


def circles_of_svg() -> np.ndarray:
    root = ElementTree.parse("o.svg").getroot()  # noqa: S314 - it is our own
    assert [g.get("clip-path") for g in root.findall(f"{SVG}g")] == ["url(#page)"]
    rect = root.find(f"{SVG}clipPath[@id='page']/{SVG}rect")
    assert (rect.get("width"), rect.get("height")) == ("160", "160")
    found = root.iter(f"{SVG}circle")
    return np.array([[float(c.get(key)) for key in ("cx", "cy", "r")] for c in found])


def circles_of_eps() -> np.ndarray:
    text = Path("o.eps").read_text()
    assert "\n0 0 160 160 rectclip\n" in text
    return np.array(re.findall(r"^(\S+) (\S+) (\S+) d$", text, re.MULTILINE), float)


def circles_of_pdf() -> np.ndarray:
    stream = re.search(rb"/FlateDecode >>\nstream\n(.*?)\nendstream", Path("o.pdf").read_bytes(), re.DOTALL)
    text = zlib.decompress(stream[1]).decode()
    assert "\n0 0 160 160 re W n\n" in text
    return np.array(re.findall(r"^q (\S+) 0 0 \S+ (\S+) (\S+) cm /D Do Q$", text, re.M), float)[:, [1, 2, 0]]


def test_every_picture_has_the_copies_and_tells_n(grey, capsys):
    options = ["-n", "60", "--toroidal", "--method", "gbn[gradients=20]", "--quiet"]
    for suffix in ("svg", "pdf", "eps", "png", "gcode", "csv"):
        assert run(["stipple", "g.png", "-o", f"o.{suffix}", *options]) == 0
        assert re.search(rf"wrote o.{suffix}: 60 dots of black[,\n]", capsys.readouterr().out)
    circles = circles_of_svg()
    x, y, r = circles.T
    assert len(circles) > 60
    assert np.all((x > -r) & (x < 160 + r) & (y > -r) & (y < 160 + r))
    inside = (np.minimum(x, y) >= 0) & (np.maximum(x, y) <= 160)
    assert inside.sum() == 60
    left = circles[(x < r) & (x >= 0)] + np.array([160, 0, 0])
    assert len(left) >= 2
    for other in (circles, circles_of_eps(), circles_of_pdf()):
        assert other == pytest.approx(circles, abs=1e-4)
        assert np.abs(left[:, None] - other[None]).max(axis=2).min(axis=1).max() < 3e-4  # each is there
    assert Path("o.gcode").read_text().count("G1 Z0") == 60
    assert len(Path("o.csv").read_text().splitlines()) == 61
    with Pillow.open("o.png") as drawn:
        assert 1 - np.asarray(drawn).mean() / 255 == pytest.approx(0.2, rel=2e-3)


def test_moving_pictures_tile_and_pages_have_no_margin():
    made = gbnbench.stipple(np.full((20, 20), 0.8), 60, method="gbn[gradients=20]", toroidal=True)
    page = page_of({"black": made}, PageStyle(80))
    assert (page.margin, page.toroidal, len(page.layers[0].radii)) == (0, True, 60)
    assert len(list(gcode(page, GcodeTemplate()).splitlines())) == len(b"1234") + 2 + 3 * 60 + 3
    [still] = forming(page, [{"black": made.pixels}], 4.0)
    *_, grown = growing(page, 3)
    for frame in (still, grown):
        assert np.array_equal(pixels(frame, 100), pixels(page, 100))
        assert 1 - pixels(frame, 100).mean() / 255 == pytest.approx(0.2, rel=1e-2)


def test_a_box_is_drawn_as_before(here):
    made = gbnbench.stipple(np.full((20, 20), 0.8), 60, method="gbn[gradients=20]")
    write_stippling(Path("o.svg"), {"black": made})
    text = Path("o.svg").read_text()
    assert text.count("<circle") == 60
    assert "clip" not in text
