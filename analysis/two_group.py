"""The two-group product: amplitudes of a whole cube of frequencies as one real product of two tables.

The dimensions are split in a leading and a trailing group. Each group's half space is enumerated by
base-(2F+1) digits (Ahmed, Ren & Wonka 2022, App. C) and its cosines and sines are tabulated from exact
fixed-point phases; four real sums over points give F(fa, fb) and F(fa, -fb), and Hermitian symmetry the other
two quadrants.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import SUM_POINTS, Precision, padded
from gbnbench.opencl import Program
from gbnbench.torus import FloatArray

WHOLE = 8  # digits of one dimension up to which each has a sine and cosine of its own
TABLE_BYTES = 4 << 20  # both groups' tables together: what stays in a core's cache


@dataclass(frozen=True)
class Factors:
    """How exp(i f.x) of a group is a product: per dimension a coarse and a fine multiple of the coordinate.

    Attributes
    ----------
    split : (dims,) uint32
        Digit g = split * coarse + fine; 1 where the coarse factor alone does.
    coarse, fine : (dims,) int32
        Where each dimension's factors begin in the list below, less the first coarse digit.
    multiple : (entries,) int64
        Frequency of each factor.
    axis : (entries,) uint32
        Its dimension within the group.
    """

    split: NDArray[np.uint32]
    coarse: NDArray[np.int32]
    fine: NDArray[np.int32]
    multiple: NDArray[np.int64]
    axis: NDArray[np.uint32]

    @property
    def slots(self) -> int:
        """Factors of one frequency."""
        return int(len(self.split) + np.count_nonzero(self.split > 1))


def factors_of(dims: int, fmax: int) -> Factors:
    """Split a group's digits so that a point needs few sines and cosines: 17 instead of 65 at F = 64."""
    split, coarse, fine = (np.zeros(dims, np.int64) for _ in range(3))
    multiple: list[int] = []
    axis: list[int] = []
    for a in range(dims):
        low, high = (fmax if a == 0 else 0), 2 * fmax  # the half space has no first digit below the centre
        span = high - low + 1
        split[a] = 1 if span <= WHOLE else math.isqrt(span)
        coarse[a] = len(multiple) - low // split[a]
        multiple += [int(split[a]) * h - fmax for h in range(low // int(split[a]), high // int(split[a]) + 1)]
        fine[a] = len(multiple)
        multiple += range(split[a]) if split[a] > 1 else ()
        axis += [a] * (len(multiple) - len(axis))
    return Factors(
        split.astype(np.uint32),
        coarse.astype(np.int32),
        fine.astype(np.int32),
        np.array(multiple, np.int64),
        np.array(axis, np.uint32),
    )


class Group:
    """One group of dimensions: its half space of frequencies and its tables for a chunk of points."""

    def __init__(self, p: Precision, factors: Factors, dims: int, fmax: int, width: int, chunk: int) -> None:
        base = 2 * fmax + 1
        self.dims = dims
        self.count = (base**dims + 1) // 2
        self.width = width
        self.stride = padded(self.count, width)
        self._p, self._factors = p, factors
        self._index = p.runtime.empty(2 * max(factors.slots, 1) * self.stride)
        self._multiple = _upload(p, factors.multiple.astype(np.uint64).astype(p.turn))
        self._axis = _upload(p, factors.axis)
        self.table = p.runtime.empty(2 * chunk * self.stride * np.dtype(p.real).itemsize)
        local = p.runtime.group
        p.program("digits.cl").run(
            "digits",
            (padded(self.stride, local),),
            (local,),
            self._index,
            _upload(p, factors.split),
            _upload(p, factors.coarse),
            _upload(p, factors.fine),
            np.uint64((base**dims - 1) // 2),
            np.uint32(self.count),
            np.uint32(self.stride),
            np.uint32(dims),
            np.uint64(base),
        )

    def fill(self, program: Program, x: Any, offset: int, n: int, begin: int, length: int) -> None:
        """Tabulate points begin .. begin+length of the coordinates that start at row offset of x."""
        local = self._p.runtime.group
        program.run(
            "tables",
            (padded(length // self._p.lanes, local),),
            (local,),
            self._index,
            self._multiple,
            self._axis,
            np.uint32(self._factors.slots),
            np.uint32(len(self._factors.multiple)),
            x,
            self.table,
            np.uint32(self.width),
            np.uint32(self.stride),
            np.uint64(n),
            np.uint64(offset * n + begin),
            np.uint32(length),
        )


def _upload(p: Precision, array: NDArray[Any]) -> Any:
    """Copy to the device; a buffer cannot be empty."""
    return p.runtime.upload(array if len(array) else np.zeros(1, array.dtype))


class TwoGroupProduct:
    """Buffers and programs for one (n, d, fmax), used for one realization after another."""

    def __init__(self, p: Precision, n: int, d: int, fmax: int) -> None:
        self._p, self.n, self.d, self.fmax = p, n, d, fmax
        self.rows = 3 if p.lanes > 1 else 4
        base = 2 * fmax + 1
        leading = d // 2
        per_point = (
            sum((base**dims + 1) // 2 for dims in (leading, d - leading)) * 2 * np.dtype(p.real).itemsize
        )
        chunk = min(
            padded(n, SUM_POINTS), max(SUM_POINTS, TABLE_BYTES // per_point // SUM_POINTS * SUM_POINTS)
        )
        columns = p.lanes * p.runtime.group
        factors = [factors_of(dims, fmax) for dims in (leading, d - leading)]
        # 64 or a power of two beyond, so that one program serves nearly every request.
        room = max(64, 1 << max(len(group.multiple) for group in factors).bit_length())
        self._chunk = chunk
        self._program = p.program(
            *("tables.cl", "product.cl", "power.cl"),
            ROWS=self.rows,
            COLUMNS=columns,
            ENTRIES=room,
        )
        self.a = Group(p, factors[0], leading, fmax, self.rows, chunk)
        self.b = Group(p, factors[1], d - leading, fmax, columns, chunk)
        itemsize = np.dtype(p.sum).itemsize
        self._zeros = np.zeros(4 * self.a.stride * self.b.stride, p.sum)
        self._amplitude = p.runtime.empty(self._zeros.nbytes)
        self._power = p.runtime.empty(base**d * itemsize)

    def power(self, x: FloatArray) -> FloatArray:
        """One realization's cube of power."""
        p, a, b = self._p, self.a, self.b
        points = p.upload_points(x)
        p.runtime.update(self._amplitude, self._zeros)
        local = p.runtime.group
        for begin in range(0, self.n, self._chunk):
            count = min(self._chunk, self.n - begin)
            length = padded(count, p.lanes)
            a.fill(self._program, points, 0, self.n, begin, length)
            b.fill(self._program, points, a.dims, self.n, begin, length)
            self._program.run(
                "product",
                (padded(b.stride // p.lanes, local), -(-a.count // self.rows)),
                (local, 1),
                a.table,
                b.table,
                np.uint32(a.stride),
                np.uint32(b.stride),
                self._amplitude,
                np.uint32(count),
                np.uint32(length),
            )
        self._program.run(
            "power",
            (padded(b.count, local), a.count),
            (local, 1),
            self._amplitude,
            np.uint32(a.count),
            np.uint32(a.stride),
            np.uint32(b.count),
            np.uint32(b.stride),
            p.sum(self.n),
            self._power,
        )
        base = 2 * self.fmax + 1
        cube = p.runtime.download(self._power, np.empty(base**self.d, p.sum))
        return cube.astype(np.float64, copy=False).reshape((base,) * self.d)
