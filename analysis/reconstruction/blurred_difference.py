"""Difference of a set and its density at one scale: both blurred by a Gaussian."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from gbnbench.core.torus import FloatArray


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
        Standard deviation of the Gaussian in pixels.
    toroidal : bool
        Whether opposite borders meet; what is beyond a border counts as 0 otherwise.

    Returns
    -------
    float64 array of the density's shape
        Above 0 where there are too many points.
    """
    wanted = density * (len(points) / density.sum())
    pixels = np.minimum(points.astype(np.intp), np.array(density.shape) - 1)
    counts = np.zeros(density.shape)
    np.add.at(counts, tuple(pixels.T), 1)
    difference = ndimage.gaussian_filter(counts - wanted, width, mode="wrap" if toroidal else "constant")
    found: FloatArray = difference / wanted.mean()
    return found


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
        Standard deviation of the Gaussian in pixels.
    toroidal : bool
        Whether opposite borders meet; what is beyond a border counts as 0 otherwise.

    Returns
    -------
    float
    """
    difference = blurred_difference_map(points, density, width, toroidal=toroidal)
    return float(np.sqrt((difference**2).mean()))
