"""A density on pixels from points: kernels of the publication's amplitudes, and what to compare it with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, get_args

import numpy as np
from scipy import spatial

from gbnbench.analysis.reconstruction.kernel_sums import kernel_sums
from gbnbench.analysis.reconstruction.shaping import (
    ITERATIONS,
    REFLECTED,
    SIGMA,
    kernel_width,
    with_reflections,
)
from gbnbench.analysis.reconstruction.shaping import amplitudes as shaped
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

Estimate = Literal["shaping", "kernel", "voronoi"]
ESTIMATES: tuple[Estimate, ...] = get_args(Estimate)
PIXEL = 1 / 12  # variance of a pixel's square along an axis
FIXED = {2: 0.6, 3: 0.7}  # width of fixed kernels, in spacings
PARTS = 3  # of a pixel's side at least, among which a cell's volume is counted
FINE_ENOUGH = 64  # parts of pixels a point, above which no finer ones are counted


def reconstructed_density(
    points: FloatArray,
    shape: tuple[int, ...],
    *,
    estimate: Estimate = "shaping",
    size: tuple[int, ...] | None = None,
    sigma: float | None = None,
    iterations: int = ITERATIONS,
    average: Literal["squares", "mean"] = "squares",
    reflected: bool = True,
    amplitudes: FloatArray | None = None,
    told: Callable[[int, int, str], None] | None = None,
) -> FloatArray:
    """Estimate the density that a set was made for.

    Parameters
    ----------
    points : (n, d) float64
        Within the domain, in pixels, in the order of its axes; d is 2 or 3.
    shape : tuple of int
        The domain's sides, in pixels of the points.
    estimate : {"shaping", "kernel", "voronoi"}
        Algorithm 2's kernels; kernels of one width; or one over the volume of a point's cell.
    size : tuple of int, optional
        Pixels of the result along each axis; ``shape`` if not given.
    sigma : float, optional
        Width of kernels in spacings of a uniform set: 0.5 for Algorithm 2, 0.6 (in 3D 0.7) for fixed ones.
    iterations, average, reflected
        As ``shaping.amplitudes`` takes them.
    amplitudes : (n,) float64, optional
        Above 0, of mean 1: those of the kernels, in place of Algorithm 2's.
    told : callable, optional
        Called with (steps done, steps in all, what is being done).

    Returns
    -------
    ``size`` float64
        Points a unit of ``shape``'s volume, averaged over each pixel. Over the domain they add up to n.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Notes
    -----
    A kernel is taken at the centres of pixels, with the variance of a pixel added, and points are reflected
    once at each border. Where kernels are narrower than pixels or wider than the domain their sum misses n:
    by 5% for 50 points on one pixel, by half for one on 1 x 30, and by 1e-4 for 50 on 40 x 60. Without
    reflections it lacks what lies beyond the borders; a cell smaller than the parts that volumes are counted
    in may have none. All pixels are scaled by one factor, so that the sum is n.
    """
    d = len(shape)
    if points.ndim != 2 or points.shape[1] != d or d not in FIXED or not len(points):
        raise InputError(f"points must be (n, {d}) for a domain of {d} sides; got shape {points.shape}")
    if not ((points >= 0) & (points <= np.array(shape))).all():
        raise InputError(f"points must lie within the domain, 0 to {' x '.join(map(str, shape))}")
    if estimate not in ESTIMATES:
        raise InputError(f"estimate must be one of {', '.join(ESTIMATES)}; got {estimate!r}")
    counts = shape if size is None else size
    if len(counts) != d or min(counts) < 1:
        raise InputError(f"size must be {d} numbers of pixels; got {counts}")
    if estimate == "voronoi":
        return _of_cells(points, shape, counts)
    steps = iterations + 1 if estimate == "shaping" and amplitudes is None else 1

    def tell(done: int) -> None:
        if told is not None:
            told(done, steps, "amplitudes" if done < steps - 1 else "kernels")

    n = len(points)
    width = kernel_width(n, shape, sigma or (SIGMA if estimate == "shaping" else FIXED[d]))
    if estimate == "kernel":
        a = np.ones(n)
    elif amplitudes is None:
        a = shaped(
            points, shape, sigma=sigma or SIGMA, iterations=iterations, average=average, reflected=reflected,
            told=tell,
        )  # fmt: skip
    else:
        a = amplitudes
    sources, number = with_reflections(points, shape, REFLECTED * width if reflected else 0.0)
    cell = np.array(shape) / np.array(counts)
    spread = float(np.exp(np.log(cell**2 * PIXEL).mean()))  # of a pixel of the result
    variances = width**2 * a[number] ** (-2 / d) + spread
    heights = (2 * np.pi * variances) ** (-d / 2)
    lines = [_centres(s, c) for s, c in zip(shape, counts, strict=True)]
    places = np.stack(np.meshgrid(*lines, indexing="ij"), -1)
    found = kernel_sums(places.reshape(-1, d), sources, heights, variances).reshape(counts)
    tell(steps)
    return _adding_up(found, n, float(np.prod(shape, dtype=np.float64)))


def _adding_up(density: FloatArray, n: int, volume: float) -> FloatArray:
    """Scale a density so that it adds up to n."""
    mean = density.mean()
    # Pixels that are much longer than wide may have no kernel at their centres.
    return density * (n / (mean * volume)) if mean > 0 else np.full(density.shape, n / volume)


def _centres(side: int, count: int) -> FloatArray:
    centres: FloatArray = (np.arange(count, dtype=np.float64) + 0.5) * (side / count)
    return centres


def _of_cells(points: FloatArray, shape: tuple[int, ...], counts: tuple[int, ...]) -> FloatArray:
    """One over the volume of the nearest point's cell, counted in parts of pixels, averaged over pixels."""
    d, n = len(shape), len(points)
    parts = PARTS
    while parts**d * np.prod(counts) < FINE_ENOUGH * n:
        parts += 1
    lines = [_centres(s, c * parts) for s, c in zip(shape, counts, strict=True)]
    places = np.stack(np.meshgrid(*lines, indexing="ij"), -1).reshape(-1, d)
    nearest = spatial.cKDTree(points).query(places, workers=-1)[1]
    volume = float(np.prod(shape, dtype=np.float64)) / len(places)
    density = 1 / (np.maximum(np.bincount(nearest, minlength=n), 1) * volume)
    fine = density[nearest].reshape([size for count in counts for size in (count, parts)])
    averaged: FloatArray = fine.mean(axis=tuple(range(1, 2 * d, 2)))
    return _adding_up(averaged, n, volume * len(places))
