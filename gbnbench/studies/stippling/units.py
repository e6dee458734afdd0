"""Units of points: the unit square, x right and y up, and pixels, x right and y down; shapes of pixels."""

from __future__ import annotations

import math
import numbers
from collections.abc import Collection

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

Y = 1  # the axis that is turned over
MOST_PIXELS = 1 << 27  # of a picture whose shape is given
AXES = {2: "(rows, columns)", 3: "(slices, rows, columns)"}


def checked_shape(shape: object, dimensions: Collection[int]) -> tuple[int, ...]:
    """Check the shape of a picture or a volume.

    Parameters
    ----------
    shape : sequence of int
        Pixels along each axis, in the order of arrays.
    dimensions : collection of int
        How many axes there may be: 2, 3 or either.

    Returns
    -------
    tuple of int

    Raises
    ------
    InputError
        If it is no sequence of whole numbers above 0, or of too many axes or pixels.
    """
    sides = tuple(shape) if isinstance(shape, tuple | list) else ()
    whole = all(isinstance(side, numbers.Integral) and int(side) >= 1 for side in sides)
    axes = " or ".join(AXES[d] for d in sorted(dimensions))
    if len(sides) not in dimensions or not whole:
        raise InputError(
            f"shape must be {axes}, whole numbers of pixels, each at least 1; got {_said(shape)}"
        )
    if math.prod(sides) > MOST_PIXELS:
        raise InputError(
            f"shape must be {axes}, at most {MOST_PIXELS:,} pixels in all; got {math.prod(sides):,}"
        )
    return tuple(int(side) for side in sides)


def _said(shape: object) -> str:
    """Write what was given without the marks of Python's containers."""
    if isinstance(shape, tuple | list):
        return " x ".join(map(str, shape)) or "no sides"
    return f"{shape}"


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
