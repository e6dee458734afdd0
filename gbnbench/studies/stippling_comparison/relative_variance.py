"""The variance energy of a set, relative to the density: what adaptive Gaussian blue noise lowers."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.reconstruction.kernel_sums import kernel_sums
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import MOST_PIXELS, Density
from gbnbench.generators.adaptive.gbn.attraction import attraction_levels
from gbnbench.generators.adaptive.gbn.energy import REACH, RESOLUTION
from gbnbench.generators.adaptive.gbn.kernel_widths import kernel_widths


def relative_variance(points: FloatArray, density: Density) -> float:
    """Give the mean over the density of ((A - T) / T)^2, with the faithful kernels: sigma = c = t = 1.

    Parameters
    ----------
    points : (n, 2) float64
        In pixels, in the order of the density's axes.
    density : Density
        Theirs, not toroidal.

    Returns
    -------
    float
        A sums the points' Gaussians, whose widths follow the density, and T is what it is to be (Ahmed, Ren &
        Wonka 2022, Eq. 29 and 47). Both are taken at the centres of pixels, which are cut where they are
        coarser than kernels; nan where that would make too many.
    """
    n = len(points)
    narrowest = 1 / math.sqrt(2 * float(density.of_points(n).max()))
    parts = math.ceil(RESOLUTION["float"] / narrowest)
    if density.values.size * parts**2 > MOST_PIXELS:
        return math.nan
    density, points = density.finer(parts), points * parts
    widths = kernel_widths(density, n, 1.0, 1.0)
    level = attraction_levels(density, n, widths, 1.0, RESOLUTION["float"], REACH["float"])[0]
    first = np.rint(0.5 - level.first).astype(int)
    target = level.values[tuple(slice(a, a + size) for a, size in zip(first, density.shape, strict=True))]
    pixels = np.minimum(points.astype(np.intp), np.array(density.shape) - 1)
    variances = np.exp(2 * widths.log_width[tuple(pixels.T)])
    places = np.argwhere(np.ones(density.shape)).astype(np.float64) + 0.5
    found = kernel_sums(places, points, 1 / (2 * np.pi * variances), variances).reshape(density.shape)
    relative = ((found - target) / np.maximum(target, 1e-12)) ** 2
    return float((relative * density.of_points(n)).sum() / n)
