"""A density that no pixel has more than one point of, as a halftone needs it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.method import too_fine

FULLEST = 0.95  # of a pixel's point, at most


def parts_for_dithering(density: Density, n: int) -> int:
    """Count the parts of a pixel's side that leave each at most one point.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.

    Returns
    -------
    int
    """
    fullest = float(density.of_points(n).max()) / FULLEST
    return max(1, math.ceil(math.pow(fullest, 1 / density.d)))


def dithering_refusal(density: Density, n: int) -> str | None:
    """Say why a halftone of a density has no n points.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.

    Returns
    -------
    str or None
        The reason.
    """
    if density.d != 2:
        return f"halftones are of images, with two axes; got {density.d}"
    pixels = density.values.size * parts_for_dithering(density, n) ** 2
    return too_fine(density, n, pixels, "a larger image")


def centres(black: NDArray[np.bool_], parts: int) -> FloatArray:
    """Give the centres of black parts of pixels.

    Parameters
    ----------
    black : (rows, columns) bool
        Of the density cut into parts.
    parts : int
        Parts of a pixel's side.

    Returns
    -------
    (n, 2) float64
        In pixels of the density.
    """
    found: FloatArray = (np.argwhere(black) + 0.5) / parts
    return found
