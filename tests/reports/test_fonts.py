"""Signs that the figures' own font lacks: another font that has them, or a word that there is none."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import font_manager
from matplotlib.figure import Figure

from gbnbench.reports import fonts, style
from gbnbench.reports.captions import shown
from gbnbench.reports.comparison.figure_files import pdf, png

SIGNS = "点集\uac00"


@pytest.fixture
def no_other_fonts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only our own font is installed."""
    own = [entry for entry in font_manager.fontManager.ttflist if entry.name == fonts.OWN]
    monkeypatch.setattr(font_manager.fontManager, "ttflist", own)
    monkeypatch.setattr(fonts, "_find_new_fonts", lambda: None)
    monkeypatch.setattr(fonts, "_fallbacks", [])
    monkeypatch.setattr(fonts, "_without", {})
    fonts._family_with.cache_clear()
    yield
    fonts._family_with.cache_clear()


@pytest.fixture
def font_of_signs(no_other_fonts: None, tmp_path: Path) -> str:
    """A font that has black squares for these signs alone."""
    builder = pytest.importorskip("fontTools.fontBuilder").FontBuilder(1000, isTTF=True)
    pen = pytest.importorskip("fontTools.pens.ttGlyphPen").TTGlyphPen(None)
    for at, corner in enumerate([(0, 0), (0, 800), (800, 800), (800, 0)]):
        (pen.lineTo if at else pen.moveTo)(corner)
    pen.closePath()
    square = pen.glyph()
    names = [".notdef", *(f"sign{k}" for k in range(len(SIGNS)))]
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap(dict(zip(map(ord, SIGNS), names[1:], strict=True)))
    builder.setupGlyf(dict.fromkeys(names, square))
    builder.setupHorizontalMetrics(dict.fromkeys(names, (1000, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Signs CJK", "styleName": "Regular"})
    builder.setupOS2(sTypoAscender=800, usWinAscent=800, usWinDescent=200)
    builder.setupPost()
    path = tmp_path / "signs.ttf"
    builder.save(path)
    font_manager.fontManager.addfont(path)
    return "Signs CJK"


@style.styled
def figure(text: str) -> Figure:
    drawn = Figure(figsize=(1, 1))
    drawn.text(0.1, 0.4, shown(text))
    return drawn


def ink(content: bytes) -> int:
    """Dark pixels of a picture."""
    import io

    from matplotlib.image import imread

    return int(np.count_nonzero(imread(io.BytesIO(content))[..., 0] < 0.5))


def test_a_font_that_has_the_signs_draws_them(font_of_signs: str) -> None:
    drawn = figure("点")
    assert fonts.families() == [fonts.OWN, font_of_signs]
    assert ink(png(drawn)) > 50  # a filled square of 8 points; the white square of a lack is an outline
    assert b"/XObject" in pdf(drawn)  # as which glyphs beyond a font's first 256 stand in a PDF
    assert fonts.shortage() == ""
    assert mpl.rcParams["font.family"] != fonts.families()  # the user's settings are left as they were


def test_without_such_a_font_a_box_stands_and_the_lack_is_said_once(no_other_fonts: None) -> None:
    assert shown("点 gbn 点集") == "□ gbn □□"
    assert fonts.shortage() == (
        "no installed font has 点集: pictures show a box for each; install one, such as Noto Sans CJK"
    )
    assert fonts.shortage() == ""


def test_pictures_without_such_signs_are_the_same_beside_them(font_of_signs: str) -> None:
    before = png(figure("gbn"))
    figure(SIGNS)
    assert png(figure("gbn")) == before


def test_a_title_that_is_older_than_its_font_is_drawn_by_it(font_of_signs: str) -> None:
    @style.styled
    def titled() -> Figure:
        drawn = Figure(figsize=(1, 1))
        drawn.add_subplot().set_title(shown("点"))  # the axes make their title before its text is known
        return drawn

    assert titled().axes[0].title.get_fontfamily() == [fonts.OWN, font_of_signs]
