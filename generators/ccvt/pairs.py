"""Pairs of sites whose samples may profit from a swap, in groups that share no site."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.periodic_delaunay import with_images
from gbnbench.core.torus import FloatArray

Indices = NDArray[np.intp]


def touching_pairs(
    sites: FloatArray, radius: FloatArray, changed: NDArray[np.bool_]
) -> tuple[Indices, Indices, FloatArray]:
    """Find the pairs, at least one of them changed, whose bounding circles overlap.

    Parameters
    ----------
    sites : (n, 2) float64
        Sites on the unit torus.
    radius : (n,) float64
        Distance of the farthest sample of each.
    changed : (n,) bool
        Sites whose samples or place changed since their pairs were last looked at.

    Returns
    -------
    first, second : (pairs,) intp
        The sites; each pair once, or once for each image near enough.
    between : (pairs, 2) float64
        Vector from the first to the second.
    """
    from scipy.spatial import cKDTree

    widest = radius.max()
    tiled, owner = with_images(sites, min(1.0, 2 * widest * (1 + 1e-9)))
    start = np.flatnonzero(changed)
    near = cKDTree(tiled).query_ball_point(sites[start], radius[start] + widest)
    first = np.repeat(start, [len(each) for each in near])
    image = np.concatenate([np.array(each, dtype=np.intp) for each in near])
    second, between = owner[image], tiled[image] - sites[first]
    once = (first < second) | ((first != second) & ~changed[second])
    overlap = np.sum(between * between, axis=1) < (radius[first] + radius[second]) ** 2
    chosen = once & overlap
    return first[chosen], second[chosen], between[chosen]


def matchings(first: Indices, second: Indices, n: int, rng: np.random.Generator) -> Iterator[Indices]:
    """Part pairs into groups in which no site comes twice, in random order.

    Parameters
    ----------
    first, second : (pairs,) intp
        The sites of each pair.
    n : int
        Sites.
    rng : numpy.random.Generator
        Stream of the order.

    Yields
    ------
    (group,) intp
        Indices of pairs; every pair is in one group.
    """
    left = rng.permutation(len(first))
    earliest = np.empty(n, dtype=np.intp)
    while len(left):
        ends = np.stack([first[left], second[left]], axis=1)
        turn = np.arange(len(left))
        earliest[ends[::-1].ravel()] = np.repeat(
            turn[::-1], 2
        )  # the last that is written stays: the earliest
        chosen = (earliest[ends] == turn[:, None]).all(axis=1)
        yield left[chosen]
        left = left[~chosen]
