"""Counts of pairs by their distance on an OpenCL device, from windows that hold every near pair once."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.core.torus import FloatArray

# A distance that falls short of an edge by this part of a bin lies on it, but for the coordinates' rounding:
# every distance of a grid of 100 x 100 points is an edge of PSA's bins, and few are rounded upwards.
ON_EDGE = 1e-9
# Windows are wider than the longest distance by this much, so that rounding loses no pair.
SLACK = 1e-12
STRIPS = 4  # strips that the longest distance spans
LEAST_POINTS = 8  # of a strip, so that there are not too many
ITEMS, ITEMS_OF_GPU = 16, 4096  # work-items, each with counts of its own
COUNTS = 1 << 26  # bytes of all their counts, at most
WHOLE = 1.5 * 2.0**52  # a double's spacing there is 1
ROWS = 1 << 20  # points whose windows are found together, so that memory does not grow with n
MOST_COUNT = 1 << 32  # beyond which a count would overflow


@dataclass(frozen=True)
class RowWindows:
    """For each point the ranges of columns that hold its near ones.

    Attributes
    ----------
    rows : (n, d) float64
        Points, sorted by strip and within it along the last axis.
    columns : (2 m, d) float64
        The points of each strip that they meet twice, so that a range may lead around the torus.
    ends : (2 ranges, n) uint32
        Begin and end of each range of each row.
    """

    rows: FloatArray
    columns: FloatArray
    ends: NDArray[np.uint32]


def row_windows(
    x: FloatArray, reach: float, box: tuple[float, ...], rows: int = ROWS
) -> Iterator[RowWindows] | None:
    """Find ranges of columns that together hold every pair within reach once.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    reach : float
        Longest distance.
    box : tuple of d floats
        Sides, of which ``x`` are shares.
    rows : int
        Points whose windows are found together, unless a single strip has more.

    Returns
    -------
    iterator of RowWindows, or None
        Of all points, some strips after others. None where the plane cannot be cut: in one dimension, and
        where the reach is nearly half a side.

    Notes
    -----
    Strips lie across the first axis. A point meets those that come after it in its own strip, and those of
    the next strips on one side whose last coordinate differs by no more than the reach leaves, after the way
    to the strip.
    """
    n, d = x.shape
    across, along = reach / box[0], reach / box[-1]
    strips = max(2 * STRIPS + 1, min(int(STRIPS / (across + SLACK)), n // LEAST_POINTS))
    spanned = math.ceil(across * strips + SLACK * strips)
    if d == 1 or strips < 2 * spanned + 1 or along + SLACK >= 0.5:
        return None
    return _strip_windows(x, reach, box, _Strips(strips, spanned), rows)


@dataclass(frozen=True)
class _Strips:
    """Strips across the first axis, and how many of them the longest distance spans."""

    count: int
    spanned: int


def _strip_windows(
    x: FloatArray, reach: float, box: tuple[float, ...], strips: _Strips, most: int
) -> Iterator[RowWindows]:
    """Find the windows of as many strips together as hold so many points."""
    label = np.empty(len(x), np.int32)
    for begin in range(0, len(x), ROWS):
        across = x[begin : begin + ROWS, 0]
        label[begin : begin + ROWS] = np.minimum((across * strips.count).astype(np.intp), strips.count - 1)
    before = np.concatenate([[0], np.cumsum(np.bincount(label, minlength=strips.count))])
    last = 0
    while last < strips.count:
        first = last
        last = max(first + 1, int(np.searchsorted(before, before[first] + most, side="right")) - 1)
        own = last - first
        end = first + own + strips.spanned
        if own + strips.spanned >= strips.count:
            order = np.lexsort((x[:, -1], label))
            numbered = label[order].astype(np.intp)
            yield _windows_of(x[order], numbered, (first, first + own), 0, reach, box, strips)
            continue
        wanted = np.flatnonzero(((label >= first) & (label < end)) | (label < end - strips.count))
        some, numbered = x[wanted], ((label[wanted] - first) % strips.count).astype(np.intp)
        order = np.lexsort((some[:, -1], numbered))
        yield _windows_of(some[order], numbered[order], (0, own), first, reach, box, strips)


def _windows_of(
    rows: FloatArray,
    label: NDArray[np.intp],
    own: tuple[int, int],
    turn: int,
    reach: float,
    box: tuple[float, ...],
    strips: _Strips,
) -> RowWindows:
    """Find the windows of sorted points in the strips ``own``, whose labels are less by ``turn``."""
    along, count = reach / box[-1], strips.count
    starts = np.searchsorted(label, np.arange(count + 1))
    cells = [rows[begin:end] for begin, end in pairwise(starts)]
    heights = [np.concatenate([cell[:, -1], cell[:, -1] + 1]) for cell in cells]
    own_rows = rows[starts[own[0]] : starts[own[1]]]
    ends = np.zeros((2 * (strips.spanned + 1), len(own_rows)), np.uint32)
    for strip in range(*own):
        cell = cells[strip]
        here = slice(starts[strip] - starts[own[0]], starts[strip + 1] - starts[own[0]])
        at = cell[:, -1]
        ends[0, here] = np.arange(1, len(cell) + 1)
        ends[1, here] = np.searchsorted(heights[strip], at + along + SLACK, side="right")
        ends[:2, here] += np.uint32(2 * starts[strip])
        for k in range(1, strips.spanned + 1):
            other = (strip + k) % count
            way = np.maximum((strip + turn + k) / count - cell[:, 0] - SLACK, 0.0) * box[0]
            left = np.sqrt(np.maximum(reach**2 - way**2, 0.0)) / box[-1] + SLACK
            around = at < left  # the range begins before 0, and is looked for one turn later
            low = np.searchsorted(heights[other], at - left + around, side="left")
            high = np.searchsorted(heights[other], at + left + around, side="right")
            high = np.where(way > reach, low, np.minimum(high, low + len(cells[other])))
            ends[2 * k, here] = 2 * starts[other] + low
            ends[2 * k + 1, here] = 2 * starts[other] + high
    columns = np.concatenate([part for cell in cells for part in (cell, cell)])
    return RowWindows(own_rows, columns, ends)


def device_counts(
    device: Precision, windows: RowWindows, bins: int, per_length: float, box: tuple[float, ...]
) -> NDArray[np.int64]:
    """Count the pairs of windows by their distance.

    Parameters
    ----------
    device : Precision
        Double precision on the device.
    windows : RowWindows
        As ``row_windows`` finds them.
    bins : int
        Bins from 0 on; farther pairs are not counted.
    per_length : float
        Bins a unit of length.
    box : tuple of d floats
        Sides.

    Returns
    -------
    (bins,) int64
        Exact counts.
    """
    n, d = windows.rows.shape
    runtime = device.runtime
    most = min(n, COUNTS // (4 * (bins + 1)))
    items = max(1, min(most, ITEMS if runtime.device.is_cpu else ITEMS_OF_GPU))
    met = (windows.ends[1::2] - windows.ends[::2]).sum(axis=0, dtype=np.int64)  # columns that a row meets
    items = max(items, -(-n * int(met.max(initial=0)) // (MOST_COUNT - 1)))  # so that no count overflows
    columns = np.zeros((d, len(windows.columns) + device.lanes))
    columns[:, : len(windows.columns)] = windows.columns.T
    counts = runtime.empty(4 * items * (bins + 1))
    device.program("pair_distances.cl", DIM=d, WHOLE=repr(WHOLE)).run(
        "pair_distances",
        (items,),
        (1,),
        *(runtime.upload(array) for array in (windows.rows.T, columns, np.array(box), windows.ends)),
        *(np.uint32(n), np.uint32(columns.shape[1]), np.uint32(len(windows.ends) // 2)),
        *(np.uint32(-(-n // items)), np.float64(per_length), np.float64(ON_EDGE), np.uint32(bins), counts),
    )
    found = runtime.download(counts, np.empty((items, bins + 1), np.uint32))
    return np.asarray(found[:, :bins].sum(axis=0, dtype=np.int64))
