"""A density of points on a grid of pixels, or voxels, as adaptive samplers take it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

AXES = (2, 3)
MOST_PIXELS = 1 << 27  # of a density


@dataclass(frozen=True)
class Density:
    """How many points are wanted where, up to a factor.

    Pixel (i, j) is the square from i to i + 1 along the first axis and from j to j + 1 along the second, all
    of one density. Positions are in pixels, in the order of the array's axes: rows first.

    Attributes
    ----------
    values : (rows, columns) or (slices, rows, columns) float64
        At least 0, and above 0 somewhere.
    toroidal : bool
        Whether opposite borders meet.
    """

    values: FloatArray
    toroidal: bool = False

    @property
    def shape(self) -> tuple[int, ...]:
        """Pixels along each axis."""
        return self.values.shape

    @property
    def d(self) -> int:
        """Number of axes."""
        return self.values.ndim

    def of_points(self, n: int) -> FloatArray:
        """Scale the density to points a pixel, so that it adds up to n."""
        scaled: FloatArray = self.values * (n / self.values.sum())
        return scaled

    def finer(self, parts: int) -> Density:
        """Cut every pixel into equal parts along each axis."""
        values = self.values
        for a in range(self.d if parts > 1 else 0):
            values = np.repeat(values, parts, axis=a)
        return Density(values, self.toroidal)


def as_density(values: ArrayLike, *, toroidal: bool = False) -> Density:
    """Check a density.

    Parameters
    ----------
    values : (rows, columns) or (slices, rows, columns) array_like
        Real numbers, at least 0.
    toroidal : bool
        Whether opposite borders meet.

    Returns
    -------
    Density

    Raises
    ------
    InputError
        If the array has another number of axes, is empty or too large, or holds what is no density.
    """
    try:
        array = np.array(values, np.float64, order="C")
    except (TypeError, ValueError):
        raise InputError("a density is an array of real numbers") from None
    if array.ndim not in AXES:
        raise InputError(f"a density has two axes (an image) or three (a volume); got shape {array.shape}")
    if array.size == 0:
        raise InputError(f"a density has pixels; got shape {array.shape}")
    if array.size > MOST_PIXELS:
        raise InputError(
            f"a density has at most {MOST_PIXELS:,} pixels; got {array.size:,}: scale the image down"
        )
    if not np.isfinite(array).all():
        raise InputError(f"{int((~np.isfinite(array)).sum())} pixels of the density are nan or infinite")
    if array.min() < 0:
        raise InputError(f"a density is nowhere below 0; the least pixel is {array.min():g}")
    if not array.max() > 0:
        raise InputError("the density is 0 everywhere, so that no point has a place")
    return Density(array / array.max(), toroidal)


def density_of(
    function: Callable[[FloatArray], ArrayLike], shape: tuple[int, ...], *, toroidal: bool = False
) -> Density:
    """Sample a function at the centres of pixels.

    Parameters
    ----------
    function : callable
        Takes positions (pixels, d) in pixels, in the order of ``shape``, and gives a density for each.
    shape : tuple of int
        Pixels along each axis.
    toroidal : bool
        Whether opposite borders meet.

    Returns
    -------
    Density

    Raises
    ------
    InputError
        If what comes out is no density, or not one number a pixel.
    """
    lines = [np.arange(size, dtype=np.float64) + 0.5 for size in shape]
    centres: FloatArray = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    found = np.asarray(function(centres.reshape(-1, len(shape))))
    if found.shape != (centres[..., 0].size,):
        raise InputError(
            f"the density function gave shape {found.shape} for {centres[..., 0].size} positions, "
            "where one number each was wanted"
        )
    return as_density(found.reshape(shape), toroidal=toroidal)
