"""Stipplings as encapsulated PostScript: one line a dot, later inks over earlier ones."""

from __future__ import annotations

import math

from gbnbench.core.readable_text import in_one_line
from gbnbench.reports.stippling.page import DotLayer, Page, rgb_of
from gbnbench.reports.stippling.pdf import POINTS_A_MM
from gbnbench.reports.stippling.svg import short, short_size
from gbnbench.reports.stippling.tiles import drawn_layers

HEAD = """\
%!PS-Adobe-3.0 EPSF-3.0
%%Creator: gbnbench
%%Title: {title}
%%BoundingBox: 0 0 {columns} {rows}
%%HiResBoundingBox: 0 0 {width:.4f} {height:.4f}
%%LanguageLevel: 2
%%EndComments
% {text}
/d {{ 0 360 arc fill }} bind def
gsave
{scale:.8f} dup neg scale 0 {down} translate
"""
LONGEST = 200  # signs of a comment; a line has 255 at most


def eps(page: Page) -> bytes:
    """Write a page as EPS.

    Parameters
    ----------
    page : Page
        The page.

    Returns
    -------
    bytes
        ASCII.
    """
    width, height = page.width * POINTS_A_MM, page.height * POINTS_A_MM
    head = HEAD.format(
        title=_comment(page.title),
        text=_comment(page.text),
        columns=math.ceil(width),
        rows=math.ceil(height),
        width=width,
        height=height,
        scale=POINTS_A_MM,
        down=short(-page.height),
    )
    drawn = "".join(map(_layer, drawn_layers(page)))
    return f"{head}{_clip(page)}{_paper(page)}{drawn}grestore\nshowpage\n%%EOF\n".encode("ascii")


def _clip(page: Page) -> str:
    """Cut off what hangs over the borders of a tile."""
    return f"0 0 {short(page.width)} {short(page.height)} rectclip\n" if page.toroidal else ""


def _paper(page: Page) -> str:
    if page.white:
        return ""
    red, green, blue = rgb_of(page.paper)
    return (
        f"{red:.4f} {green:.4f} {blue:.4f} setrgbcolor\n"
        f"0 0 {short(page.width)} {short(page.height)} rectfill\n"
    )


def _layer(layer: DotLayer) -> str:
    red, green, blue = layer.rgb
    dots = "".join(
        f"{short(x)} {short(y)} {short_size(r)} d\n"
        for (x, y), r in zip(layer.centres.tolist(), layer.radii.tolist(), strict=True)
    )
    return f"% {_comment(layer.name)}\n{red:.4f} {green:.4f} {blue:.4f} setrgbcolor\n{dots}"


def _comment(text: str) -> str:
    return in_one_line(text).encode("ascii", "replace").decode()[:LONGEST]
