"""Exact counts of pairs of points by their distance on the torus."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import double_device
from gbnbench.analysis.spatial.pair_counts_device import (
    LEAST_POINTS,
    ON_EDGE,
    SLACK,
    device_counts,
    row_windows,
)
from gbnbench.analysis.spatial.slabs import Progress
from gbnbench.core.errors import InputError
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray

# Pairs worked on at once in numpy: a few arrays of this many doubles stay in a core's cache.
BLOCK = 1 << 16
DEVICE_FROM = 256  # points from which a launch is worth its time


def pair_counts(
    x: FloatArray,
    bins: int,
    width: float,
    sides: Sides | None = None,
    progress: Progress | None = None,
) -> NDArray[np.int64]:
    """Unordered pairs of one set by toroidal distance.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    bins : int
        Equal bins from 0 on, closed on the left, distances that fall short of an edge by 1e-9 of a bin
        included; farther pairs are not counted.
    width : float
        Width of a bin, > 0; bins * width is half the shortest side at most.
    sides : tuple of d floats, optional
        Sides of volume 1, as ``as_sides`` returns them; a cube if not given.
    progress : callable, optional
        Called with the share done now and then, of large sets.

    Returns
    -------
    (bins,) int64
        Exact counts.

    Raises
    ------
    InputError
        If the bins reach beyond half the shortest side.

    Notes
    -----
    Points are cut in strips and sorted along another axis, so that only pairs within a window are examined,
    by the OpenCL device where there is one. Memory does not grow with their number, and on the device hardly
    with that of the points, whose windows are found a million at a time.
    """
    reach = bins * width
    box = (1.0,) * x.shape[1] if sides is None else sides
    if not 0 < reach <= 0.5 * min(box) * (1 + 1e-12):
        raise InputError(
            f"bins must end within (0, {0.5 * min(box):.6g}], where a ball fits the torus; got {reach!r}"
        )
    per_length = 1 / width
    if math.isclose(per_length, round(per_length), rel_tol=1e-12):
        per_length = round(per_length)  # so that a distance which is exactly an edge begins its bin
    device = double_device() if len(x) >= DEVICE_FROM else None
    windows = row_windows(x, reach, box) if device else None
    if device is None or windows is None:
        return _numpy_counts(x, bins, reach, per_length, box)
    counts, done = np.zeros(bins, np.int64), 0
    for some in windows:
        if len(some.rows):
            counts += device_counts(device, some, bins, per_length, box)
        done += len(some.rows)
        if progress is not None:
            progress(done / len(x))
    return counts


def _numpy_counts(
    x: FloatArray, bins: int, reach: float, per_length: float, box: tuple[float, ...]
) -> NDArray[np.int64]:
    """Count pairs in numpy, whatever their reach."""
    counts = np.zeros(bins + 1, dtype=np.int64)
    for rows, columns, drop in _windows(x, reach / box[0], reach / box[-1]):
        squared = np.zeros((len(rows), len(columns)))
        for axis, side in enumerate(box):
            step = rows[:, axis, None] - columns[None, :, axis]
            step -= np.rint(step)
            if side != 1.0:
                step *= side
            step *= step
            squared += step
        if drop is not None:
            squared[drop] = np.inf
        np.sqrt(squared, out=squared)
        squared *= per_length
        squared += ON_EDGE
        np.minimum(squared, bins, out=squared)
        counts += np.bincount(squared.astype(np.intp).ravel(), minlength=bins + 1)
    return counts[:bins]


def _windows(
    x: FloatArray, across: float, reach: float
) -> Iterator[tuple[FloatArray, FloatArray, NDArray[np.bool_] | None]]:
    """Blocks of rows against columns that together hold every near pair once; a mask marks repeats.

    The longest distance is a share ``across`` of the first side and ``reach`` of the last.
    """
    x = x[np.argsort(x[:, -1], kind="stable")]
    strips = min(int(1 / (across + SLACK)), len(x) // LEAST_POINTS) if x.shape[1] > 1 else 1
    if strips < 3:  # a strip must not meet its neighbour on both sides
        strips = 1
    label = np.minimum((x[:, 0] * strips).astype(np.intp), strips - 1)
    cells = [x[label == strip] for strip in range(strips)]
    for strip, cell in enumerate(cells):
        yield from _within(cell, reach)
        if strips > 1:
            yield from _between(cell, cells[(strip + 1) % strips], reach)


def _row_blocks(height: FloatArray, window: float) -> Iterator[tuple[int, int]]:
    """Ranges of rows such that a block against its window of columns holds about BLOCK pairs."""
    rows = max(1, BLOCK // max(int(len(height) * window), 32))
    for start in range(0, len(height), rows):
        yield start, min(start + rows, len(height))


def _within(
    cell: FloatArray, reach: float
) -> Iterator[tuple[FloatArray, FloatArray, NDArray[np.bool_] | None]]:
    """Pairs of one strip: each point with those after it, around the torus."""
    around = np.concatenate([cell, cell])
    height = np.concatenate([cell[:, -1], cell[:, -1] + 1])
    for start, stop in _row_blocks(cell[:, -1], reach):
        end = int(np.searchsorted(height, height[stop - 1] + reach + SLACK, side="right"))
        drop = np.arange(start + 1, end)[None, :] <= np.arange(start, stop)[:, None]
        if height[end - 1] - height[start] >= 0.5:  # the way back is shorter, and counted there
            drop |= height[None, start + 1 : end] - height[start:stop, None] >= 0.5
        yield cell[start:stop], around[start + 1 : end], drop


def _between(
    cell: FloatArray, other: FloatArray, reach: float
) -> Iterator[tuple[FloatArray, FloatArray, NDArray[np.bool_] | None]]:
    """Pairs of a point in one strip and a point in the next."""
    around = np.concatenate([other, other, other])
    height = np.concatenate([other[:, -1] - 1, other[:, -1], other[:, -1] + 1])
    for start, stop in _row_blocks(cell[:, -1], 2 * reach):
        low = int(np.searchsorted(height, cell[start, -1] - reach - SLACK, side="left"))
        high = int(np.searchsorted(height, cell[stop - 1, -1] + reach + SLACK, side="right"))
        yield cell[start:stop], other if high - low > len(other) else around[low:high], None
