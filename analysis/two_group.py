"""The two-group product: amplitudes at all sums of two groups' frequencies as one real product of two tables.

Dimensions are divided in a leading and a trailing group (digits.py). Each group's half space is tabulated
from exact fixed-point phases; four real sums over points give F(fa, fb) and F(fa, -fb), and Hermitian
symmetry the other two quadrants: one multiply-add a frequency and point, half of what complex products would
take.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.accuracy import Coordinates, Errors, sum_errors
from gbnbench.analysis.digits import Axes, even_division, half_size, half_space, multiples
from gbnbench.analysis.precision import SUM_POINTS, Precision, padded
from gbnbench.errors import RefusalError
from gbnbench.torus import FloatArray

TABLE_BYTES = 4 << 20  # of both groups' tables together: what stays in cache
LEAST_ITEMS = 4  # work-items a core, so that cores end together
GPU_ITEMS = 256  # work-items a multiprocessor
COMPENSATED_FROM = 32  # sums added one after another, from which on their rounding is kept
MOST_ENTRIES = 1 << 15  # of one part of a group


@dataclass(frozen=True)
class Group:
    """Frequencies of a group of axes, some or all of its half space.

    Attributes
    ----------
    axes : tuple of Axis
        The group's.
    order : (count,) uint64 or None
        Indices in base-(2F+1) digits; None for the whole half space in its own order.
    """

    axes: Axes
    order: NDArray[np.uint64] | None = None

    @property
    def count(self) -> int:
        """How many frequencies."""
        return half_size(self.axes) if self.order is None else len(self.order)


@dataclass(frozen=True)
class Slots:
    """How points are dealt out: sets in batches, points in runs, runs in slots that work side by side.

    Attributes
    ----------
    sets : int
        Of a batch.
    splits : int
        Slots of a set.
    length : int
        Points of a slot, a multiple of the lanes.
    """

    sets: int
    splits: int
    length: int

    @property
    def count(self) -> int:
        """Slots of a batch."""
        return self.sets * self.splits

    @property
    def span(self) -> int:
        """Points of a set that one launch takes."""
        return self.splits * self.length

    def launches(self, n: int) -> int:
        """Count the launches that n points take."""
        return -(-n // self.span)

    def sums(self, n: int, lanes: int) -> int:
        """Count the register sums that a slot adds up one after another."""
        return -(-self.length // (SUM_POINTS * lanes)) * self.launches(n)


class TwoGroupProduct:
    """Buffers and programs for sets of n points in d dimensions and two groups of frequencies.

    Parameters
    ----------
    p : Precision
        Where and how.
    n, d, sets : int
        Points a set, dimension, how many sets there will be.
    a, b : Group
        Leading and trailing group.
    bounds : (row tiles, 2) uint32, optional
        For each tile of rows of the leading group the first and the end of the trailing frequencies wanted.
    """

    def __init__(
        self,
        p: Precision,
        n: int,
        d: int,
        sets: int,
        a: Group,
        b: Group,
        bounds: NDArray[np.uint32] | None = None,
    ) -> None:
        self.p, self.n, self.d, self.a, self.b = p, n, d, a, b
        self.rows = rows_of(p)
        self.width = p.runtime.group
        self.tiles = -(-a.count // self.rows)
        self.columns = padded(b.count, self.width)
        self.slots = deal(p, n, sets, self.tiles * self.rows, self.columns)
        self.stride = padded(n, self.slots.span)
        self.compensated = self.slots.sums(n, p.lanes) > COMPENSATED_FROM
        self.kept = 8 if self.compensated else 4
        if bounds is None:
            bounds = np.tile(np.array([0, b.count], np.uint32), (self.tiles, 1))
        self._bounds = p.runtime.upload(bounds)
        # 64 or a power of two beyond, so that one program serves nearly every request.
        entries = 1 << (max(64, self._describe()) - 1).bit_length()
        self.program = p.program(
            *("tables.cl", "product.cl", "power.cl"),
            ROWS=self.rows,
            COLUMNS=self.width,
            ENTRIES=entries,
            COMPENSATED=int(self.compensated),
        )
        itemsize = np.dtype(p.real).itemsize
        self._offset = self.tiles * self.rows * self.slots.length * 2
        self._slot_size = self._offset + self.columns * self.slots.length * 2
        self._table = p.runtime.empty(self._slot_size * self.slots.count * itemsize)
        self.amplitude = p.runtime.empty(self.amplitude_bytes)

    @property
    def amplitude_bytes(self) -> int:
        """Size of the amplitudes of one batch."""
        return (
            self.slots.count
            * self.tiles
            * self.rows
            * self.columns
            * self.kept
            * np.dtype(self.p.sum).itemsize
        )

    def _describe(self) -> int:
        """List what the kernels need to know of each group, and decode; return the entries of a point."""
        p = self.p
        of_tables: list[int] = []
        of_digits: list[int] = []
        factors: list[NDArray[np.int64]] = []
        begin = entries = 0
        for group, width, code in ((self.a, self.rows, 0), (self.b, self.width, self.a.count)):
            divided = even_division(group.axes)
            parts = [
                multiples(part, half_space(part), self.d) for part in (divided.leading, divided.trailing)
            ]
            lead, trail = (len(part) for part in parts)
            entries = max(entries, lead + 2 * trail)
            first = group.axes[0].coordinate if group.axes else 0
            end = group.axes[-1].coordinate + 1 if group.axes else 1
            factors += [part[:, first:end].ravel() for part in parts]
            of_tables += [first, end - first, lead, trail, begin, code, group.count, width]
            of_digits += [
                group.count,
                len(group.axes),
                divided.at,
                divided.fine,
                int(group.order is not None),
            ]
            begin += (lead + trail) * (end - first)
        if entries > MOST_ENTRIES:
            raise RefusalError("so many harmonics need more table entries than fit; ask for a smaller fmax")
        self._multiple = p.runtime.upload(np.concatenate(factors).astype(np.uint64).astype(p.turn))
        self._groups = p.runtime.upload(np.array(of_tables, np.uint32))
        self._code = p.runtime.empty(4 * (self.a.count + self.b.count))
        largest = [axis.largest for axis in (*self.a.axes, *self.b.axes)]
        listed = [group.order for group in (self.a, self.b) if group.order is not None]
        local = p.runtime.group
        p.program("digits.cl").run(
            "digits",
            (padded(self.a.count + self.b.count, local),),
            (local,),
            self._code,
            p.runtime.upload(np.array(of_digits, np.uint32)),
            p.runtime.upload(np.array(largest, np.uint32)),
            p.runtime.upload(np.concatenate(listed) if listed else np.zeros(1, np.uint64)),
        )
        return entries

    def batches(self, x: FloatArray, weights: FloatArray | None = None) -> Iterator[tuple[int, int]]:
        """Leave the amplitudes of batch after batch on the device.

        Parameters
        ----------
        x : (sets, n, d) float64
            Points.
        weights : (sets or 1, n) float64, optional
            Of the points; 1 where not given.

        Yields
        ------
        first, count : int
            Sets whose amplitudes ``amplitude`` holds until the next is asked for.
        """
        p, slots = self.p, self.slots
        weight = np.zeros((1 if weights is None else len(weights), self.stride), p.real)
        weight[:, : self.n] = 1 if weights is None else weights
        shared = p.runtime.upload(weight[:1])
        for first in range(0, len(x), slots.sets):
            batch = slice(first, first + slots.sets)
            turns = p.runtime.upload(p.turns(x[batch], self.stride))
            own = shared if len(weight) == 1 else p.runtime.upload(weight[batch])
            count = len(x[batch])
            for begin in range(0, self.stride, slots.span):
                self._tabulate(turns, own, 0 if own is shared else self.stride, count, begin)
                self._multiply(count, again=begin > 0)
            yield first, count

    def _tabulate(self, turns: Any, weight: Any, weight_stride: int, sets: int, begin: int) -> None:
        slots, local = self.slots, self.p.runtime.group
        self.program.run(
            "tables",
            (padded(slots.length // self.p.lanes, local), 2, sets * slots.splits),
            (local, 1, 1),
            turns,
            weight,
            np.uint32(self.stride),
            np.uint32(self.d),
            np.uint32(weight_stride),
            self._multiple,
            self._code,
            self._groups,
            np.uint64(self._offset),
            np.uint64(self._slot_size),
            self._table,
            np.uint32(begin),
            np.uint32(slots.length),
            np.uint32(slots.splits),
        )

    def _multiply(self, sets: int, again: bool) -> None:
        count = sets * self.slots.splits
        blocks = min(self.columns, -(-items_of(self.p) // (self.tiles * count)))
        each = 1 if self.width > 1 else -(-self.columns // blocks)
        self.program.run(
            "product",
            (padded(-(-self.columns // each), self.width), self.tiles, count),
            (self.width, 1, 1),
            self._table,
            np.uint64(self._offset),
            np.uint64(self._slot_size),
            np.uint32(self.slots.length),
            self._bounds,
            np.uint32(self.columns),
            np.uint32(each),
            self.amplitude,
            np.uint32(again),
        )


def rows_of(p: Precision) -> int:
    """Rows of a register tile: what the registers hold beside one column."""
    return 3 if p.lanes > 1 else 4


def items_of(p: Precision) -> int:
    """Work-items that keep the device busy."""
    device = p.runtime.device
    return device.compute_units * (LEAST_ITEMS if device.is_cpu else GPU_ITEMS)


def deal(p: Precision, n: int, sets: int, rows: int, columns: int) -> Slots:
    """Choose slots so that tables of so many rows and columns stay in cache and every core has work."""
    chunk = SUM_POINTS * p.lanes
    room = max(chunk, TABLE_BYTES // ((rows + columns) * 2 * np.dtype(p.real).itemsize) // chunk * chunk)
    whole = padded(n, p.lanes)
    batch = max(1, min(sets, room // whole))
    tiles = rows // rows_of(p) * columns
    splits = min(-(-items_of(p) // (tiles * batch)), -(-whole // chunk))
    launches = -(-whole // max(room, splits * chunk))
    return Slots(batch, splits, padded(-(-whole // (launches * splits)), p.lanes))


def product_errors(p: Precision, n: int, slots: Slots, fmax: int, at: Coordinates) -> Errors:
    """Errors of sqrt(power): four cosines and three complex products a term, sums as ``slots`` tells."""
    sums = slots.sums(n, p.lanes)
    beyond = p.lanes.bit_length() + (2 if sums > COMPENSATED_FROM else sums) + slots.splits
    in_registers = min(SUM_POINTS, -(-slots.length // p.lanes))
    return sum_errors(p.name, "double" if p.sum is np.float64 else "float", at, fmax, 3, in_registers, beyond)
