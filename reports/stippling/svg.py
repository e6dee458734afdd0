"""Stipplings as SVG: millimetres, a layer an ink as Inkscape and vpype understand them, one circle a dot."""

from __future__ import annotations

from xml.sax.saxutils import escape, quoteattr

from gbnbench.core.readable_text import in_one_line
from gbnbench.reports.stippling.page import DIGITS, DotLayer, Page

HEAD = """\
<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
     version="1.1" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">
<title>{title}</title>
<desc>{text}</desc>
"""
LAYER = """\
<g inkscape:groupmode="layer" id="layer{number}" inkscape:label={name} fill="{colour}" \
stroke="none" style="mix-blend-mode:multiply">
"""


def svg(page: Page) -> bytes:
    """Write a page as SVG.

    Parameters
    ----------
    page : Page
        The page.

    Returns
    -------
    bytes
        UTF-8. One unit of the picture is a millimetre; no background is drawn, which a plotter would draw.
    """
    head = HEAD.format(
        width=short(page.width), height=short(page.height), title=_text(page.title), text=_text(page.text)
    )
    layers = [_layer(number, layer) for number, layer in enumerate(page.layers, 1)]
    return f"{head}{''.join(layers)}</svg>\n".encode()


def short(value: float) -> str:
    """Write millimetres to a tenth of a micrometre, without zeros at the end.

    Examples
    --------
    >>> short(0.30000000004), short(12.0), short(-0.00001)
    ('0.3', '12', '0')
    """
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _layer(number: int, layer: DotLayer) -> str:
    begin = LAYER.format(number=number, name=quoteattr(_text(layer.name)), colour=layer.colour)
    dots = "".join(
        f'<circle cx="{short(x)}" cy="{short(y)}" r="{short(r)}"/>\n'
        for (x, y), r in zip(layer.centres.tolist(), layer.radii.tolist(), strict=True)
    )
    return f"{begin}{dots}</g>\n"


def _text(text: str) -> str:
    return escape(in_one_line(text))
