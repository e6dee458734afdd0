"""Stipplings as PDF 1.5: a layer an ink as optional content, one circle drawn again for every dot."""

from __future__ import annotations

import zlib

from gbnbench.core.readable_text import in_one_line
from gbnbench.reports.stippling.page import DotLayer, Page, rgb_of
from gbnbench.reports.stippling.svg import short, short_size
from gbnbench.reports.stippling.tiles import drawn_layers

POINTS_A_MM = 72 / 25.4
K = 0.5522847498  # control points of a quarter circle by a cubic, over the radius: off by 0.03% at most
CIRCLE = (
    f"1 0 m 1 {K} {K} 1 0 1 c -{K} 1 -1 {K} -1 0 c -1 -{K} -{K} -1 0 -1 c {K} -1 1 -{K} 1 0 c f"
)  # fmt: skip


def pdf(page: Page) -> bytes:
    """Write a page as PDF.

    Parameters
    ----------
    page : Page
        The page.

    Returns
    -------
    bytes
    """
    layers = range(len(page.layers))
    width, height = page.width * POINTS_A_MM, page.height * POINTS_A_MM
    begin = f"{POINTS_A_MM:.8f} 0 0 {-POINTS_A_MM:.8f} 0 {height:.5f} cm\n{_clip(page)}{_paper(page)}"
    drawn = begin + "".join(_layer(k, layer) for k, layer in enumerate(drawn_layers(page)))
    groups = " ".join(f"{8 + k} 0 R" for k in layers)
    named = " ".join(f"/L{k} {8 + k} 0 R" for k in layers)
    objects: list[str | bytes] = [
        f"<< /Type /Catalog /Pages 2 0 R /OCProperties << /OCGs [{groups}] /D << /Order [{groups}] >> >> >>",
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        f"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width:.5f} {height:.5f}] /Contents 4 0 R "
        "/Group << /S /Transparency /CS /DeviceRGB >> "
        "/Resources << /XObject << /D 5 0 R >> /ExtGState << /Multiply 6 0 R >> "
        f"/Properties << {named} >> >> >>",
        _stream(zlib.compress(drawn.encode("ascii")), "/Filter /FlateDecode"),
        _stream(CIRCLE.encode("ascii"), "/Type /XObject /Subtype /Form /BBox [-1 -1 1 1] /Resources << >>"),
        "<< /Type /ExtGState /BM /Multiply >>",
        f"<< /Title {_string(page.title)} /Subject {_string(page.text)} /Producer (gbnbench) >>",
        *(f"<< /Type /OCG /Name {_string(layer.name)} >>" for layer in page.layers),
    ]
    out = bytearray(b"%PDF-1.5\n%\xe2\xe3\xcf\xd3\n")
    places = []
    for number, content in enumerate(objects, 1):
        places.append(len(out))
        data = content if isinstance(content, bytes) else content.encode("ascii")
        out += b"%d 0 obj\n%b\nendobj\n" % (number, data)
    table = "".join(f"{place:010d} 00000 n \n" for place in places)
    size = len(objects) + 1
    tail = (
        f"xref\n0 {size}\n0000000000 65535 f \n{table}"
        f"trailer\n<< /Size {size} /Root 1 0 R /Info 7 0 R >>\nstartxref\n{len(out)}\n%%EOF\n"
    )
    return bytes(out + tail.encode("ascii"))


def _clip(page: Page) -> str:
    """Cut off what hangs over the borders of a tile."""
    return f"0 0 {short(page.width)} {short(page.height)} re W n\n" if page.toroidal else ""


def _paper(page: Page) -> str:
    """Let inks multiply on white paper, and fill the page with the colour of any other."""
    if page.white:
        return "/Multiply gs\n"
    red, green, blue = rgb_of(page.paper)
    return f"{red:.4f} {green:.4f} {blue:.4f} rg\n0 0 {short(page.width)} {short(page.height)} re f\n"


def _layer(k: int, layer: DotLayer) -> str:
    red, green, blue = layer.rgb
    dots = "".join(
        f"q {short_size(r)} 0 0 {short_size(r)} {short(x)} {short(y)} cm /D Do Q\n"
        for (x, y), r in zip(layer.centres.tolist(), layer.radii.tolist(), strict=True)
    )
    return f"/OC /L{k} BDC\n{red:.4f} {green:.4f} {blue:.4f} rg\n{dots}EMC\n"


def _stream(data: bytes, entries: str) -> bytes:
    return b"<< /Length %d %b >>\nstream\n%b\nendstream" % (len(data), entries.encode("ascii"), data)


def _string(text: str) -> str:
    """Write a string of any signs, as hexadecimal UTF-16."""
    return f"<FEFF{in_one_line(text).encode('utf-16-be').hex().upper()}>"
