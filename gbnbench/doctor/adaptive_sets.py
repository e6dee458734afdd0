"""Checks of the kernels of adaptive sets: gradient, sums of kernels and voids, against plain numpy."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
from scipy import ndimage

from gbnbench.analysis.reconstruction.kernel_sums import kernel_sums
from gbnbench.core.torus import FloatArray
from gbnbench.doctor.check import Check
from gbnbench.generators.adaptive.density import Density, as_density
from gbnbench.generators.adaptive.domain import interpolation_mode, shortest
from gbnbench.generators.adaptive.farthest_point.places import Places, void_places
from gbnbench.generators.adaptive.farthest_point.relocation import AdaptiveSweeps
from gbnbench.generators.adaptive.gbn.attraction import PIXEL
from gbnbench.generators.adaptive.gbn.energy import AdaptiveEnergy
from gbnbench.generators.adaptive.gbn.kernel_widths import BORDER, kernel_widths
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.opencl import runtime

SIGMA, SMOOTHING = 0.9, 0.5
SIDES = {2: (53, 68), 3: (17, 19, 18)}  # of the density, in pixels
STEP = 1e-5  # pixels, of differences
ALLOWED = {"double": 1e-8, "float": 1e-4}  # over the largest component
ALLOWED_SUM = 1e-5  # of terms of at most 1
ALLOWED_VOID = (
    3e-5  # in local spacings; voids are kept in float, and one that grows by less than 1e-5 is left
)


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


def voids_of_farthest_points(n: int, toroidal: bool, precision: str) -> Iterator[Check]:
    """Try the voids that are kept up while farthest-point optimisation moves its points, after two sweeps.

    Parameters
    ----------
    n : int
        Points.
    toroidal : bool
        Whether opposite borders meet.
    precision : {"double", "float"}
        For the report; points are in double, and voids in float.

    Yields
    ------
    Check
    """
    rng = np.random.default_rng(n)
    values = ndimage.gaussian_filter(rng.random(SIDES[2]), 4, mode="wrap")
    density = as_density(np.maximum(values - np.quantile(values, 0.3), 0), toroidal=toroidal)
    places = void_places(density, n, 0.5)
    work = AdaptiveSweeps(density, places, hilbert_start(density, n, rng))
    for _ in range(2):
        work.sweep()
    at = places.places.astype(np.float64)
    x = work.points()
    error = float(np.abs(work.voids() - numpy_voids(density, places, at, x)).max())
    apart = [numpy_voids(density, places, x[k : k + 1], np.delete(x, k, axis=0))[0] for k in range(n)]
    error = max(error, float(np.abs(work.nearest() - apart).max()))
    yield Check("voids", f"n={n} toroidal={toroidal}", precision, error, ALLOWED_VOID)


def numpy_voids(density: Density, places: Places, at: FloatArray, points: FloatArray) -> FloatArray:
    """Measure voids: the distance of places to the nearest point, over the mean of the spacings at both.

    Parameters
    ----------
    density : Density
        The density.
    places : Places
        Its local spacing.
    at : (m, 2) float64
        Where the voids are wanted, in pixels.
    points : (n, 2) float64
        What leaves them.

    Returns
    -------
    (m,) float64
        At most the distance to the place's own image: beyond the border, or a side away on the torus.
    """
    mode, table = interpolation_mode(toroidal=density.toroidal), places.spacing.astype(np.float64)
    here, there = (ndimage.map_coordinates(table, x.T - 0.5, order=1, mode=mode) for x in (at, points))
    length = np.sqrt((shortest(density, at[:, None] - points) ** 2).sum(axis=2))
    nearest = (2 * length / (here[:, None] + there)).min(axis=1)
    shape = np.array(density.shape, np.float64)
    image = np.full(len(at), shape.min()) if density.toroidal else 2 * np.minimum(at, shape - at).min(axis=1)
    found: FloatArray = np.minimum(nearest, image / here)
    return found


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
