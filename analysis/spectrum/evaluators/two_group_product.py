"""The two-group product: amplitudes at all sums of two groups' frequencies as one real product of two tables.

Dimensions are divided in a leading and a trailing group (digits.py). Each group's half space is tabulated
from exact fixed-point phases; four real sums over points give F(fa, fb) and F(fa, -fb), and Hermitian
symmetry the other two quadrants: one multiply-add a frequency and point, half of what complex products would
take.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import SUM_POINTS, Precision, padded
from gbnbench.analysis.spectrum.digits import Axes, even_division, half_size, half_space, multiples
from gbnbench.analysis.spectrum.error_model import Coordinates, Errors, sum_errors
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import Program

TABLE_BYTES = 4 << 20  # of both groups' tables together: what stays in cache
AMPLITUDE_BYTES = 256 << 20  # of a batch's amplitudes, or of the rows that one pass over the points takes
COLUMN_BYTES = 512 << 10  # of the columns that one row tile after another is multiplied with
LEAST_COLUMNS = 32  # of them, so that a row tile is worth fetching
LEAST_ITEMS = 4  # work-items a core, so that cores end together
GPU_ITEMS = 256  # work-items a multiprocessor
COMPENSATED_FROM = 32  # sums added one after another, from which on their rounding is kept
MOST_ENTRIES = 1 << 15  # of one part of a group
DIGITS_GROUP = 64  # indices that a work-group decodes


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


class Frequencies:
    """Two groups' frequencies on the device, ready to be tabulated and multiplied.

    Parameters
    ----------
    p : Precision
        Where and how.
    d : int
        Dimension.
    a, b : Group
        Leading and trailing group.
    """

    def __init__(self, p: Precision, d: int, a: Group, b: Group) -> None:
        self.p, self.d, self.a, self.b = p, d, a, b
        self.rows, self.width = rows_of(p), p.runtime.group
        self.tiles = -(-a.count // self.rows)
        self.columns = padded(b.count, self.width)
        # 64 or a power of two beyond, so that one program serves nearly every request.
        self.entries = 1 << (max(64, self._describe()) - 1).bit_length()

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
            raise RefusalError(
                f"a point needs {entries} table entries in d={self.d}, more than {MOST_ENTRIES}; "
                "ask for a smaller fmax, or list the frequencies you need"
            )
        self._multiple = p.runtime.upload(np.concatenate(factors).astype(np.uint64).astype(p.turn))
        self._groups = p.runtime.upload(np.array(of_tables, np.uint32))
        self._code = p.runtime.empty(4 * (self.a.count + self.b.count))
        largest = [axis.largest for axis in (*self.a.axes, *self.b.axes)]
        listed = [group.order for group in (self.a, self.b) if group.order is not None]
        local = DIGITS_GROUP
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

    def program(self, compensated: bool = False, folded: bool = False) -> Program:
        """Build the kernels for these groups."""
        return self.p.program(
            *("tables.cl", "product.cl", "power.cl"),
            ROWS=self.rows,
            COLUMNS=self.width,
            ENTRIES=self.entries,
            COMPENSATED=int(compensated),
            FOLDED=int(folded),
            BY_POINT=0,
        )

    def program_by_point(self) -> Program:
        """Build the tables' kernel in the layout that spread.cl reads."""
        return self.p.program("tables.cl", ENTRIES=self.entries, BY_POINT=1)

    def table_sizes(self, length: int) -> tuple[int, int]:
        """Count the numbers of a slot's leading and trailing table of so many points."""
        return self.tiles * self.rows * length * 2, self.columns * length * 2

    def tabulate(
        self,
        program: Program,
        groups: tuple[int, int],
        points: Points,
        tables: tuple[Any, Any],
        slots: Slots,
        sizes: tuple[int, int],
        sets: int,
        begin: int = 0,
    ) -> None:
        """Tabulate groups (first, how many) at a run of each set's points, slots of such sizes apart."""
        local = self.p.runtime.group
        program.run(
            "tables",
            (padded(slots.length // self.p.lanes, local), groups[1], sets * slots.splits),
            (local, 1, 1),
            points.turns,
            points.weight,
            np.uint32(points.stride),
            np.uint32(self.d),
            np.uint32(points.weight_stride),
            self._multiple,
            self._code,
            self._groups,
            np.uint32(groups[0]),
            tables[0],
            np.uint64(sizes[0]),
            tables[1],
            np.uint64(sizes[1]),
            np.uint32(begin),
            np.uint32(slots.length),
            np.uint32(slots.splits),
        )

    def multiply(
        self,
        program: Program,
        tables: tuple[Any, Any],
        sizes: tuple[int, int],
        length: int,
        slots: int,
        bounds: Any,
        amplitude: Any,
        again: bool = False,
    ) -> None:
        """Sum the products of both tables over their points; a table of size 0 a slot is shared by all."""
        step, each = length, 1
        if self.width == 1:
            of_a_point = sizes[1] // self.columns // length * np.dtype(self.p.real).itemsize
            step = min(length, max(SUM_POINTS * self.p.lanes, COLUMN_BYTES // (LEAST_COLUMNS * of_a_point)))
            blocks = min(self.columns, -(-items_of(self.p) // (self.tiles * slots)))
            most = max(1, COLUMN_BYTES // (step * of_a_point))
            each = -(-self.columns // max(blocks, -(-self.columns // most)))
        columns = -(-self.columns // each)
        items = (self.tiles, columns) if self.width == 1 else (padded(columns, self.width), self.tiles)
        for begin in range(0, length, step):
            program.run(
                "product",
                (*items, slots),
                (self.width, 1, 1),
                tables[0],
                np.uint64(sizes[0]),
                tables[1],
                np.uint64(sizes[1]),
                np.uint32(length),
                np.uint32(begin),
                np.uint32(min(begin + step, length)),
                bounds,
                np.uint32(self.columns),
                np.uint32(each),
                amplitude,
                np.uint32(again),
            )

    @cached_property
    def all_columns(self) -> Any:
        """Bounds by which every row tile takes every column."""
        return self.p.runtime.upload(np.tile(np.array([0, self.b.count], np.uint32), (self.tiles, 1)))


@lru_cache(maxsize=8)
def whole_frequencies(p: Precision, d: int, leading: Axes, trailing: Axes) -> Frequencies:
    """Two whole groups' frequencies, kept from call to call as a transform's twiddle factors are."""
    return Frequencies(p, d, Group(leading), Group(trailing))


@dataclass(frozen=True)
class Points:
    """A batch of sets on the device.

    Attributes
    ----------
    turns, weight
        Buffers of fixed-point coordinates and of weights, 0 beyond the last point.
    stride, weight_stride : int
        Points from one coordinate to the next; from one set's weights to the next's, 0 where they share them.
    """

    turns: Any
    weight: Any
    stride: int
    weight_stride: int


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
        self.p, self.n = p, n
        whole = a.order is None and b.order is None
        self.frequencies = whole_frequencies(p, d, a.axes, b.axes) if whole else Frequencies(p, d, a, b)
        rows, columns = self.frequencies.tiles * self.frequencies.rows, self.frequencies.columns
        self.slots = deal(p, n, sets, rows, columns)
        self.stride = padded(n, self.slots.span)
        compensated = self.slots.sums(n, p.lanes) > COMPENSATED_FROM
        self._bounds = self.frequencies.all_columns if bounds is None else p.runtime.upload(bounds)
        self.program = self.frequencies.program(compensated)
        self._sizes = self.frequencies.table_sizes(self.slots.length)
        real, total = np.dtype(p.real).itemsize, np.dtype(p.sum).itemsize
        self._tables = tuple(p.runtime.empty(size * self.slots.count * real) for size in self._sizes)
        kept = 8 if compensated else 4
        self.amplitude = p.runtime.empty(self.slots.count * rows * columns * kept * total)

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
            own = shared if len(weight) == 1 else p.runtime.upload(weight[batch])
            turns = p.runtime.upload(p.turns(x[batch], self.stride))
            points = Points(turns, own, self.stride, 0 if own is shared else self.stride)
            count = len(x[batch])
            for begin in range(0, self.stride, slots.span):
                self.frequencies.tabulate(
                    *(self.program, (0, 2), points, self._tables, slots), self._sizes, count, begin
                )
                self.multiply(count, again=begin > 0)
            yield first, count

    def multiply(self, sets: int, again: bool = False) -> None:
        """Multiply the tables of so many sets, and add to the amplitudes of points before where again."""
        self.frequencies.multiply(
            *(self.program, self._tables, self._sizes, self.slots.length, sets * self.slots.splits),
            bounds=self._bounds,
            amplitude=self.amplitude,
            again=again,
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
    amplitudes = rows * columns * 8 * np.dtype(p.sum).itemsize
    batch = max(1, min(sets, room // whole, AMPLITUDE_BYTES // amplitudes))
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


def norms_of(weights: FloatArray | None, sets: int, n: int) -> FloatArray:
    """Sum the squared weights of each set.

    Parameters
    ----------
    weights : (sets or 1, n) float64 or None
        Weights of the points; every weight is 1 where there are none.
    sets, n : int
        Number of sets, and of points in each.

    Returns
    -------
    (sets,) float64
        By which squared amplitudes are divided to give power.
    """
    if weights is None:
        return np.full(sets, float(n))
    return np.broadcast_to((weights**2).sum(axis=1), (sets,)).astype(np.float64)
