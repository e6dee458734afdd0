"""Squares of the L2 discrepancies in any dimension, as sums of a centred kernel over all pairs of points."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from gbnbench.analysis.precision import Precision, double_device, padded
from gbnbench.analysis.spatial.discrepancy_kernels import Form, ProductKernel
from gbnbench.core.double_double import two_product
from gbnbench.core.torus import FloatArray

COLUMNS = 2048  # of a block; rows come in blocks of as many
CHUNK = 32  # terms that are added up plainly before the rounding of their sum is kept
SUM_UNITS = 48  # error of a block's sum in units of 2^-53 of its terms, by which no order of them is worse
ROWS = 64  # rows of a block that numpy takes at once


def pair_squares(x: FloatArray, kernel: ProductKernel) -> tuple[float, float]:
    """Square of a discrepancy, and the bound of its error.

    Parameters
    ----------
    x : (n, d) float64
        Points in [0, 1)^d.
    kernel : ProductKernel
        Kernel of the discrepancy.

    Returns
    -------
    square, error : float
        The square may be negative where it is smaller than the error.

    Notes
    -----
    The sum over pairs of K(x_i, x_j) - H(x_i) is made of small terms of both signs, in blocks; what it
    lacks, -n sum H + n^2 C, is added in double-double. A block of rows meets the blocks of columns from its
    own on, and the sums beyond its own count twice. All blocks are added exactly.

    The error holds for every set: a factor's rounding in every term, and that of each block's sum, taken in
    the worst way at once. They add up in most sets to a thousandth of it.
    """
    n, d = x.shape
    means = kernel.means(x)
    rounded = np.broadcast_to(means.high, (n,)).copy()
    device = double_device()
    sums = _numpy_sums(x, rounded, kernel) if device is None else _device_sums(x, rounded, kernel, device)
    constant = n**2 * kernel.grand_mean**d
    leading = float(constant)
    # Columns that met each row, those beyond its own block twice.
    block = np.arange(n) // COLUMNS
    met = np.minimum((block + 1) * COLUMNS, n) - block * COLUMNS
    met = met + 2.0 * (n - np.minimum((block + 1) * COLUMNS, n))
    host = [
        *two_product(met, rounded),
        *two_product(-2.0 * n, rounded),
        np.broadcast_to(-2.0 * n * means.low, (n,)),
        np.array([leading, float(constant - Fraction(leading))]),
    ]
    total = math.fsum(np.concatenate([*sums, *host]).tolist())
    square = total / n**2
    mean = math.fsum(rounded.tolist()) / n
    bound = _bound(kernel, d, square + 2 * mean - leading / n**2, mean)
    return square, bound + 2.0**-52 * abs(square)


def _bound(kernel: ProductKernel, d: int, kernel_mean: float, mean: float) -> float:
    """Bound the error of a square, from the means of K and of H over the points."""
    if kernel.signed:
        size = kernel.largest**d
        factors = d * (kernel.factor_units + 1) * kernel.largest ** (d - 1)
    else:
        size = kernel_mean
        factors = d * (kernel.factor_units + 1) * kernel_mean
    return 2.0**-53 * (factors + SUM_UNITS * (size + mean)) * (1 + 1e-6)


def _offsets(x: FloatArray, kernel: ProductKernel) -> FloatArray:
    """Give the factor's p at each coordinate."""
    return kernel.level + kernel.tilt * np.abs(x - 0.5)


def _device_sums(
    x: FloatArray, rounded: FloatArray, kernel: ProductKernel, device: Precision
) -> list[FloatArray]:
    """Sum blocks on the device, those beyond the rows' own twice: the sums of each work-item."""
    n, d = x.shape
    runtime, group = device.runtime, device.runtime.group
    program = device.program("discrepancy_pairs.cl", DIM=d, FORM=int(kernel.form), CHUNK=CHUNK)
    stride = padded(n, device.lanes * group)

    def by_axis(values: FloatArray) -> FloatArray:
        rows = np.zeros((d, stride))
        rows[:, :n] = values.T
        return rows

    def of_points(values: FloatArray) -> FloatArray:
        return np.concatenate([values, np.zeros(stride - n)])

    points = runtime.upload(by_axis(x))
    offsets = runtime.upload(by_axis(_offsets(x, kernel)) if kernel.form is Form.BOX else np.zeros(1))
    mean, present = runtime.upload(of_points(rounded)), runtime.upload(of_points(np.ones(n)))
    constants = [np.float64(value) for value in (2 * kernel.level, kernel.slope, kernel.curve)]
    launches = [(first, min(first + COLUMNS, n)) for first in range(0, n, COLUMNS)]
    items = [padded(-(-last // device.lanes), group) for _, last in launches]
    starts = np.concatenate([[0], np.cumsum(items)])
    out = runtime.empty(8 * int(starts[-1]))
    for (first, last), count, start in zip(launches, items, starts, strict=False):
        rows = np.uint32(min(padded(last, device.lanes), stride))
        program.run(
            "discrepancy_pairs",
            (count,),
            (group,),
            *(points, offsets, mean, present, np.uint32(stride), rows, np.uint32(first), np.uint32(last)),
            *(*constants, out, np.uint64(start)),
        )
    found = runtime.download(out, np.empty(int(starts[-1])))
    sums = []
    for (first, last), start in zip(launches, starts, strict=False):
        own = int(start) + first // device.lanes
        sums.append(2 * found[start:own])
        sums.append(found[own : int(start) + -(-last // device.lanes)])
    return sums


def _numpy_sums(x: FloatArray, rounded: FloatArray, kernel: ProductKernel) -> list[FloatArray]:
    """Sum the same blocks without a device: the sums of each row."""
    n = len(x)
    sums = []
    for first in range(0, n, COLUMNS):
        last = min(first + COLUMNS, n)
        for begin, end in _row_blocks(last):
            terms = kernel_values(x[begin:end], x[first:last], kernel) - rounded[begin:end, None]
            sums.append(terms.sum(axis=1) * (1 if begin >= first else 2))
    return sums


def _row_blocks(last: int) -> Iterator[tuple[int, int]]:
    """Give ranges of rows up to the end of a block of columns, of which ``COLUMNS`` is a multiple."""
    for begin in range(0, last, ROWS):
        yield begin, min(begin + ROWS, last)


def kernel_values(rows: FloatArray, columns: FloatArray, kernel: ProductKernel) -> FloatArray:
    """K at every pair of points.

    Parameters
    ----------
    rows, columns : (m, d) and (k, d) float64
        Points in [0, 1)^d.
    kernel : ProductKernel
        The kernel.

    Returns
    -------
    (m, k) float64
    """
    product = np.ones((len(rows), len(columns)))
    for axis in range(rows.shape[1]):
        u, v = rows[:, axis, None], columns[None, :, axis]
        if kernel.form is Form.CORNER:
            product *= 1 - np.maximum(u, v)
            continue
        t = np.abs(u - v)
        if kernel.form is Form.TORUS:
            product *= 2 * kernel.level - (t - t * t) * kernel.slope
        else:
            product *= _offsets(u, kernel) + _offsets(v, kernel) - t * (kernel.slope - kernel.curve * t)
    return product
