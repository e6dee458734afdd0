"""Amplitudes of an adaptive set's points, from these alone (Ahmed, Ren & Wonka 2022, Algorithm 2)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.reconstruction.kernel_sums import kernel_sums
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

ITERATIONS = 10  # Section 4.10
SIGMA = 0.5  # of kernels, in spacings of a uniform set
REFLECTED = 12.0  # widest kernel over sigma, for which points beyond the borders are reflected
LEAST = 1e-6  # of an amplitude over the mean: a point that no other one reaches keeps a finite kernel


def amplitudes(
    points: FloatArray,
    shape: tuple[int, ...],
    *,
    sigma: float = SIGMA,
    iterations: int = ITERATIONS,
    average: Literal["squares", "mean"] = "squares",
    reflected: bool = True,
    told: Callable[[int], None] | None = None,
) -> FloatArray:
    """Shape the kernels of a set so that their sum is its density.

    Parameters
    ----------
    points : (n, d) float64
        Within the domain, in pixels; d is 2 or 3.
    shape : tuple of int
        The domain's sides, in pixels.
    sigma : float
        Width of a kernel of amplitude 1, in spacings of a uniform set, (volume / n)^(1/d).
    iterations : int
        Of the algorithm, at least 0.
    average : {"squares", "mean"}
        What is made 1 after each: the mean of squares, as in the publication, or the mean, as in its authors'
        program.
    reflected : bool
        Reflect the points at the borders, so that those near them are not taken for sparse ones.
    told : callable, optional
        Called with the iterations done.

    Returns
    -------
    (n,) float64
        a_k, about the density at x_k over the mean one. The kernel is a_k exp(-a_k^(2/d) r^2 / (2 sigma^2)),
        whose mass is the same for all.

    Raises
    ------
    InputError
        If sigma is not above 0, iterations below 0, or average unknown.
    """
    if not sigma > 0:
        raise InputError(f"sigma must be above 0; got {sigma}")
    if iterations < 0:
        raise InputError(f"iterations must be >= 0; got {iterations}")
    if average not in ("squares", "mean"):
        raise InputError(f'average must be "squares" or "mean"; got {average!r}')
    n, d = points.shape
    width = kernel_width(n, shape, sigma)
    sources, number = with_reflections(points, shape, REFLECTED * width if reflected else 0.0)
    a = np.ones(n)
    for done in range(iterations):
        of_sources = a[number]
        density = kernel_sums(points, sources, of_sources, width**2 * of_sources ** (-2 / d)) - a
        density = np.maximum(density, LEAST * density.mean())
        if not density.any():
            return np.ones(n)
        norm = np.sqrt((density**2).mean()) if average == "squares" else density.mean()
        a = density / norm
        if told is not None:
            told(done + 1)
    return a


def kernel_width(n: int, shape: tuple[int, ...], sigma: float) -> float:
    """Give sigma in pixels: spacings of n uniform points times sigma.

    Parameters
    ----------
    n : int
        Points.
    shape : tuple of int
        The domain's sides, in pixels.
    sigma : float
        In spacings.

    Returns
    -------
    float
    """
    return float(sigma * (np.prod(shape, dtype=np.float64) / n) ** (1 / len(shape)))


def with_reflections(
    points: FloatArray, shape: tuple[int, ...], far: float
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Add the mirror images of the points that are near a border.

    Parameters
    ----------
    points : (n, d) float64
        Within the domain, in pixels.
    shape : tuple of int
        The domain's sides.
    far : float
        How near, in pixels; at most a side. 0 adds none.

    Returns
    -------
    points : (m, d) float64
        The points, then the images.
    number : (m,) intp
        Which point each is of.
    """
    number = np.arange(len(points))
    for a, side in enumerate(shape if far > 0 else ()):
        within = min(far, float(side))
        low, high = points[:, a] <= within, points[:, a] >= side - within
        below, above = points[low].copy(), points[high].copy()
        below[:, a] *= -1
        above[:, a] = 2 * side - above[:, a]
        points = np.concatenate([points, below, above])
        number = np.concatenate([number, number[low], number[high]])
    return points, number
