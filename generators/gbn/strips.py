"""The energy within a cut-off, by sorted strips of points: linear in n, for one to three dimensions."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtr

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import operation_counts
from gbnbench.generators.gbn.protocol import EnergyGradient
from gbnbench.opencl import Runtime

WIDTH = {"double": 1.8, "float": 2.5}  # of a strip, in spacings
CELL = 0.5  # length, in spacings
SKIN = 0.3  # move, in spacings, after which the points are sorted anew
PACKAGE = "gbnbench.generators"


class Strips:
    """Sums over the pairs nearer than a cut-off.

    Parameters
    ----------
    runtime : Runtime
        The device.
    n, d : int
        Size of the sets; d is 1, 2 or 3.
    sigma : float
        Kernel width in spacings.
    precision : {"double", "float"}
        Of the forces. Float takes positions as 32-bit fractions of a side.
    cutoff : float, optional
        Where the kernel itself ends, in sigmas (Section 4.4); without it the kernel is whole and pairs that
        add less than the precision are left out.
    side : float, optional
        Of the torus, in spacings, where it is not n^(1/d); the energy is then that of the pairs alone, no
        constant density's taken away.

    Raises
    ------
    RefusalError
        If d is beyond 3 or the box too narrow, as ``operation_counts.strips`` says.

    Notes
    -----
    The points are sorted when the first gradient is asked for, and again when one of a set has moved by SKIN
    since; until then the search reaches that much further. Which order is used depends on the set alone.
    """

    method = "strips"

    def __init__(
        self,
        runtime: Runtime,
        n: int,
        d: int,
        sigma: float,
        precision: str,
        cutoff: float | None = None,
        side: float | None = None,
    ) -> None:
        self.side = side or n ** (1 / d)
        reach = (cutoff or operation_counts.CUTOFF[precision]) * sigma
        self.n, self.d, self.sigma = n, d, sigma
        self.error = operation_counts.strips(n, d, sigma, precision, cutoff, side).error
        self._runtime = runtime
        self._double = precision == "double"
        self._real: type[np.floating[Any]] = np.float64 if self._double else np.float32
        self._lanes = runtime.lanes(precision)
        self._reach = reach / self.side
        across = max(1, math.floor(self.side / WIDTH[precision]))
        self._rows = across if d > 1 else 1
        self._columns = across if d > 2 else 1
        self._cells = max(1, math.floor(self.side / CELL))
        self._pencils = self._rows * self._columns
        self._groups = n // self._lanes + self._pencils  # at most: each strip rounds up once
        self._capacity = self._groups * self._lanes
        share = 1.0 if cutoff is None else float(chdtr(d, cutoff**2))  # of chi-square
        self._uniform = 0.0 if side else (2 * math.pi) ** (d / 2) * sigma**d * share
        square = (self.side / sigma) ** 2 * math.log2(math.e) / 2  # r in sides to the exponent of 2
        self._unit = 1.0 if self._double else 2.0**-32  # of a place, in sides
        self._scale = self._real(square * self._unit**2)
        defines: dict[str, object] = {"DOUBLE": int(self._double), "LANES": self._lanes, "DIM": d}
        if cutoff is not None:
            defines["TRUNCATED"] = f"{-(cutoff**2) * math.log2(math.e) / 2!r}{'' if self._double else 'f'}"
        self._program = runtime.program(PACKAGE, ("/vector.cl", "/exp2.cl", "gbn_strips.cl"), defines)
        self._anchor: FloatArray = np.empty((0, n, d))
        self._floor: FloatArray = self._anchor

    @property
    def anchor(self) -> FloatArray:
        """Points (sets, n, d) as they were when last sorted: with them a run goes on bit by bit."""
        return self._anchor

    @anchor.setter
    def anchor(self, x: FloatArray) -> None:
        """Go on as if the points had last been sorted at x."""
        self._allocate(len(x))
        for k, points in enumerate(x):
            self._sort(k, points)

    def __call__(self, x: FloatArray) -> EnergyGradient:
        """Evaluate; see ``EnergyEvaluation``."""
        if len(x) != len(self._anchor):
            self.anchor = x
        moved = x - self._anchor
        far = np.sqrt(np.einsum("kna,kna->kn", moved, moved).max(axis=1))
        for k in np.flatnonzero(far > SKIN / self.side):
            self._sort(int(k), x[k])
            far[k] = 0
        sets, local = len(x), self._runtime.group
        self._runtime.update(self._reaches, ((self._reach + far) * (1 + 1e-6)).astype(self._real))
        self._runtime.update(self._places, self._placed(x))
        self._program.run(
            "gbn_strips",
            (-(-self._groups // local) * local, sets),
            (local, 1),
            self._places,
            self._order,
            self._table,
            self._pencil,
            self._count,
            np.uint32(self._groups),
            np.uint32(self.n),
            np.uint32(self._capacity),
            np.int32(self._cells),
            np.int32(self._rows),
            np.int32(self._columns),
            self._scale,
            self._reaches,
            self._found,
        )
        return self._results(sets)

    def _placed(self, x: FloatArray) -> NDArray[Any]:
        """Rows of coordinates in the order of the slots: (sets, d, capacity)."""
        places = np.empty((len(x), self.d, self._capacity), np.float64 if self._double else np.uint32)
        for k, points in enumerate(x):
            if self._double:
                at: NDArray[Any] = points - self._floor[k]
            else:  # whole sides fall away
                at = np.rint(np.ldexp(points, 32)).astype(np.int64).astype(np.uint32)
            for a in range(self.d):
                np.take(at[:, a], self._slots[k], out=places[k, a])
        return places

    def _results(self, sets: int) -> EnergyGradient:
        found = self._runtime.download(
            self._found, np.empty(sets * (self.n * self.d + self._groups), self._real)
        )
        slopes, energy = np.split(found, [sets * self.n * self.d])
        slope = self._unit * self.side / self.sigma**2
        gradient = np.multiply(slopes.reshape(sets, self.n, self.d), slope, dtype=np.float64)
        sums = [
            row[:groups].sum(dtype=np.float64)
            for row, groups in zip(energy.reshape(sets, -1), self._used, strict=True)
        ]
        return EnergyGradient(gradient, (np.array(sums) / self.n - self._uniform) / 2)

    def _allocate(self, sets: int) -> None:
        if sets == len(self._anchor):
            return
        size = np.dtype(self._real).itemsize
        self._anchor = np.empty((sets, self.n, self.d))
        self._floor = np.empty_like(self._anchor)
        self._used = [0] * sets
        empty = self._runtime.empty
        self._slots = np.empty((sets, self._capacity), np.uint32)
        self._found = empty(sets * (self.n * self.d + self._groups) * size)
        self._places = empty(sets * self.d * self._capacity * size)
        self._reaches = empty(sets * size)
        self._order = empty(sets * self._capacity * 4)
        self._table = empty(sets * self._pencils * (self._cells + 1) * 4)
        self._pencil = empty(sets * self._groups * 4)
        self._count = empty(sets * 4)

    def _sort(self, k: int, points: FloatArray) -> None:
        """Sort set k by cells and tell the device."""
        self._anchor[k] = points
        np.floor(points, out=self._floor[k])
        at = points - self._floor[k]
        cell = np.minimum((at[:, 0] * self._cells).astype(np.int32), self._cells - 1)
        pencil = np.zeros(self.n, np.int32)
        for a, across in zip(range(1, self.d), (self._rows, self._columns), strict=False):
            pencil = pencil * across + np.minimum((at[:, a] * across).astype(np.int32), across - 1)
        key = pencil * self._cells + cell
        order = np.argsort(key, kind="stable").astype(np.uint32)
        ends = np.cumsum(np.bincount(key, minlength=self._pencils * self._cells)).reshape(self._pencils, -1)
        starts = np.concatenate([[0], ends[:-1, -1]])
        counts = ends[:, -1] - starts
        groups = -(-counts // self._lanes)
        first = (np.cumsum(groups) - groups) * self._lanes  # slot at which each strip begins
        table = np.empty((self._pencils, self._cells + 1), np.uint32)
        table[:, 0] = first
        table[:, 1:] = ends + (first - starts)[:, None]
        held = np.zeros(self._capacity, np.uint32)  # the sorted point of each slot
        held[np.arange(self.n) + np.repeat(first - starts, counts)] = np.arange(self.n, dtype=np.uint32)
        self._slots[k] = order[np.maximum.accumulate(held)]
        used = int(groups.sum())
        pencils = np.repeat(np.arange(self._pencils, dtype=np.uint32), groups)
        self._used[k] = used
        self._runtime.update(self._order, self._slots[k], k * self._slots[k].nbytes)
        self._runtime.update(self._table, table, k * table.nbytes)
        self._runtime.update(self._pencil, pencils, k * self._groups * 4)
        self._runtime.update(self._count, np.array([used], np.uint32), k * 4)
