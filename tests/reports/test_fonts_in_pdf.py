"""Fonts within a PDF: the glyphs that are drawn, without tables of layout; other files keep theirs."""

from __future__ import annotations

import io
import re
import zlib

import pytest
from fontTools import subset
from fontTools.ttLib import TTFont
from matplotlib.figure import Figure
from matplotlib.font_manager import findfont

from gbnbench.reports import fonts_in_pdf
from gbnbench.reports.comparison.figure_files import pdf
from gbnbench.reports.fonts import OWN
from gbnbench.reports.fonts_in_pdf import LAYOUT_TABLES, SIGNS, lean_fonts


def fonts_of(content: bytes) -> list[TTFont]:
    streams = re.findall(rb"/Length1 .*?stream\r?\n(.*?)\r?\nendstream", content, re.DOTALL)
    return [TTFont(io.BytesIO(zlib.decompress(stream))) for stream in streams]


def test_a_pdf_holds_outlines_of_its_signs_alone() -> None:
    figure = Figure()
    figure.text(0.1, 0.5, "AV")
    figure.text(0.1, 0.7, "x", weight="bold")
    fonts = fonts_of(pdf(figure))
    assert len(fonts) == 2
    glyphs = [font["glyf"] for font in fonts]
    for font in fonts:
        assert not set(LAYOUT_TABLES) & set(font.keys())
    whole = TTFont(findfont(OWN), fontNumber=0)["glyf"]
    plain = next(glyf for glyf in glyphs if "A" in glyf)
    bold = next(glyf for glyf in glyphs if "A" not in glyf)
    assert plain["A"].getCoordinates(plain)[0] == whole["A"].getCoordinates(whole)[0]
    assert bold["x"].getCoordinates(bold)[0] != whole["x"].getCoordinates(whole)[0]
    assert max(map(len, glyphs)) < 20  # of some six thousand


def test_fonts_are_loaded_whole_again_afterwards() -> None:
    before = subset.load_font
    with lean_fonts(), subset.load_font(findfont(OWN), subset.Options()) as lean:
        assert "GPOS" not in lean
    assert subset.load_font is before
    with subset.load_font(findfont(OWN), subset.Options()) as whole:
        assert "GPOS" in whole


@pytest.mark.parametrize("text", ["Noise floor, $10^{-3}$, 点ł", f"{SIGNS[:40]}·−ﬁ"])
def test_a_part_of_a_font_gives_the_file_that_the_whole_gives(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    figure = Figure()
    figure.text(0.1, 0.5, text)
    figure.text(0.1, 0.7, "x", weight="bold")
    from_part = pdf(figure)
    monkeypatch.setattr(fonts_in_pdf, "SIGNS", "")
    fonts_in_pdf._part.cache_clear()
    assert from_part == pdf(figure)
    fonts_in_pdf._part.cache_clear()
