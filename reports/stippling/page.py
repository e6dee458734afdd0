"""A page of dots in millimetres: what every format of a stippling is written from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

MOST_MM = 10_000.0  # of a side
WHITE = "#ffffff"
DIGITS = 4  # decimals of a millimetre: a tenth of a micrometre


@dataclass(frozen=True)
class DotLayer:
    """Dots of one ink.

    Attributes
    ----------
    name : str
        What the layer is called, such as ``black``.
    colour : str
        ``#rrggbb``.
    centres : (n, 2) float64
        Millimetres, x from the left border and y down from the upper, in the order of drawing.
    radii : (n,) float64
        Millimetres.
    """

    name: str
    colour: str
    centres: FloatArray
    radii: FloatArray

    @property
    def rgb(self) -> tuple[float, float, float]:
        """Red, green and blue from 0 to 1."""
        return rgb_of(self.colour)


@dataclass(frozen=True)
class Page:
    """A sheet of paper with layers of dots.

    Attributes
    ----------
    width, height : float
        Millimetres.
    layers : tuple of DotLayer
        In the order of printing.
    title, text : str
        What is drawn, and how it was made, for the formats that can hold it.
    paper : str
        Its colour, ``#rrggbb``. Inks on white paper multiply, as prints do; on any other they cover it, as
        white ink covers black paper.
    margin : float
        Millimetres on each side of the picture.
    toroidal : bool
        Opposite borders of the picture meet: drawn, a dot that hangs over one is seen at the other too, and
        nothing beyond the page. ``layers`` hold each dot once.

    Raises
    ------
    InputError
        If the page is no page, or one is larger than ten metres.
    """

    width: float
    height: float
    layers: tuple[DotLayer, ...]
    title: str = ""
    text: str = ""
    paper: str = WHITE
    margin: float = 0.0
    toroidal: bool = False

    def __post_init__(self) -> None:
        if not (self.width > 0 and self.height > 0):
            raise InputError(f"a page is wider and higher than 0 mm; got {self.width:g} x {self.height:g} mm")
        if max(self.width, self.height) > MOST_MM:
            raise InputError(
                f"a page is at most {MOST_MM:g} mm wide and high; got {self.width:g} x {self.height:g} mm"
            )

    @property
    def white(self) -> bool:
        """Whether the paper is white."""
        return self.paper == WHITE


def rgb_of(colour: str) -> tuple[float, float, float]:
    """Red, green and blue from 0 to 1 of ``#rrggbb``."""
    shares = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return cast("tuple[float, float, float]", tuple(shares))
