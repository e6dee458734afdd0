"""Units of points: the unit square, x right and y up, and pixels, x right and y down."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray

Y = 1  # the axis that is turned over


def unit_square(pixels: FloatArray, size: tuple[int, ...]) -> FloatArray:
    """Take pixels to the unit square.

    Parameters
    ----------
    pixels : (n, d) float64
        x to the right, y down, from 0 to ``size``.
    size : tuple of int
        Pixels along x, y (and z).

    Returns
    -------
    (n, d) float64
        In [0, 1): each axis divided by its own count of pixels, y up.
    """
    x: FloatArray = pixels / np.array(size, np.float64)
    x[:, Y] = 1 - x[:, Y]
    return np.clip(x, 0, np.nextafter(1, 0))


def in_pixels(points: FloatArray, size: tuple[int, ...]) -> FloatArray:
    """Take the unit square to pixels.

    Parameters
    ----------
    points : (n, d) float64
        In [0, 1]: x to the right, y up.
    size : tuple of int
        Pixels along x, y (and z).

    Returns
    -------
    (n, d) float64
        x to the right, y down, from 0 to ``size``.
    """
    x = points.astype(np.float64)
    x[:, Y] = 1 - x[:, Y]
    pixels: FloatArray = x * np.array(size, np.float64)
    return pixels
