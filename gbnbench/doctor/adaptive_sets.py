"""Checks of the kernels of adaptive sets: their gradient, and sums of kernels, against plain sums."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
from scipy import ndimage

from gbnbench.analysis.reconstruction.kernel_sums import kernel_sums
from gbnbench.core.torus import FloatArray
from gbnbench.doctor.check import Check
from gbnbench.generators.adaptive.density import Density, as_density
from gbnbench.generators.adaptive.gbn.attraction import PIXEL
from gbnbench.generators.adaptive.gbn.energy import AdaptiveEnergy
from gbnbench.generators.adaptive.gbn.kernel_widths import BORDER, kernel_widths
from gbnbench.opencl import runtime

SIGMA, SMOOTHING = 0.9, 0.5
SIDES = {2: (53, 68), 3: (17, 19, 18)}  # of the density, in pixels
STEP = 1e-5  # pixels, of differences
ALLOWED = {"double": 1e-8, "float": 1e-4}  # over the largest component
ALLOWED_SUM = 1e-5  # of terms of at most 1


def adaptive_gradient(n: int, d: int, precision: str) -> Iterator[Check]:
    """Try the kernels on the torus.

    Parameters
    ----------
    n, d : int
        Points and dimension, 2 or 3.
    precision : {"double", "float"}
        Of the kernels.

    Yields
    ------
    Check
    """
    rng = np.random.default_rng(n)
    density = as_density(ndimage.gaussian_filter(rng.random(SIDES[d]), 2, mode="wrap"), toroidal=True)
    x = 0.5 + rng.random((n, d)) * (np.array(density.shape) - 1)
    # Pixels that are not spread need no ladder of widths, so that the sum over them is exact.
    energy = AdaptiveEnergy(
        runtime(), density, n, sigma=SIGMA, smoothing=SMOOTHING, spread=0.0, precision=precision
    )
    expected = numpy_adaptive_gradient(x, density)
    error = float(np.max(np.abs(energy(x).gradient - expected)) / np.max(np.abs(expected)))
    yield Check("adaptive gradient", f"n={n} d={d}", precision, error, ALLOWED[precision])


def sums_of_kernels(n: int, d: int, precision: str) -> Iterator[Check]:
    """Try the sums that a reconstruction takes.

    Parameters
    ----------
    n, d : int
        Points and dimension, 2 or 3.
    precision : {"double", "float"}
        For the report; the sums are always in float.

    Yields
    ------
    Check
    """
    rng = np.random.default_rng(n)
    points, places = rng.random((n, d)) * 30, rng.random((2 * n, d)) * 40 - 5
    weights, variances = rng.random(n), np.exp(2 * rng.normal(size=n))
    square = ((places[:, None] - points) ** 2).sum(axis=2)
    expected = (weights * np.exp(-square / (2 * variances))).sum(axis=1)
    error = float(np.max(np.abs(kernel_sums(places, points, weights, variances) - expected)))
    yield Check("sums of kernels", f"n={n} d={d}", precision, error, ALLOWED_SUM)


def numpy_adaptive_gradient(x: FloatArray, density: Density) -> FloatArray:
    """Sum over all pairs, and over all points and pixels, and their nearest images.

    Parameters
    ----------
    x : (n, d) float64
        Points, in pixels.
    density : Density
        On the torus.

    Returns
    -------
    (n, d) float64
    """
    n, d = x.shape
    spline = kernel_widths(density, n, SIGMA, SMOOTHING).coefficients

    def log_width(at: FloatArray) -> FloatArray:
        found: FloatArray = ndimage.map_coordinates(spline, at.T - 0.5 + BORDER, order=3, prefilter=False)
        return found

    slopes = np.stack([(log_width(x + h) - log_width(x - h)) / (2 * STEP) for h in STEP * np.eye(d)], axis=1)
    v = np.exp(2 * log_width(x))
    pixels = np.argwhere(np.ones(density.shape)) + 0.5
    mass = density.of_points(n).ravel()
    total = np.zeros((n, d))
    for others, weight, variance in ((x, np.ones(n), v), (pixels, -mass, np.full(len(pixels), PIXEL))):
        nearest = x[:, None] - others
        nearest -= np.array(density.shape) * np.rint(nearest / density.shape)
        for image in itertools.product((-1, 0, 1), repeat=d):
            apart = nearest + np.array(image) * density.shape
            w = v[:, None] + variance
            square = (apart**2).sum(axis=2)
            gauss = weight * np.exp(-square / (2 * w)) / (2 * np.pi * w) ** (d / 2)
            by_variance = (gauss * (square / (2 * w) - d / 2) / w).sum(axis=1)
            total -= ((gauss / w)[..., None] * apart).sum(axis=1)
            total += (2 * v * by_variance)[:, None] * slopes
    return total
