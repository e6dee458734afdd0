"""Pairs of sites whose samples may profit from a swap, in groups that share no site."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.periodic_delaunay import with_images
from gbnbench.core.torus import FloatArray

Indices = NDArray[np.intp]
CLASSES = 4  # of radii in a factor of 2


@dataclass(frozen=True)
class Pairs:
    """Pairs of sites, ordered by group; no site comes twice in a group.

    Attributes
    ----------
    first, second : (pairs,) intp
        The sites; each pair once, or once for each image near enough.
    between : (pairs, 2) float64
        Vector from the first to the second.
    group : (pairs,) intp
        Ascending, from 0.
    """

    first: Indices
    second: Indices
    between: FloatArray
    group: Indices


def touching_pairs(sites: FloatArray, radius: FloatArray) -> Pairs:
    """Find the pairs of sites whose bounding circles overlap.

    Parameters
    ----------
    sites : (n, 2) float64
        Sites on the unit torus.
    radius : (n,) float64
        Of the circle about each.

    Returns
    -------
    Pairs
        Each in the first group that has neither of its sites yet.
    """
    from scipy.spatial import cKDTree

    tiled, owner = with_images(sites, min(1.0, 2 * radius.max() * (1 + 1e-9)))
    tree = cKDTree(tiled)
    # Whose circle is the wider one looks for the others: then a few wide circles do not make all look far.
    size = np.ceil(CLASSES * np.log2(np.maximum(radius, 1e-12)))
    found = []
    for exponent in np.unique(size):
        own = np.flatnonzero(size == exponent)
        near = cKDTree(sites[own]).sparse_distance_matrix(
            tree, 2 * 2 ** (exponent / CLASSES) * (1 + 1e-9), output_type="ndarray"
        )
        found.append(np.stack([own[near["i"]], near["j"]]))
    first, image = np.concatenate(found, axis=1)
    second, between = owner[image], tiled[image] - sites[first]
    wider = (radius[first] > radius[second]) | ((radius[first] == radius[second]) & (first < second))
    overlap = np.sum(between * between, axis=1) < (radius[first] + radius[second]) ** 2
    chosen = np.flatnonzero(wider & overlap & (first != second))
    group = first_free_groups(first[chosen], second[chosen], len(sites))
    order = np.argsort(group, kind="stable")
    chosen = chosen[order]
    return Pairs(first[chosen], second[chosen], between[chosen], group[order])


def first_free_groups(first: Indices, second: Indices, n: int) -> Indices:
    """Part pairs into groups in which no site comes twice.

    Parameters
    ----------
    first, second : (pairs,) intp
        The sites of each pair.
    n : int
        Sites.

    Returns
    -------
    (pairs,) intp
        The first group, from 0, that has neither site from an earlier pair.
    """
    taken = [0] * n  # groups of each site so far, one a bit
    group = np.empty(len(first), dtype=np.intp)
    for k, (a, b) in enumerate(zip(first.tolist(), second.tolist(), strict=True)):
        free = ~(taken[a] | taken[b])
        bit = free & -free
        taken[a] |= bit
        taken[b] |= bit
        group[k] = bit.bit_length() - 1
    return group
