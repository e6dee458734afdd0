"""Islands of ink in white: parts of a density that nowhere meet, and how many points each of them gets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density

LEAST = 1.0  # points' mass of an island; what has less belongs to the nearest one that has it


@dataclass(frozen=True)
class Island:
    """A part of a density with white around it.

    Attributes
    ----------
    density : Density
        Its own part alone, cut out: a bounded density, also on the torus, where parts that take more than
        half of a side are not cut out.
    n : int
        Its points.
    corner : (2,) float64
        Pixel of the whole in which its first pixel lies; on the torus it may reach over the borders.
    """

    density: Density
    n: int
    corner: FloatArray


def islands(density: Density, n: int) -> list[Island]:
    """Part a density into islands.

    Parameters
    ----------
    density : Density
        Of an image.
    n : int
        Points in all.

    Returns
    -------
    list of Island
        Their points add up to n: as many whole ones as the mass of each holds, and the rest to those that
        have the largest remainders. Where all ink hangs together, one that is the density itself.

    Notes
    -----
    Pixels that share a side or a corner hang together. An island of less than one point's mass belongs to the
    nearest that has as much, and where none has, all are one.
    """
    label, count = _labelled(density)
    shares = _shares(density, label, count, n)
    if count > 1 and shares.min() < LEAST <= shares.max():
        label, count = _joined(density, label, np.nonzero(shares >= LEAST)[0] + 1)
        shares = _shares(density, label, count, n)
    if count == 1 or shares.max() < LEAST:
        return [Island(density, n, np.zeros(2))]
    return [
        _cut_out(density, label == k, points) for k, points in enumerate(_apportioned(shares, n).tolist(), 1)
    ]


def _shares(density: Density, label: NDArray[np.intp], count: int, n: int) -> FloatArray:
    """Points' masses of islands 1 to count."""
    mass = np.bincount(label.ravel(), density.values.ravel(), count + 1)[1:]
    return np.asarray(n * mass / mass.sum(), np.float64)


def _apportioned(shares: FloatArray, n: int) -> NDArray[np.intp]:
    """Round shares to whole numbers that add up to n, by the largest remainders."""
    counts = np.floor(shares).astype(np.intp)
    left = n - int(counts.sum())
    counts[np.argsort(counts - shares, kind="stable")[:left]] += 1
    return counts


def _labelled(density: Density) -> tuple[NDArray[np.intp], int]:
    """Give each part of the ink that hangs together a number, from 1; 0 is white."""
    from scipy import ndimage
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ink = density.values > 0
    if not density.toroidal:
        label, count = ndimage.label(ink, np.ones((3, 3)))
        return label.astype(np.intp), int(count)
    label, count = ndimage.label(np.pad(ink, 1, mode="wrap"), np.ones((3, 3)))
    # A pixel of the rim is one from the opposite border: both numbers are of one island.
    own = np.pad(label[1:-1, 1:-1], 1, mode="wrap")
    meeting = coo_array((np.ones(own.size), (own.ravel(), label.ravel())), shape=(count + 1, count + 1))
    parts, part = connected_components(meeting, directed=False)
    order = np.empty(parts, np.intp)
    order[part[0]] = 0
    order[np.setdiff1d(np.arange(parts), part[:1])] = np.arange(1, parts)
    return order[part[label[1:-1, 1:-1]]], parts - 1


def _joined(
    density: Density, label: NDArray[np.intp], large: NDArray[np.intp]
) -> tuple[NDArray[np.intp], int]:
    """Give every pixel of ink to the nearest large island, and number these from 1."""
    from scipy import ndimage

    number = np.zeros(int(label.max()) + 1, np.intp)
    number[large] = np.arange(1, len(large) + 1)
    known = number[label]
    half = [(size // 2, size // 2) if density.toroidal else (0, 0) for size in density.shape]
    around = np.pad(known, half, mode="wrap")
    nearest = ndimage.distance_transform_edt(around == 0, return_distances=False, return_indices=True)
    inner = tuple(slice(low, low + size) for (low, _), size in zip(half, density.shape, strict=True))
    owner = around[tuple(nearest)][inner]
    return np.where(density.values > 0, owner, 0), len(large)


def _cut_out(density: Density, own: NDArray[np.bool_], n: int) -> Island:
    """Take an island by itself; on the torus as it is where it takes more than half of a side."""
    values = np.where(own, density.values, 0.0)
    spans = [_span(np.asarray(own.any(axis=1 - a)), toroidal=density.toroidal) for a in range(2)]
    if density.toroidal and any(2 * size > side for (_, size), side in zip(spans, own.shape, strict=True)):
        return Island(Density(values, toroidal=True), n, np.zeros(2))
    (row, rows), (column, columns) = spans
    box = np.roll(values, (-row, -column), axis=(0, 1))[:rows, :columns]
    return Island(Density(np.ascontiguousarray(box)), n, np.array([row, column], np.float64))


def _span(line: NDArray[np.bool_], *, toroidal: bool) -> tuple[int, int]:
    """First place of a line that is used and how many it takes to hold all, on the torus over its end."""
    used = np.nonzero(line)[0]
    if not toroidal:
        return int(used[0]), int(used[-1] - used[0] + 1)
    gaps = np.diff(used, append=used[0] + len(line))
    widest = int(np.argmax(gaps))
    return int(used[(widest + 1) % len(used)]), int(len(line) - gaps[widest] + 1)
