"""Difference of a set and its density at one scale: both blurred by a Gaussian."""

from __future__ import annotations

import itertools
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

LEAST_WIDTH = 2.0  # pixels
SPLINE_VARIANCE, PIXEL_VARIANCE = 1 / 3, 1 / 12  # squared pixels: of a cubic B-spline, and of a pixel
SPILL = 2  # pixels beyond a border that a point's spline may reach
REACH = 6.0  # standard deviations after which a Gaussian is cut off


def blurred_difference_map(
    points: FloatArray, density: FloatArray, width: float, *, toroidal: bool = False
) -> FloatArray:
    """Blur a set less its density, over the mean density.

    Parameters
    ----------
    points : (n, d) float64
        Within the density, in pixels, in the order of its axes.
    density : float64 array
        At least 0; its scale is free.
    width : float
        Standard deviation of the Gaussian in pixels, at least 2.
    toroidal : bool
        Whether opposite borders meet; what is beyond a border counts as 0 otherwise.

    Returns
    -------
    float64 array of the density's shape
        At the centres of pixels; above 0 where there are too many points.

    Raises
    ------
    InputError
        If the width is less than 2 pixels.

    Notes
    -----
    Points count where they are, not by the pixel that holds them, which would add noise of its own: of a
    good set most of the difference. Each is a cubic B-spline on the pixels, whose variance is 1/3 wherever
    it lies, and the Gaussian is narrower by as much; the density's pixels are squares. What is left out is
    the fourth cumulant: in the plane 6e-4 of a point's Gaussian at a width of 2 pixels, falling with the
    fourth power of the width.
    """
    if not width >= LEAST_WIDTH:
        raise InputError(f"width must be at least {LEAST_WIDTH:g} pixels, got {width:g}")
    wanted = density * (len(points) / density.sum())
    mode: Literal["wrap", "constant"] = "wrap" if toroidal else "constant"

    def blurred(image: FloatArray, variance: float) -> FloatArray:
        found: FloatArray = ndimage.gaussian_filter(image, np.sqrt(variance), mode=mode, truncate=REACH)
        return found

    spill = 0 if toroidal else SPILL
    set_ = blurred(_splines(points, density.shape, spill), width**2 - SPLINE_VARIANCE)
    inside = tuple(slice(spill, spill + size) for size in density.shape)
    difference = set_[inside] - blurred(wanted, width**2 + PIXEL_VARIANCE)
    return np.asarray(difference / wanted.mean())


def blurred_difference(
    points: FloatArray, density: FloatArray, width: float, *, toroidal: bool = False
) -> float:
    """Give the root mean square of the blurred difference, over the mean density.

    Parameters
    ----------
    points : (n, d) float64
        Within the density, in pixels, in the order of its axes.
    density : float64 array
        At least 0; its scale is free.
    width : float
        Standard deviation of the Gaussian in pixels, at least 2.
    toroidal : bool
        Whether opposite borders meet; what is beyond a border counts as 0 otherwise.

    Returns
    -------
    float

    Raises
    ------
    InputError
        If the width is less than 2 pixels.
    """
    difference = blurred_difference_map(points, density, width, toroidal=toroidal)
    return float(np.sqrt((difference**2).mean()))


def _splines(points: FloatArray, shape: tuple[int, ...], spill: int) -> FloatArray:
    """Add up cubic B-splines at points, with ``spill`` pixels beyond each border; with none, borders meet."""
    place = points - 0.5  # from the centre of the first pixel
    cell = np.floor(place)
    t = place - cell
    weights = np.stack(
        [(1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3]
    ) / 6  # fmt: skip
    first = cell.astype(np.intp) - 1 + spill
    sizes = np.array(shape) + 2 * spill
    total = np.zeros(int(sizes.prod()))
    for offsets in itertools.product(range(4), repeat=len(shape)):
        at: NDArray[np.intp] = (first + np.array(offsets)) % sizes
        share = np.prod([weights[offset][:, axis] for axis, offset in enumerate(offsets)], axis=0)
        total += np.bincount(np.ravel_multi_index(tuple(at.T), tuple(sizes)), share, len(total))
    return total.reshape(sizes)
