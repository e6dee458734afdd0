"""Tables of two groups' frequencies on the device.

One half space of a group's frequencies is tabulated as cosines and sines of exact fixed-point phases. The
group is divided once more for this, so that a table's entry is the complex product of two entries of smaller
tables.
"""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import SUM_POINTS, Precision, padded
from gbnbench.analysis.spectrum.digits import Axes, even_division, half_space, multiples, zero_apart
from gbnbench.analysis.spectrum.evaluators.device_points import DevicePoints
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.point_slots import (
    PART_SUMS,
    Slots,
    items_of,
    tile_columns,
    tile_rows,
)
from gbnbench.core.errors import RefusalError
from gbnbench.opencl import Program

MOST_ENTRIES = 1 << 15  # table entries for one point, of the two smaller tables of a group
DIGITS_GROUP = 64  # frequencies that a work-group decodes
ITEM_VECTORS = 16  # vectors of points that a work-item of a CPU tabulates at most; its start takes as long


class FrequencyTables:
    """Layout and kernels of two groups' tables on a device.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    d : int
        Dimension.
    a, b : Group
        Leading and trailing group.

    Attributes
    ----------
    rows, width : int
        Frequencies in a tile of the leading and of the trailing table.
    tiles, columns : int
        Tiles of the leading table, and padded frequencies of the trailing one.
    zero_last : bool
        Whether the trailing frequency 0 stands behind the others, and is summed apart (product.cl).
    """

    def __init__(self, p: Precision, d: int, a: Group, b: Group) -> None:
        self.p, self.d, self.a, self.b = p, d, a, b
        self.rows, self.width = tile_rows(p), p.runtime.group
        self.tiles = -(-a.count // self.rows)
        self.columns = padded(b.count, self.width * p.lanes)
        self.zero_last = b.order is None and zero_apart(b.count, tile_columns(p))
        # A power of two from 64 on, so that one program serves nearly every request.
        self.entries = 1 << (max(64, self._describe()) - 1).bit_length()

    def _describe(self) -> int:
        """Upload the layout of both groups, decode their digits, and count the entries of a point."""
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
            apart = int(group is self.b and self.zero_last)
            of_tables += [first, end - first, lead, trail, begin, code, group.count, width, apart]
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

    @property
    def layout(self) -> tuple[Any, Any, Any]:
        """What kernels need of both groups: multiples of the entries, pairs of entries, sizes."""
        return self._multiple, self._code, self._groups

    def program(self, compensated: bool = False, folded: bool = False) -> Program:
        """Build the kernels of tables, product and power for these groups.

        Parameters
        ----------
        compensated : bool
            Whether the rounding of sums over register sums is kept.
        folded : bool
            Whether the points are nodes of a grid that is folded in two, as ``gridded`` has it.

        Returns
        -------
        Program
        """
        small = () if folded or self.width > 1 else ("turn_rows.cl", "slot_sums.cl", "small_cube.cl")
        return self.p.program(
            *("tables.cl", "register_sums.cl", "product.cl", "power.cl", *small),
            ROWS=self.rows,
            COLUMNS=self.width,
            ENTRIES=self.entries,
            COMPENSATED=int(compensated),
            FOLDED=int(folded),
            BY_POINT=0,
            SUM_POINTS=SUM_POINTS,
            PART_SUMS=PART_SUMS,
            SUM_LANES=self.p.sum_lanes,
        )

    def program_by_point(self) -> Program:
        """Build the kernel of tables in the layout that spread.cl reads."""
        return self.p.program("tables.cl", ENTRIES=self.entries, BY_POINT=1)

    def table_sizes(self, pitch: int) -> tuple[int, int]:
        """Count the numbers in a slot's leading and trailing table, of ``pitch`` points a tile."""
        return self.tiles * self.rows * pitch * 2, self.columns * pitch * 2

    def tabulate(
        self,
        program: Program,
        groups: tuple[int, int],
        points: DevicePoints,
        tables: tuple[Any, Any],
        slots: Slots,
        sizes: tuple[int, int],
        sets: int,
        begin: int = 0,
    ) -> None:
        """Tabulate one or both groups at a run of the points of each set.

        Parameters
        ----------
        program : Program
            Kernels that ``program`` or ``program_by_point`` built.
        groups : (int, int)
            First group and how many: (0, 2) for both, (0, 1) or (1, 1) for one.
        points : DevicePoints
            The batch.
        tables : (buffer, buffer)
            Leading and trailing table, which are written.
        slots : Slots
            Slots of the batch.
        sizes : (int, int)
            Numbers from one slot's leading and trailing table to the next slot's.
        sets : int
            Sets of this batch.
        begin : int
            First point of the run.
        """
        local, vectors = self.p.runtime.group, -(-slots.length // self.p.lanes)
        each = 1
        if local == 1:
            each = max(1, min(ITEM_VECTORS, vectors * groups[1] * sets * slots.splits // items_of(self.p)))
        program.run(
            "tables",
            (padded(-(-vectors // each), local), groups[1], sets * slots.splits),
            (local, 1, 1),
            points.turns,
            points.weight,
            np.uint32(points.stride),
            np.uint32(self.d),
            np.uint32(points.weight_stride),
            *self.layout,
            np.uint32(groups[0]),
            tables[0],
            np.uint64(sizes[0]),
            tables[1],
            np.uint64(sizes[1]),
            np.uint32(begin),
            np.uint32(slots.length),
            np.uint32(slots.pitch),
            np.uint32(slots.splits),
            np.uint32(each * self.p.lanes),
        )

    @cached_property
    def all_columns(self) -> Any:
        """Bounds by which every row tile takes every column."""
        return self.p.runtime.upload(np.tile(np.array([0, self.b.count], np.uint32), (self.tiles, 1)))


@lru_cache(maxsize=8)
def whole_group_tables(p: Precision, d: int, leading: Axes, trailing: Axes) -> FrequencyTables:
    """Give the tables of two whole groups, kept from call to call as a transform keeps its twiddle factors.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    d : int
        Dimension.
    leading, trailing : tuple of Axis
        The two groups of axes.

    Returns
    -------
    FrequencyTables
    """
    return FrequencyTables(p, d, Group(leading), Group(trailing))
