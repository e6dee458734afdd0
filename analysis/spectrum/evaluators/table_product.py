"""The product of two groups' tables, summed over their points on the device."""

from __future__ import annotations

from typing import Any

import numpy as np

from gbnbench.analysis.precision import SUM_POINTS, padded
from gbnbench.analysis.spectrum.evaluators.frequency_tables import FrequencyTables
from gbnbench.analysis.spectrum.evaluators.point_slots import items_of
from gbnbench.opencl import Program

COLUMN_BYTES = 512 << 10  # of trailing tables that all row tiles are multiplied with before the next
LEAST_COLUMNS = 32  # columns in these at least, so that fetching a row tile pays


def multiply(
    frequencies: FrequencyTables,
    program: Program,
    tables: tuple[Any, Any],
    sizes: tuple[int, int],
    length: int,
    slots: int,
    bounds: Any,
    amplitude: Any,
    again: bool = False,
) -> None:
    """Sum the products of both tables over their points.

    Parameters
    ----------
    frequencies : FrequencyTables
        Layout of the tables.
    program : Program
        Kernels that ``FrequencyTables.program`` built.
    tables : (buffer, buffer)
        Leading and trailing table.
    sizes : (int, int)
        Numbers from one slot's tables to the next slot's; 0 for a table that all slots share.
    length : int
        Points of a slot.
    slots : int
        Number of slots.
    bounds : buffer
        First and end of the columns that each row tile takes, such as ``FrequencyTables.all_columns``.
    amplitude : buffer
        Amplitudes, which are written.
    again : bool
        Add to the amplitudes that are there.
    """
    p, width, step, each = frequencies.p, frequencies.width, length, 1
    if width == 1:
        of_a_point = sizes[1] // frequencies.columns // length * np.dtype(p.real).itemsize
        step = min(length, max(SUM_POINTS * p.lanes, COLUMN_BYTES // (LEAST_COLUMNS * of_a_point)))
        blocks = min(frequencies.columns, -(-items_of(p) // (frequencies.tiles * slots)))
        most = max(1, COLUMN_BYTES // (step * of_a_point))
        each = -(-frequencies.columns // max(blocks, -(-frequencies.columns // most)))
    columns = -(-frequencies.columns // each)
    items = (frequencies.tiles, columns) if width == 1 else (padded(columns, width), frequencies.tiles)
    for begin in range(0, length, step):
        program.run(
            "product",
            (*items, slots),
            (width, 1, 1),
            tables[0],
            np.uint64(sizes[0]),
            tables[1],
            np.uint64(sizes[1]),
            np.uint32(length),
            np.uint32(begin),
            np.uint32(min(begin + step, length)),
            bounds,
            np.uint32(frequencies.columns),
            np.uint32(each),
            amplitude,
            np.uint32(again),
        )
