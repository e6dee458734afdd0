"""The two-group product: amplitudes of a whole cube of frequencies as one real product of two tables.

The dimensions are split in a leading and a trailing group. Each group's half space is enumerated by
base-(2F+1) digits (Ahmed, Ren & Wonka 2022, App. C) and its cosines and sines are tabulated from exact
fixed-point phases; four real sums over points give F(fa, fb) and F(fa, -fb), and Hermitian symmetry the other
two quadrants.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gbnbench.analysis.precision import SUM_POINTS, Precision, padded
from gbnbench.opencl import Program
from gbnbench.torus import FloatArray

TABLE_POINTS = 32  # points whose table rows one work-item fills
TABLE_BYTES = 4 << 20  # both groups' tables together: what stays in a core's cache


class Group:
    """One group of dimensions: its half space of frequencies and its tables for a chunk of points."""

    def __init__(self, p: Precision, program: Program, dims: int, fmax: int, width: int, chunk: int) -> None:
        base = 2 * fmax + 1
        self.dims = dims
        self.count = (base**dims + 1) // 2
        self.width = width
        self.stride = padded(self.count, math.lcm(width, p.lanes))
        self._p, self._program = p, program
        itemsize = np.dtype(p.real).itemsize
        self._frequency = p.runtime.empty(max(dims, 1) * self.stride * itemsize)
        self.table = p.runtime.empty(2 * chunk * self.stride * itemsize)
        local = p.runtime.group
        program.run(
            "digits",
            (padded(self.stride, local),),
            (local,),
            self._frequency,
            np.uint64((base**dims - 1) // 2),
            np.uint32(self.count),
            np.uint32(self.stride),
            np.uint32(dims),
            np.uint64(base),
        )

    def fill(self, x: Any, offset: int, n: int, begin: int, points: int) -> None:
        """Tabulate points begin .. begin+points of the coordinates that start at row offset of x."""
        local = self._p.runtime.group
        blocks = padded(self.stride // self._p.lanes, local)
        self._program.run(
            "tables",
            (blocks, -(-points // TABLE_POINTS)),
            (local, 1),
            self._frequency,
            x,
            self.table,
            np.uint32(self.width),
            np.uint32(self.stride),
            np.uint32(self.dims),
            np.uint64(n),
            np.uint64(offset * n + begin),
            np.uint32(points),
        )


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
        program = p.program(
            *("digits.cl", "tables.cl", "product.cl", "power.cl"),
            ROWS=self.rows,
            COLUMNS=columns,
            TABLE_POINTS=TABLE_POINTS,
        )
        self._chunk, self._program = chunk, program
        self.a = Group(p, program, leading, fmax, self.rows, chunk)
        self.b = Group(p, program, d - leading, fmax, columns, chunk)
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
            a.fill(points, 0, self.n, begin, count)
            b.fill(points, a.dims, self.n, begin, count)
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
