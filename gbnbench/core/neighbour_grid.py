"""Points sorted by the width of their kernels and by cells, so that near ones are a few runs of the list."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

SIDE = 1.2  # of a cell, in widths of the widest kernel of its level


@dataclass(frozen=True)
class NeighbourGrid:
    """Points and their images, sorted by level, and by cells within a level.

    Attributes
    ----------
    places : (d, m) float64
        Positions, from the lower corner of the box that holds them all.
    variances : (m,) float64
        Of the kernels.
    targets : (n,) uint32
        Where the points themselves, not images of them, lie in the list.
    points : (n,) intp
        Which points these are.
    sides, widest : (levels,) float64
        Side of a level's cells, and its largest variance.
    counts : (levels, d) int32
        Cells along each axis.
    offsets : (levels,) uint32
        Where a level begins in ``starts``.
    starts : uint32
        First point of each cell, rows along the last axis, and one more at the end of each level.
    """

    places: FloatArray
    variances: FloatArray
    targets: NDArray[np.uint32]
    points: NDArray[np.intp]
    sides: FloatArray
    widest: FloatArray
    counts: NDArray[np.int32]
    offsets: NDArray[np.uint32]
    starts: NDArray[np.uint32]


def neighbour_grid(
    x: FloatArray, variances: FloatArray, reach: float, torus: tuple[int, ...] | None
) -> NeighbourGrid:
    """Sort points.

    Parameters
    ----------
    x : (n, d) float64
        Points, within the torus if there is one.
    variances : (n,) float64
        Of their kernels.
    reach : float
        Standard deviations of a sum of two kernels within which points are neighbours.
    torus : tuple of int or None
        Sides of the torus; None where there are no images.

    Returns
    -------
    NeighbourGrid
    """
    n, d = x.shape
    number = np.arange(n)
    if torus is not None:
        x, number = _with_images(x, variances, reach, torus)
    own = np.arange(len(x)) < n
    variances = variances[number]
    places = x - x.min(axis=0)
    level_of = np.floor(np.log2(variances / variances.min())).astype(np.int64)  # half an octave of width
    key = np.empty(len(x), np.int64)
    sides, widest, counts, offsets, offset = [], [], [], [], 0
    for m in range(int(level_of.max()) + 1):
        here = np.flatnonzero(level_of == m)
        if not len(here):
            continue
        most = float(variances[here].max())
        side = SIDE * math.sqrt(most)
        cells = (places[here] / side).astype(np.int64)
        count = (places.max(axis=0) / side).astype(np.int64) + 1
        at = cells[:, 0]
        for a in range(1, d):
            at = at * count[a] + cells[:, a]
        key[here] = offset + at
        sides.append(side)
        widest.append(most)
        counts.append(count)
        offsets.append(offset)
        offset += int(count.prod()) + 1
    order = np.argsort(key, kind="stable")
    starts = np.zeros(offset + 1, np.uint32)
    starts[1:] = np.bincount(key, minlength=offset).cumsum()
    targets = np.flatnonzero(own[order])
    return NeighbourGrid(
        np.ascontiguousarray(places[order].T),
        variances[order],
        targets.astype(np.uint32),
        number[order][targets],
        np.array(sides),
        np.array(widest),
        np.array(counts, np.int32),
        np.array(offsets, np.uint32),
        starts,
    )


def _with_images(
    x: FloatArray, variances: FloatArray, reach: float, torus: tuple[int, ...]
) -> tuple[FloatArray, NDArray[np.intp]]:
    """Add the images that are near enough to the torus to be anybody's neighbours."""
    far = reach * np.sqrt(variances + variances.max())
    number = np.arange(len(x))
    for a, side in enumerate(torus):
        parts, numbers = [x], [number]
        for shift in range(-math.ceil(far.max() / side), math.ceil(far.max() / side) + 1):
            moved = x[:, a] + shift * side
            near = (moved > -far[number]) & (moved < side + far[number])
            if shift and near.any():
                image = x[near]
                image[:, a] = moved[near]
                parts.append(image)
                numbers.append(number[near])
        x, number = np.concatenate(parts), np.concatenate(numbers)
    return x, number
