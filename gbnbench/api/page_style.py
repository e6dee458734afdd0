"""Pages of stipplings: width, margin and colour of the paper, and the size of dots."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.reports.stippling.page import WHITE, DotLayer, Page

if TYPE_CHECKING:
    from gbnbench.api.stippling import Stippling

WIDTH_MM = 160.0
INKS = {
    "black": "#000000", "white": "#ffffff", "cyan": "#00aeef", "magenta": "#ec008c", "yellow": "#fff200",
}  # fmt: skip
Dots = Literal["equal", "tone"]


@dataclass(frozen=True)
class PageStyle:
    """How stipplings lie on paper.

    Parameters
    ----------
    width_mm : float
        Of the page with its margins, above 0; its height follows.
    margin_mm : float, optional
        Blank paper on each side of the picture, at least 0 and less than half the width. By default the
        radius of the largest dot, so that none hangs over the border; of stipplings whose opposite borders
        meet 0, so that copies side by side have no seam.
    dots : {"equal", "tone"}
        Dots of one size, or areas in proportion to the amplitudes.
    dot_mm : float, optional
        Diameter of equal dots, above 0; by default dots cover as much as the image is dark, overlaps apart.
    paper : str
        Its colour, ``#rrggbb``. Inks on white paper multiply; on any other they cover it.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    width_mm: float = WIDTH_MM
    margin_mm: float | None = None
    dots: Dots = "equal"
    dot_mm: float | None = None
    paper: str = WHITE

    def __post_init__(self) -> None:
        for name, value in (("width_mm", self.width_mm), ("dot_mm", self.dot_mm)):
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InputError(f"{name} must be above 0; got {value}")
        if self.margin_mm is not None and not 0 <= self.margin_mm < self.width_mm / 2:
            raise InputError(
                f"margin_mm must be at least 0 and less than half the width, {self.width_mm / 2:g}; "
                f"got {self.margin_mm:g}"
            )
        if self.dot_mm is not None and self.dot_mm >= self.width_mm:
            raise InputError(f"dot_mm must be less than the width, {self.width_mm:g}; got {self.dot_mm:g}")

    def placing(self, columns: int, widest: float) -> tuple[float, float]:
        """Find the scale of the picture, and where it begins.

        Parameters
        ----------
        columns : int
            Pixels along x.
        widest : float
            Radius of the largest dot in pixels; it does not count where ``dot_mm`` is given.

        Returns
        -------
        mm : float
            Side of a pixel, in millimetres.
        margin : float
            In millimetres.

        Examples
        --------
        >>> PageStyle(100, margin_mm=10).placing(40, 0.5), PageStyle(82).placing(40, 0.5)
        ((2.0, 10), (2.0, 1.0))
        """
        if self.margin_mm is not None:
            margin = self.margin_mm
        elif self.dot_mm is not None:
            margin = self.dot_mm / 2
        else:
            margin = self.width_mm * widest / (columns + 2 * widest)
        return (self.width_mm - 2 * margin) / columns, margin


def page_of(layers: Mapping[str, Stippling], style: PageStyle) -> Page:
    """Lay stipplings on one page.

    Parameters
    ----------
    layers : mapping of str to Stippling
        Stipplings in two dimensions of one size, by the names of their inks (of ``INKS``, or ``#rrggbb``), in
        the order of printing.
    style : PageStyle
        How they lie on it.

    Returns
    -------
    Page

    Raises
    ------
    InputError
        If the page is too large, or the points are of a volume.
    """
    first = next(iter(layers.values()))
    if len(first.size) != 2:
        raise InputError("points of a volume lie on no page: write them as .txt or .csv")
    toroidal = first.density.toroidal
    if toroidal and style.margin_mm is None:
        style = replace(style, margin_mm=0.0)
    radii = {name: _radii(made, style) for name, made in layers.items()}
    mm, margin = style.placing(first.size[0], max(float(each.max()) for each in radii.values()))
    sheets = [
        DotLayer(
            name,
            name if name.startswith("#") else INKS.get(name, "#000000"),
            made.pixels * mm + margin,
            radii[name] * mm if style.dot_mm is None else np.full(len(made.pixels), style.dot_mm / 2),
        )
        for name, made in layers.items()
    ]
    counts = ", ".join(
        f"{len(sheet.radii)} dot{'s' * (len(sheet.radii) != 1)} of {sheet.name}" for sheet in sheets
    )
    text = f"{counts}; {first.method}, seed {first.seed}, gbnbench {first.version}"
    name = next(iter(layers))
    title = first.name.removesuffix(f", {name}")  # of the image: an ink's darkness is named by both
    height = first.size[1] * mm + 2 * margin
    return Page(style.width_mm, height, tuple(sheets), title, text, style.paper, margin, toroidal)


def _radii(made: Stippling, style: PageStyle) -> FloatArray:
    """Radii of dots in pixels that cover as much as the image is dark, overlaps apart."""
    shares = np.sqrt(made.amplitudes) if style.dots == "tone" else np.ones(len(made.pixels))
    radii: FloatArray = made.radius * shares
    return radii
