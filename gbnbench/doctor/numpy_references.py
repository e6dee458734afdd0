"""Powers, energy gradients and sums in plain numpy, that kernels are checked against."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf

from gbnbench.core.torus import FloatArray, spacing


def numpy_power(x: FloatArray, frequencies: NDArray[np.int64]) -> FloatArray:
    """Power at listed frequencies by exact integer phases and numpy's own cosines.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    frequencies : (m, d) int64
        In cycles per unit length.

    Returns
    -------
    (m,) float64
    """
    turns = np.rint(x * 2.0**64).astype(np.uint64)
    phase = np.zeros((len(frequencies), len(x)), np.uint64)
    for a in range(x.shape[1]):
        phase += frequencies[:, a].astype(np.uint64)[:, None] * turns[:, a]
    angle = 2 * np.pi * (phase.astype(np.int64) / 2.0**64)
    power: FloatArray = (np.cos(angle).sum(axis=1) ** 2 + np.sin(angle).sum(axis=1) ** 2) / len(x)
    return power


def numpy_turns(x: FloatArray, kind: type[np.unsignedinteger[Any]]) -> NDArray[Any]:
    """Coordinates as fixed-point turns, rounded to the nearest with ties to even.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    kind : {np.uint64, np.uint32}
        Of a turn, in units of 2^-64 or 2^-32.

    Returns
    -------
    (n, d) of that type
    """
    bits = 8 * np.dtype(kind).itemsize
    turns = [round(Fraction(value) * 2**bits) % 2**bits for value in x.ravel().tolist()]
    return np.array(turns, kind).reshape(x.shape)


def numpy_gradient(x: FloatArray, sigma: float) -> FloatArray:
    """Gradient of the energy on the torus, with the periodic images summed one by one.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    sigma : float
        Width of the kernel, in spacings.

    Returns
    -------
    (n, d) float64
        Derivatives by the points' coordinates in spacings.
    """
    n, d = x.shape
    side = 1 / spacing(n, d)
    images = np.arange(-np.ceil(9 * sigma / side) - 1, np.ceil(9 * sigma / side) + 2) * side
    u = ((x[:, None] - x[None]) * side)[..., None] + images
    gauss = np.exp(-(u**2) / (2 * sigma**2))
    value, slope = gauss.sum(axis=-1), (-u / sigma**2 * gauss).sum(axis=-1)
    others = [np.prod(np.delete(value, a, axis=-1), axis=-1) for a in range(d)]
    return np.stack([(slope[..., a] * others[a]).sum(axis=1) for a in range(d)], axis=1)


def numpy_box_gradient(x: FloatArray, sigma: float) -> FloatArray:
    """Gradient of the energy in a box: that of the pairs less the pull of a uniform density (Eq. 24-26).

    Parameters
    ----------
    x : (n, d) float64
        Points in the unit box.
    sigma : float
        Width of the kernel, in spacings.

    Returns
    -------
    (n, d) float64
        Derivatives by the points' coordinates in spacings.
    """
    n, d = x.shape
    side, root = 1 / spacing(n, d), np.sqrt(2) * sigma
    u = x * side
    apart = u[:, None] - u[None]
    pairs = np.exp(-(apart**2).sum(axis=-1) / (2 * sigma**2))
    within = sigma * np.sqrt(np.pi / 2) * (erf((side - u) / root) + erf(u / root))
    slope = np.exp(-((u / root) ** 2)) - np.exp(-(((side - u) / root) ** 2))
    pull = np.stack([slope[:, a] * np.prod(np.delete(within, a, axis=1), axis=1) for a in range(d)], axis=1)
    return np.asarray(-(pairs[..., None] * apart).sum(axis=1) / sigma**2 - pull)


def numpy_gaussians(x: FloatArray, centres: FloatArray, width: float) -> FloatArray:
    """Sum Gaussians over centres and over the images that count.

    Parameters
    ----------
    x : (n, d) float64
        Points of the unit torus.
    centres : (count, d) float64
        Likewise.
    width : float
        Box sides, at most 1/4.

    Returns
    -------
    (n,) float64
    """
    u = x[:, None] - centres
    images = np.sum([np.exp(-((u + j) ** 2) / (2 * width**2)) for j in range(-4, 5)], axis=0)
    total: FloatArray = images.prod(axis=-1).sum(axis=-1)
    return total


def numpy_waves(x: FloatArray, frequencies: NDArray[np.int64], phases: FloatArray) -> FloatArray:
    """Sum cosines of 2 pi (f.x + phase) over waves.

    Parameters
    ----------
    x : (n, d) float64
        Points of the unit torus.
    frequencies : (count, d) int64
        Cycles per unit length.
    phases : (count,) float64
        Turns.

    Returns
    -------
    (n,) float64
    """
    turns = x @ frequencies.T.astype(np.float64) + phases
    total: FloatArray = np.cos(2 * np.pi * (turns - np.rint(turns))).sum(axis=-1)
    return total


def numpy_pairs(x: FloatArray, bins: int, reach: float, sides: tuple[float, ...]) -> NDArray[np.int64]:
    """Count pairs by their distance on the torus.

    Parameters
    ----------
    x : (n, d) float64
        Points of the unit torus.
    bins : int
        Bins of equal width from 0 to reach.
    reach : float
        Longest distance, at most half the shortest side.
    sides : tuple of d floats
        Sides of the box.

    Returns
    -------
    (bins,) int64
    """
    i, j = np.triu_indices(len(x), 1)
    step = x[i] - x[j]
    distance = np.sqrt((((step - np.rint(step)) * sides) ** 2).sum(axis=-1))
    return np.histogram(distance, bins, (0, reach))[0].astype(np.int64)


def numpy_swap_fault(sites: FloatArray, offsets: FloatArray, samples: FloatArray) -> float:
    """How far sites with their samples are from where no swap of two samples pays (``ccvt``).

    Parameters
    ----------
    sites : (n, 2) float64
        Sites on the unit torus.
    offsets : (n, 2, capacity) float64
        Samples of each, from it.
    samples : (n * capacity, 2) float64
        All samples as they were given.

    Returns
    -------
    float
        Largest of: the distance of a given sample from all that are there; the distance of a site from the
        centroid of its samples; half of what a swap lowers the sum of squared distances by.
    """
    places = np.moveaxis(offsets, 1, 2) + sites[:, None]
    apart = places.reshape(-1, 1, 2) - samples
    apart -= np.rint(apart)
    lost = float(np.sqrt(np.sum(apart**2, axis=2).min(axis=0)).max())
    from_site = places[:, :, None] - sites
    from_site -= np.rint(from_site)
    squares = np.sum(from_site**2, axis=3)
    own = squares[np.arange(len(sites)), :, np.arange(len(sites))]
    gain = np.max(own[:, :, None] - squares, axis=1)  # of the sample of each site that gains most by another
    np.fill_diagonal(gain, 0.0)
    return max(lost, float(np.abs(offsets.mean(axis=2)).max()), float((gain + gain.T).max() / 2))
