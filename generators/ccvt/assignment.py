"""Samples of the torus shared out among sites, so many to each (Balzer, Schlömer & Deussen 2009)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray, wrap

GOLDEN = (math.sqrt(5) - 1) / 2


def sample_lattice(count: int, rng: np.random.Generator) -> FloatArray:
    """Return a lattice of so many samples, whatever their number, at a random shift.

    Parameters
    ----------
    count : int
        Samples.
    rng : numpy.random.Generator
        Stream of the shift.

    Returns
    -------
    (count, 2) float64
        (i / count, i g / count) on the torus, g / count being next to the golden section: nearly as even as
        a square grid, which exists for square numbers alone.
    """
    i = np.arange(count, dtype=np.int64)
    step = round(count * GOLDEN)
    return wrap(np.stack([i, i * step % count], axis=1) / count + rng.random(2))


def short_basis(count: int) -> FloatArray:
    """Return two shortest vectors that span a lattice of ``sample_lattice`` (Lagrange's reduction).

    Parameters
    ----------
    count : int
        Samples of the lattice.

    Returns
    -------
    (2, 2) float64
        The vectors, one a row.
    """
    a, b = np.array([1.0, round(count * GOLDEN)]) / count, np.array([0.0, 1.0])
    while True:
        if a @ a > b @ b:
            a, b = b, a
        step = np.rint(a @ b / (a @ a))
        if step == 0:
            return np.stack([a, b])
        b = b - step * a


def split(offsets: FloatArray, basis: FloatArray) -> FloatArray:
    """Put four samples in the place of each sample of a lattice, such that they are a lattice again.

    Parameters
    ----------
    offsets : (n, 2, capacity) float64
        Samples from their sites: x, then y.
    basis : (2, 2) float64
        Vectors that span the lattice; half of each spans the new one.

    Returns
    -------
    (n, 2, 4 capacity) float64
        The mean of each four is the sample that they stand for: it and a quarter of either vector, with
        either sign.
    """
    a, b = basis / 4
    shifts = np.stack([a + b, a - b, b - a, -a - b], axis=1)
    fine = offsets[:, :, :, None] + shifts[:, None, :]
    return np.asarray(fine.reshape(len(offsets), 2, -1))


def share_out(sites: FloatArray, samples: FloatArray, rng: np.random.Generator) -> NDArray[np.intp]:
    """Give each site as many samples as every other, in random order each to the nearest that has room.

    Parameters
    ----------
    sites : (n, 2) float64
        Sites on the unit torus.
    samples : (n * capacity, 2) float64
        Samples on the unit torus.
    rng : numpy.random.Generator
        Stream of the order.

    Returns
    -------
    (n, capacity) intp
        Indices of the samples of each site.
    """
    from scipy.spatial import cKDTree

    n, capacity = len(sites), len(samples) // len(sites)
    given = np.empty((n, capacity), dtype=np.intp)
    full = np.zeros(n, dtype=np.intp)
    left = rng.permutation(len(samples))
    while len(left):  # each round fills at least one site
        free = np.flatnonzero(full < capacity)
        nearest = free[cKDTree(sites[free], boxsize=np.ones(2)).query(samples[left])[1]]
        order = np.argsort(nearest, kind="stable")
        nearest, left = nearest[order], left[order]
        place = np.arange(len(left)) - np.searchsorted(nearest, nearest) + full[nearest]
        fits = place < capacity
        given[nearest[fits], place[fits]] = left[fits]
        full += np.bincount(nearest[fits], minlength=n)
        left = rng.permutation(left[~fits])
    return given
