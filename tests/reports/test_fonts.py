"""Labels in Chinese, Japanese and Korean: drawn with an installed font that has them, or said not to be."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen

from gbnbench.core.text_table import aligned, display_width
from gbnbench.reports import fonts
from gbnbench.reports.captions import lacking_signs, shown

SCRIPT = """
import json, sys
from gbnbench.reports import captions, fonts
from gbnbench.reports.comparison.figure_files import pdf, png
from gbnbench.reports.style import styled
from matplotlib.figure import Figure

@styled
def drawn(text):
    figure = Figure(figsize=(2, 1))
    figure.text(0.1, 0.5, captions.shown(text), weight="bold")
    return figure

pictures = [png(drawn(text)) for text in ("中文", "中", "한")]
text = captions.shown("中文 한")
print(json.dumps([fonts.families(), text, captions.lacking_signs(["中文", "한"]), len(set(pictures))]))
assert pdf(drawn("中文"))
"""


def small_font(path: Path, family: str, signs: str) -> None:
    """Make a font in which every sign is a filled square, as tall as its place among them."""
    names = [".notdef", *(f"u{ord(sign):04X}" for sign in signs)]
    glyphs = {}
    for place, name in enumerate(names):
        pen = TTGlyphPen(None)
        pen.moveTo((50, 0))
        for corner in ((50, 300 + 200 * place), (900, 300 + 200 * place), (900, 0)):
            pen.lineTo(corner)
        pen.closePath()
        glyphs[name] = pen.glyph()
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord(sign): f"u{ord(sign):04X}" for sign in signs})
    builder.setupGlyf(glyphs)
    builder.setupHorizontalMetrics(dict.fromkeys(names, (1000, 50)))
    builder.setupHorizontalHeader(ascent=900, descent=-100)
    builder.setupNameTable({"familyName": family, "styleName": "Regular", "fullName": family})
    builder.setupOS2()
    builder.setupPost()
    path.parent.mkdir(parents=True)
    builder.save(path)


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="folders of fonts as Linux has them")
def test_an_installed_font_draws_the_signs_that_it_has(tmp_path: Path) -> None:
    small_font(tmp_path / "fonts" / "small.ttf", "Noto Sans SC", "中文")
    folders = {"XDG_DATA_HOME": str(tmp_path), "MPLCONFIGDIR": str(tmp_path / "matplotlib")}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=False, timeout=120,
        env={**os.environ, **folders, "PYTHONIOENCODING": "utf-8"}, encoding="utf-8",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    families, text, lacking, different = json.loads(done.stdout)
    assert families[0] == "DejaVu Sans"
    assert "Noto Sans SC" in families
    assert different == 3
    if len(families) == 2:  # nothing on this machine has Korean
        assert text == "中文 □"
        assert lacking.startswith("no installed font has 한: pictures show boxes instead")


def test_signs_that_no_font_has_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gbnbench.reports.captions.has_sign", lambda sign: sign < "\u3000")
    assert shown("蓝 x") == "□ x"
    assert lacking_signs(["蓝噪", "gbn", "蓝"]).startswith("no installed font has 蓝噪: ")
    assert fonts.families()[0] == fonts.MAIN


def test_wide_signs_take_two_columns() -> None:
    assert [display_width(text) for text in ("青い雑音", "한국어", "e\u0301", "gbn")] == [8, 6, 1, 3]
    lines = list(aligned(("source", "n"), [("蓝噪声采样", 1), ("gbn", 20)]))
    assert {display_width(line) for line in lines} == {14}
    assert len(shown("蓝" * 40, 20)) == 10
