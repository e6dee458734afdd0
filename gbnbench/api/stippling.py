"""A stippling: points that draw an image, with their amplitudes and what made them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.io.points.stippled_points import AMPLITUDE
from gbnbench.studies.stippling.units import unit_square

if TYPE_CHECKING:
    import pandas as pd

SHARES = ("right_of_width", "up_of_height", "along_depth")  # names of columns
PIXELS = ("right_pixels", "down_pixels", "along_slices")


@dataclass(frozen=True)
class Stippling:
    """Points that draw an image: ``made = stipple(...)``, or ``points, amplitudes = stipple(...)``.

    Attributes
    ----------
    pixels : (n, d) float64
        The points in pixels, x to the right first, then y down from the upper border (then z, the first axis
        of a volume): the centre of the pixel in the upper left corner is (0.5, 0.5).
    amplitudes : (n,) float64
        The paper's a_k, of mean 1: how dense the points are around each, over the mean of that.
    density : Density
        What they were drawn for; its axes are in the order of arrays, rows first.
    coverage : float
        Share of the image, 0 to 1, that dots have to cover to be as dark as it is; of a density its mean over
        its largest value.
    name : str
        The image.
    method : str
        The generator with its settings.
    seed : int
        That they were drawn from.
    device, version : str
        Name of the OpenCL device, empty where there is none, and gbnbench's version.
    seconds : float
        Wall time of the drawing.
    remarks : tuple of str
        What was done to read the image that might surprise.

    Examples
    --------
    >>> import gbnbench
    >>> made = gbnbench.stipple(lambda x: 1 + x[:, 1], 40, shape=(16, 24), method="rejection")
    >>> made.size, made.to_frame().columns.tolist()
    ((24, 16), ['right_of_width', 'up_of_height', 'right_pixels', 'down_pixels', 'amplitude'])
    >>> points, amplitudes = made
    >>> bool(((points >= 0) & (points < 1)).all())
    True
    """

    pixels: FloatArray
    amplitudes: FloatArray
    density: Density
    coverage: float
    name: str
    method: str
    seed: int
    device: str
    version: str
    seconds: float
    remarks: tuple[str, ...] = ()

    def __repr__(self) -> str:
        """Say what it is in a line, without its numbers."""
        size = " x ".join(map(str, self.size))
        n = len(self.pixels)
        return f"<Stippling of {self.name}, {size}: {n:,} points by {self.method}, seed {self.seed}>"

    def __iter__(self) -> Iterator[FloatArray]:
        """Give the points, then the amplitudes."""
        return iter((self.points, self.amplitudes))

    @property
    def points(self) -> FloatArray:
        """(n, d) float64 in the unit square, [0, 1)^d: x to the right, y up (z along the slices of a volume).

        Each axis is divided by its own count of pixels, so that of an image that is no square the two units
        differ: the lower left corner is (0, 0), the upper right one (1, 1).
        """
        return unit_square(self.pixels, self.size)

    @property
    def size(self) -> tuple[int, ...]:
        """Pixels along x, y (and z): width first."""
        return self.density.shape[::-1]

    @property
    def radius(self) -> float:
        """Radius in pixels of equal dots that cover, overlaps apart, as much as the image is dark."""
        share = self.coverage * math.prod(self.size) / len(self.pixels)
        return math.sqrt(share / math.pi) if len(self.size) == 2 else math.cbrt(share * 3 / (4 * math.pi))

    def to_frame(self) -> pd.DataFrame:
        """Give a row a point, in both units.

        Returns
        -------
        pandas.DataFrame
            ``right_of_width`` and ``up_of_height``, which are ``points``: shares of the picture's sides from
            its lower left corner, 0 to 1; ``right_pixels`` and ``down_pixels``, which are ``pixels``: from
            its upper left corner; of a volume ``along_depth`` and ``along_slices`` after each pair; and
            ``amplitude``, whose mean is 1.
        """
        import pandas as pd

        shares = dict(zip(SHARES, self.points.T, strict=False))
        counted = dict(zip(PIXELS, self.pixels.T, strict=False))
        return pd.DataFrame({**shares, **counted, AMPLITUDE: self.amplitudes})
