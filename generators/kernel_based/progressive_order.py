"""Orders of a point set all of whose prefixes are evenly spread: void-and-cluster ranks of given points."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, check_points
from gbnbench.generators.kernel_based.local_gaussians import LocalGaussians

SWEEPS = 20  # over the chosen points, of exchanges with points left out
LEAST_GAIN = 1e-9


def progressive_order(
    x: ArrayLike, sigma: float = 1.0, told: Callable[[float], None] | None = None
) -> NDArray[np.intp]:
    """Order points so that every prefix is spread as evenly as a choice among them can be.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    sigma : float
        Width of the Gaussian on the points of a prefix, in spacings of that prefix, 0.2 to 2.
    told : callable, optional
        Takes the share of the work that is done, 0 to 1, after each halving.

    Returns
    -------
    (n,) intp
        Indices of the points, first to last: ``x[order[:m]]`` is the prefix of m points.

    Raises
    ------
    InputError
        If x is no single set of points of the torus, or sigma out of its range.

    Notes
    -----
    Of the set half is kept, of the half a quarter, and so on, each time by taking out the tightest clusters
    (Ulichney 1993) and then by exchanging a kept point with one left out where that lowers the sum over pairs
    of Gaussians, until no exchange does. What lies between two halvings comes in the order of largest voids.
    A Gaussian is taken to be nothing beyond 7.5 of its widths. Where Gaussians reach most points, as in many
    dimensions, the cost is n**2.

    Examples
    --------
    >>> order = progressive_order([[0.0], [0.01], [0.25], [0.5], [0.75], [0.76], [0.87]])
    >>> bool(abs(order[0] - order[1]) > 1)
    True
    """
    points = check_points(x)
    if points.ndim != 2:
        raise InputError(f"x must be one set, (n, d); got shape {points.shape}")
    if not 0.2 <= sigma <= 2:
        raise InputError(f"sigma must be 0.2 to 2 spacings; got {sigma}")
    n, d = points.shape
    kept = np.arange(n)
    tail: list[NDArray[np.intp]] = []
    while len(kept) > 1:
        size = len(kept) // 2
        inside = _half(points[kept], size, sigma * size ** (-1 / d))
        middle = sigma * (math.sqrt(2) * size) ** (-1 / d)
        tail.insert(0, kept[_by_voids(points[kept], inside, middle)])
        kept = kept[inside]
        if told is not None:
            told(1 - (len(kept) / n) ** 2)
    return np.concatenate([kept, *tail])


def prefix_noise_floors(x: ArrayLike, sizes: Sequence[int]) -> FloatArray:
    """Measure the noise floors of prefixes of an ordered set: the mean of P over 0 < nu <= 0.25.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus, in order.
    sizes : sequence of int
        Lengths of the prefixes, 1 to n.

    Returns
    -------
    (len(sizes),) float64
        nan where a prefix is too small to have a frequency in the band.

    Raises
    ------
    InputError
        If x is no single set, or a size out of its range.

    Examples
    --------
    >>> prefix_noise_floors(np.arange(32)[:, None] / 32, [32]) < 1e-20
    array([ True])
    """
    points = check_points(x)
    if points.ndim != 2:
        raise InputError(f"x must be one set, (n, d); got shape {points.shape}")
    n, d = points.shape
    floors = np.full(len(sizes), np.nan)
    for k, size in enumerate(sizes):
        if not 1 <= size <= n:
            raise InputError(f"sizes must be 1 to {n}; got {size}")
        edge = 0.25 * size ** (1 / d)
        reach = np.arange(-math.floor(edge), math.floor(edge) + 1)
        f = np.stack(np.meshgrid(*[reach] * d, indexing="ij"), axis=-1).reshape(-1, d)
        square = np.sum(f**2, axis=1)
        f = f[(square > 0) & (square <= edge**2)]
        if len(f):
            waves = np.exp(-2j * math.pi * (points[:size] @ f.T))
            floors[k] = np.mean(np.abs(waves.sum(axis=0)) ** 2) / size
    return floors


def _half(x: FloatArray, size: int, width: float) -> NDArray[np.bool_]:
    """Choose so many points with a small sum over pairs of Gaussians."""
    inside, gaussians = np.ones(len(x), bool), LocalGaussians(x, width)
    energy = gaussians.sums(np.arange(len(x)))
    clusters = energy.copy()  # the energy of those inside, -inf of others
    for _ in range(len(x) - size):
        cluster = int(clusters.argmax())
        inside[cluster] = False
        near, gaussian = gaussians.of(cluster)
        energy[near] -= gaussian
        clusters[near] -= gaussian
        clusters[cluster] = -np.inf
    own = gaussians.own
    voids = np.where(inside, np.inf, energy)
    for _ in range(SWEEPS):
        exchanged = 0
        for index in np.flatnonzero(inside):
            near, gaussian = gaussians.of(int(index))
            without = voids.copy()
            without[near] -= gaussian
            void = int(without.argmin())
            if without[void] < energy[index] - own - LEAST_GAIN:
                inside[index], inside[void] = False, True
                energy[near] -= gaussian
                added, there = gaussians.of(void)
                energy[added] += there
                voids = np.where(inside, np.inf, energy)
                exchanged += 1
        if not exchanged:
            break
    return inside


def _by_voids(x: FloatArray, inside: NDArray[np.bool_], width: float) -> NDArray[np.intp]:
    """Order the points left out, each the largest void of those inside and before it."""
    gaussians = LocalGaussians(x, width)
    energy = gaussians.sums(np.flatnonzero(inside))
    energy[inside] = np.inf
    order = []
    for _ in range(int(np.count_nonzero(~inside))):
        void = int(energy.argmin())
        order.append(void)
        near, gaussian = gaussians.of(void)
        energy[near] += gaussian
        energy[void] = np.inf
    return np.array(order, np.intp)
