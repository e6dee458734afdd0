"""Formulas as drawings in the page, made by ziamath: the same in every browser, with nothing to load."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

import ziafont
import ziamath
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

TALLEST = 12.0  # em: a fence that grew without end is taller
SIZE = 16.0  # of a letter m, in the units of a drawing

ziafont.config.svg2 = False  # shapes in full: marks shared between the drawings of a page would clash


def drawing(latex: str, inline: bool) -> str:
    """SVG of a formula, in the letters' own size and colour; read aloud as LaTeX."""
    formula = ziamath.Latex(latex, size=SIZE, inline=inline, color="currentColor")
    svg = formula.svgxml()
    _, _, width, height = map(float, svg.attrib["viewBox"].split())
    if height > TALLEST * SIZE:
        raise ExtensionError(
            f"this formula came out {height / SIZE:.0f} em high; write it otherwise: {latex}"
        )
    down = formula.getyofst() / SIZE
    svg.set("style", f"width:{width / SIZE:.3f}em;height:{height / SIZE:.3f}em;vertical-align:{down:.3f}em")
    svg.set("role", "img")
    svg.set("aria-label", latex)
    for name in ("width", "height"):
        del svg.attrib[name]
    return ElementTree.tostring(svg, encoding="unicode")


def _inline(translator: Any, node: nodes.math) -> None:
    translator.body.append(f'<span class="math">{drawing(node.astext(), inline=True)}</span>')
    raise nodes.SkipNode


def _block(translator: Any, node: nodes.math_block) -> None:
    translator.body.append(f'<div class="math">{drawing(node.astext(), inline=False)}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the renderer; what cannot be set stops the build."""
    app.add_html_math_renderer("drawings", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
