"""Stipplings as SVG: millimetres, a layer an ink as Inkscape and vpype understand them, one circle a dot."""

from __future__ import annotations

import math
from xml.sax.saxutils import escape, quoteattr

from gbnbench.core.readable_text import in_one_line
from gbnbench.reports.stippling.page import DIGITS, DotLayer, Page
from gbnbench.reports.stippling.tiles import drawn_layers

HEAD = """\
<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
     xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
     version="1.1" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"{shown}>
<title>{title}</title>
<desc>{text}</desc>
"""
PAPER = """\
<sodipodi:namedview pagecolor="{colour}" inkscape:pageopacity="1"/>
"""
LAYER = """\
<g inkscape:groupmode="layer" id="layer{number}" inkscape:label={name} fill="{colour}" \
stroke="none"{look}>
"""
CLIP = """\
<clipPath id="page"><rect width="{width}" height="{height}"/></clipPath>
"""
CLIPPED = ' clip-path="url(#page)"'
LEAST_DIGITS = 3  # of the radius of a dot, whatever its size
MULTIPLY = ' style="mix-blend-mode:multiply"'


def svg(page: Page) -> bytes:
    """Write a page as SVG.

    Parameters
    ----------
    page : Page
        The page.

    Returns
    -------
    bytes
        UTF-8. One unit of the picture is a millimetre. No background is drawn, which a plotter would draw:
        paper that is not white is told to browsers as a style and to Inkscape as the colour of the page.
    """
    head = HEAD.format(
        width=short(page.width), height=short(page.height), title=_text(page.title), text=_text(page.text),
        shown="" if page.white else f' style="background:{page.paper}"',
    )  # fmt: skip
    paper = "" if page.white else PAPER.format(colour=page.paper)
    if page.toroidal:
        paper += CLIP.format(width=short(page.width), height=short(page.height))
    look = (CLIPPED if page.toroidal else "") + (MULTIPLY if page.white else "")
    layers = [_layer(number, layer, look) for number, layer in enumerate(drawn_layers(page), 1)]
    return f"{head}{paper}{''.join(layers)}</svg>\n".encode()


def short(value: float) -> str:
    """Write millimetres to a tenth of a micrometre, without zeros at the end.

    Examples
    --------
    >>> short(0.30000000004), short(12.0), short(-0.00001)
    ('0.3', '12', '0')
    """
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def short_size(value: float) -> str:
    """Write a size as ``short`` does, but with three digits at least, so that no dot vanishes.

    Examples
    --------
    >>> short_size(0.25), short_size(0.00123456), short_size(0.00005), short_size(0.0)
    ('0.25', '0.00123', '0.00005', '0')
    """
    if value <= 0:
        return short(value)
    decimals = max(DIGITS, LEAST_DIGITS - 1 - math.floor(math.log10(value)))
    return f"{value:.{decimals}f}".rstrip("0").rstrip(".")


def _layer(number: int, layer: DotLayer, look: str) -> str:
    name = quoteattr(in_one_line(layer.name))
    begin = LAYER.format(number=number, name=name, colour=layer.colour, look=look)
    dots = "".join(
        f'<circle cx="{short(x)}" cy="{short(y)}" r="{short_size(r)}"/>\n'
        for (x, y), r in zip(layer.centres.tolist(), layer.radii.tolist(), strict=True)
    )
    return f"{begin}{dots}</g>\n"


def _text(text: str) -> str:
    return escape(in_one_line(text))
