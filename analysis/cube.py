"""Power at every frequency of a cube, or of the half of it with f_0 >= 0, by the two-group product."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.analysis.accuracy import Errors, coordinates
from gbnbench.analysis.digits import Division, cheapest_division, half_size, size
from gbnbench.analysis.precision import Precision
from gbnbench.analysis.two_group import Group, TwoGroupProduct, product_errors, rows_of
from gbnbench.torus import FloatArray

AMPLITUDE_BYTES = 256 << 20  # of the rows that one pass over the points takes
GPU_COLUMNS = 64  # frequencies of a row that one work-item of a GPU turns into power


def cube_powers(
    p: Precision,
    x: FloatArray,
    fmax: int,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
) -> tuple[FloatArray, Errors]:
    """Power at all |f_a| <= fmax.

    Parameters
    ----------
    p : Precision
        Where and how.
    x : (sets, n, d) float64
        Checked points.
    fmax : int
        Largest harmonic on each axis.
    weights : (sets or 1, n) float64, optional
        Of the points; power is over the sum of their squares.
    half : bool
        Only f_0 >= 0.
    mean : bool
        Average over sets; otherwise each.

    Returns
    -------
    power : (2*fmax+1,)*d float64
        The first axis only fmax+1 long where half; preceded by an axis of sets unless mean.
    errors : Errors
        Of the square root of any of them.
    """
    sets, n, d = x.shape
    divided = cheapest_division(d, fmax, rows_of(p))
    shape = covered(divided, d)
    start = shape[0] // 2 * math.prod(shape[1:]) if half else 0
    count = math.prod(shape) - start
    out = p.runtime.empty(count * (1 if mean else sets) * np.dtype(p.sum).itemsize)
    norms = p.runtime.upload(norms_of(weights, sets, n).astype(p.sum))
    bound = rms = 0.0
    at = coordinates(x, p.name, weights)
    for first_row, rows in row_blocks(p, divided):
        product = TwoGroupProduct(p, n, d, sets, rows, Group(divided.trailing))
        columns = product.b.count
        each = GPU_COLUMNS if p.runtime.group > 1 else columns
        for first, batch in product.batches(x, weights):
            product.program.run(
                "cube_power",
                (-(-columns // each), rows.count),
                (1, 1),
                product.amplitude,
                np.uint32(half_size(divided.leading)),
                np.uint32(first_row),
                np.uint32(rows.count),
                np.uint32(columns),
                np.uint32(product.columns),
                np.uint32(each),
                np.uint32(product.slots.splits),
                np.uint32(batch),
                norms,
                np.uint32(first),
                out,
                np.uint64(start),
                np.uint64(0 if mean else count),
            )
        errors = product_errors(p, n, product.slots, fmax, at)
        rms, bound = max(rms, errors.rms), max(bound, errors.bound)
    if half:
        shape = (shape[0] - shape[0] // 2, *shape[1:])
    power = p.runtime.download(out, np.empty((1 if mean else sets, *shape), p.sum))
    inner = tuple(
        slice(0, fmax + 1) if half and a == 0 else slice(have // 2 - fmax, have // 2 + fmax + 1)
        for a, have in enumerate(shape)
    )
    power = np.ascontiguousarray(power[(slice(None), *inner)], np.float64)
    if not mean:
        return power, Errors(rms, bound)
    if sets > 1:
        power /= sets
    return power[0], Errors(rms, bound)


def row_blocks(p: Precision, divided: Division) -> Iterator[tuple[int, Group]]:
    """Yield the leading frequencies whole, or in runs whose amplitudes are not too many: first, group."""
    total, columns = half_size(divided.leading), half_size(divided.trailing)
    most = max(
        rows_of(p), AMPLITUDE_BYTES // (8 * np.dtype(p.sum).itemsize * columns) // rows_of(p) * rows_of(p)
    )
    if total <= most:
        yield 0, Group(divided.leading)
        return
    centre = size(divided.leading) // 2
    for first in range(0, total, most):
        order = np.arange(centre + first, centre + min(first + most, total), dtype=np.uint64)
        yield first, Group(divided.leading, order)


def covered(divided: Division, d: int) -> tuple[int, ...]:
    """Frequencies on each axis that the two groups' sums cover: 2*fmax+1, or a few more on one."""
    shape = [1] * d
    for axis in (*divided.leading, *divided.trailing):
        shape[axis.coordinate] *= axis.base
    return tuple(shape)


def norms_of(weights: FloatArray | None, sets: int, n: int) -> FloatArray:
    """Sum of squared weights of each set: (sets,) float64; n where there are no weights."""
    if weights is None:
        return np.full(sets, float(n))
    return np.broadcast_to((weights**2).sum(axis=1), (sets,)).astype(np.float64)
