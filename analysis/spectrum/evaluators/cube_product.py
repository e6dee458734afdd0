"""Power at every frequency of a cube, or of the half of it with f_0 >= 0, by the two-group product."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.digits import Division, cheapest_division, half_size, size
from gbnbench.analysis.spectrum.error_model import Errors, coordinates
from gbnbench.analysis.spectrum.evaluators.two_group_product import (
    AMPLITUDE_BYTES,
    Group,
    TwoGroupProduct,
    product_errors,
    rows_of,
)
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import Program

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
    at, rms, bound = coordinates(x, p.name, weights), 0.0, 0.0
    writer: CubeWriter | None = None
    for first_row, rows in row_blocks(p, divided):
        product = TwoGroupProduct(p, n, d, sets, rows, Group(divided.trailing))
        if writer is None:
            writer = CubeWriter(p, divided, fmax, norms_of(weights, sets, n), d, half=half, mean=mean)
        for first, count in product.batches(x, weights):
            writer.add(
                product.program, product.amplitude, product.slots.splits, first, count, first_row, rows.count
            )
        errors = product_errors(p, n, product.slots, fmax, at)
        rms, bound = max(rms, errors.rms), max(bound, errors.bound)
    assert writer is not None  # noqa: S101 - there is a row
    return writer.result(), Errors(rms, bound)


class CubeWriter:
    """A cube of power on the device, to which batches of amplitudes are added.

    Parameters
    ----------
    p : Precision
        Where and how.
    divided : Division
        The axes' two groups.
    fmax : int
        Largest harmonic on each axis.
    norms : (sets,) float64
        By which each set's squared amplitudes are divided.
    d : int
        Dimension.
    half, mean : bool
        As in ``cube_powers``.
    gains : (rows,) float64, optional
        By which squared amplitudes of a leading frequency are divided besides.
    """

    def __init__(
        self,
        p: Precision,
        divided: Division,
        fmax: int,
        norms: FloatArray,
        d: int,
        half: bool,
        mean: bool,
        gains: FloatArray | None = None,
    ) -> None:
        self._p, self._fmax, self._d, self._half, self._mean = p, fmax, d, half, mean
        self._sets = len(norms)
        self._rows, self._columns = half_size(divided.leading), half_size(divided.trailing)
        shape = covered(divided, d)
        self._start = shape[0] // 2 * math.prod(shape[1:]) if half else 0
        self._count = math.prod(shape) - self._start
        self._shape = (shape[0] - shape[0] // 2, *shape[1:]) if half else shape
        self._out = p.runtime.empty(self._count * (1 if mean else self._sets) * np.dtype(p.sum).itemsize)
        self._norms = p.runtime.upload(norms.astype(p.sum))
        self._gains = p.runtime.upload((np.ones(self._rows) if gains is None else gains).astype(p.sum))

    def add(
        self, program: Program, amplitude: Any, splits: int, first: int, count: int, first_row: int, rows: int
    ) -> None:
        """Add so many sets from the first on, or write them where each is wanted, at some leading rows."""
        each = GPU_COLUMNS if self._p.runtime.group > 1 else self._columns
        program.run(
            "cube_power",
            (-(-self._columns // each), rows),
            (1, 1),
            amplitude,
            np.uint32(self._rows),
            np.uint32(first_row),
            np.uint32(rows),
            np.uint32(self._columns),
            np.uint32(padded(self._columns, self._p.runtime.group)),
            np.uint32(each),
            np.uint32(splits),
            np.uint32(count),
            self._norms,
            self._gains,
            np.uint32(first),
            self._out,
            np.uint64(self._start),
            np.uint64(0 if self._mean else self._count),
        )

    def result(self) -> FloatArray:
        """Download the cube, without what was covered beyond its edge."""
        fmax, sets = self._fmax, 1 if self._mean else self._sets
        power = self._p.runtime.download(self._out, np.empty((sets, *self._shape), self._p.sum))
        inner = tuple(
            slice(0, fmax + 1) if self._half and a == 0 else slice(have // 2 - fmax, have // 2 + fmax + 1)
            for a, have in enumerate(self._shape)
        )
        power = np.ascontiguousarray(power[(slice(None), *inner)], np.float64)
        if not self._mean:
            return power
        if self._sets > 1:
            power /= self._sets
        mean: FloatArray = power[0]
        return mean


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
