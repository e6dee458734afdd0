"""Power over shells of |f| without the cube: blocks of the two-group product, reduced on the device.

Each group's frequencies are sorted by |f|^2, so that those of a ball or a band are, for each row of one
group, a run of the other: only they are evaluated. Memory is that of a block, whatever the dimension.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.digits import Axes, size, whole_axes
from gbnbench.analysis.spectrum.error_model import Errors, coordinates
from gbnbench.analysis.spectrum.evaluators.cube_product import norms_of
from gbnbench.analysis.spectrum.evaluators.two_group_product import (
    Group,
    TwoGroupProduct,
    product_errors,
    rows_of,
)
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray

BLOCK_ROWS, BLOCK_COLUMNS = 510, 1024  # frequencies of a block's two groups: 17 MB of amplitudes
BIN_BYTES = 64 << 20  # of all strips' shells
STRIPS = 4  # a core

Progress = Callable[[float], None]


@dataclass(frozen=True)
class Moments:
    """Count, mean and spread of power on shells, over one half space.

    Attributes
    ----------
    square : (s,) int64
        |f|^2 of each shell that is not empty, ascending.
    count : (s,) int64
        Frequencies of the half space.
    mean : (s,) float64
        Of the power, averaged over sets before.
    deviation : (s,) float64
        Sum over the half space of (p - mean)^2.
    """

    square: NDArray[np.int64]
    count: NDArray[np.int64]
    mean: FloatArray
    deviation: FloatArray


@dataclass(frozen=True)
class SortedGroup:
    """Half space of a group within a ball, ascending in |f|^2.

    Attributes
    ----------
    axes : tuple of Axis
        Its axes.
    order : (count,) uint64
        Indices in base-(2F+1) digits.
    square : (count,) int64
        |f|^2 of each.
    """

    axes: Axes
    order: NDArray[np.uint64]
    square: NDArray[np.int64]


def sorted_group(axes: Axes, most: int) -> SortedGroup:
    """Half space of |f|^2 <= most, built up axis by axis so that nothing outside is ever listed.

    Raises
    ------
    RefusalError
        If the group's indices do not fit in 64 bits.
    """
    if size(axes) >= 1 << 63:
        raise RefusalError(
            f"a group of {len(axes)} axes has {float(size(axes)):.2g} frequencies, beyond 2^63"
        )
    index, square = np.zeros(1, np.int64), np.zeros(1, np.int64)
    for axis in axes:
        reach = min(axis.largest, math.isqrt(most))
        digit = np.arange(axis.largest - reach, axis.largest + reach + 1)
        total = square[:, None] + (digit - axis.largest) ** 2
        keep = total <= most
        index = (index[:, None] * axis.base + digit)[keep]
        square = total[keep]
    half = index >= size(axes) // 2
    index, square = index[half], square[half]
    order = np.lexsort((index, square))
    return SortedGroup(axes, index[order].astype(np.uint64), square[order])


def two_groups(d: int, fmax: int, most: int) -> tuple[SortedGroup, SortedGroup]:
    """Leading and trailing half of the axes, sorted."""
    axes = whole_axes(d, fmax)
    return sorted_group(axes[: d // 2], most), sorted_group(axes[d // 2 :], most)


def pairs(a: SortedGroup, b: SortedGroup, low: int, high: int) -> int:
    """Count pairs whose squares add up to low .. high: each stands for up to four frequencies."""
    start = np.searchsorted(b.square, low - a.square)
    end = np.searchsorted(b.square, high - a.square, side="right")
    return int(np.maximum(end - start, 0).sum())


def shell_moments(
    p: Precision,
    x: FloatArray,
    fmax: int,
    low: int,
    high: int,
    weights: FloatArray | None = None,
    progress: Progress | None = None,
) -> tuple[Moments, Errors]:
    """Moments of power on every shell low <= |f|^2 <= high of the cube |f_a| <= fmax.

    Parameters
    ----------
    p : Precision
        Where and how.
    x : (sets, n, d) float64
        Checked points.
    fmax : int
        Largest harmonic on each axis.
    low, high : int
        Of |f|^2; beyond fmax^2 shells are cut by the cube.
    weights : (sets or 1, n) float64, optional
        Of the points.
    progress : callable, optional
        Called with the share done.

    Returns
    -------
    moments : Moments
        Of the shells that hold a frequency; DC is left out.
    errors : Errors
        Of the square root of any frequency's power.
    """
    sets, n, d = x.shape
    at, rms, bound = coordinates(x, p.name, weights), 0.0, 0.0
    a, b = two_groups(d, fmax, high)
    bins = high - low + 1
    device = p.runtime.device
    strips = max(1, min(STRIPS * device.compute_units, BIN_BYTES // (24 * bins)))
    out = p.runtime.upload(np.zeros(strips * bins * 2, p.sum))
    counts = p.runtime.upload(np.zeros(strips * bins, np.uint32))
    norms = p.runtime.upload(norms_of(weights, sets, n).astype(p.sum))
    work, done = pairs(a, b, low, high), 0
    power = p.runtime.empty(2 * BLOCK_ROWS * BLOCK_COLUMNS * np.dtype(p.sum).itemsize)
    for rows, columns, bounds in blocks(a, b, low, high, rows_of(p)):
        leading, trailing = Group(a.axes, a.order[rows]), Group(b.axes, b.order[columns])
        product = TwoGroupProduct(p, n, d, sets, leading, trailing, bounds)
        limits = p.runtime.upload(bounds)
        errors = product_errors(p, n, product.slots, fmax, at)
        rms, bound = max(rms, errors.rms), max(bound, errors.bound)
        width = product.frequencies.columns
        each = 1 if p.runtime.group > 1 else width
        for first, batch in product.batches(x, weights):
            product.program.run(
                "pair_power",
                (-(-width // each), leading.count),
                (1, 1),
                product.amplitude,
                limits,
                np.uint32(leading.count),
                np.uint32(width),
                np.uint32(each),
                np.uint32(product.slots.splits),
                np.uint32(batch),
                norms,
                np.uint32(first),
                power,
            )
        p.program("shells.cl", ROWS=rows_of(p)).run(
            "shells",
            (strips,),
            (1,),
            power,
            limits,
            np.uint32(leading.count),
            np.uint32(width),
            p.runtime.upload(a.square[rows].astype(np.uint32)),
            p.runtime.upload(b.square[columns].astype(np.uint32)),
            np.uint32(low),
            np.uint32(high),
            p.sum(sets),
            out,
            counts,
        )
        p.runtime.finish()
        if progress is not None:
            done += int((bounds[:, 1] - bounds[:, 0]).sum()) * rows_of(p)
            progress(min(done / work, 1.0))
    parts = p.runtime.download(out, np.empty((strips, bins, 2), p.sum)).astype(np.float64)
    count = p.runtime.download(counts, np.empty((strips, bins), np.uint32))
    return merged(count.astype(np.int64), parts[..., 0], parts[..., 1], low), Errors(rms, bound)


def blocks(
    a: SortedGroup, b: SortedGroup, low: int, high: int, rows: int
) -> Iterator[tuple[slice, slice, NDArray[np.uint32]]]:
    """Blocks that hold pairs of the band: rows, columns, and of each row tile the columns wanted."""
    for i in range(0, len(a.order), BLOCK_ROWS):
        squares = a.square[i : i + BLOCK_ROWS]
        nearest = squares[::rows]
        farthest = squares[np.minimum(np.arange(rows - 1, len(squares) + rows - 1, rows), len(squares) - 1)]
        start = np.searchsorted(b.square, low - farthest)
        end = np.searchsorted(b.square, high - nearest, side="right")
        for j in range(0, len(b.order), BLOCK_COLUMNS):
            stop = min(j + BLOCK_COLUMNS, len(b.order))
            bounds = np.stack([np.clip(start, j, stop), np.clip(end, j, stop)], axis=1) - j
            bounds[:, 1] = np.maximum(bounds[:, 1], bounds[:, 0])
            if (bounds[:, 1] > bounds[:, 0]).any():
                yield slice(i, i + BLOCK_ROWS), slice(j, stop), bounds.astype(np.uint32)


def merged(count: NDArray[np.int64], mean: FloatArray, deviation: FloatArray, low: int) -> Moments:
    """Merge strips' counts, means and departures, each (strips, bins), shell by shell (Chan et al. 1979)."""
    total = count.sum(axis=0)
    held = total > 0
    count, mean, deviation, total = count[:, held], mean[:, held], deviation[:, held], total[held]
    middle = (count * mean).sum(axis=0) / total
    spread = deviation.sum(axis=0) + (count * (mean - middle) ** 2).sum(axis=0)
    return Moments(low + np.flatnonzero(held), total, middle, spread)
