"""The product of two groups' tables, summed over their points on the device."""

from __future__ import annotations

from typing import Any

import numpy as np

from gbnbench.analysis.precision import padded
from gbnbench.analysis.spectrum.evaluators.frequency_tables import FrequencyTables
from gbnbench.analysis.spectrum.evaluators.point_slots import items_of
from gbnbench.opencl import Program

COLUMN_BYTES = 512 << 10  # of trailing tables that all row tiles are multiplied with before the next


def multiply(
    frequencies: FrequencyTables,
    program: Program,
    tables: tuple[Any, Any],
    sizes: tuple[int, int],
    length: int,
    pitch: int,
    slots: int,
    bounds: Any,
    amplitude: Any,
    done: int = 0,
    all_sums: int = 1,
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
    length, pitch : int
        Points of a slot, and points from one tile of a table to the next.
    slots : int
        Number of slots.
    bounds : buffer
        First and end of the columns that each row tile takes, such as ``FrequencyTables.all_columns``.
    amplitude : buffer
        Amplitudes, which are written.
    done : int
        Register sums that the amplitudes hold, to which these are added.
    all_sums : int
        Those that they will hold at the end; what is kept apart of compensated sums is then put together.
    """
    p, width, tiles = frequencies.p, frequencies.width, frequencies.tiles
    tiles_each = each = 1
    if width == 1:
        of_a_point = sizes[1] // frequencies.columns // pitch * np.dtype(p.real).itemsize
        most = max(p.lanes, COLUMN_BYTES // (length * of_a_point))
        blocks, items = -(-frequencies.columns // most), -(-items_of(p) // slots)
        tiles_each = -(-tiles // min(tiles, -(-items // blocks)))
        blocks = max(blocks, -(-items // -(-tiles // tiles_each)))
        each = padded(-(-frequencies.columns // blocks), p.lanes)
    columns, tile_blocks = -(-frequencies.columns // each), -(-tiles // tiles_each)
    items_wanted = (tile_blocks, columns) if width == 1 else (padded(columns, width), tile_blocks)
    program.run(
        "product",
        (*items_wanted, slots),
        (width, 1, 1),
        tables[0],
        np.uint64(sizes[0]),
        tables[1],
        np.uint64(sizes[1]),
        np.uint32(pitch),
        np.uint32(length),
        bounds,
        np.uint32(tiles),
        np.uint32(tiles_each),
        np.uint32(frequencies.columns),
        np.uint32(frequencies.zero_last),
        np.uint32(each),
        amplitude,
        np.uint32(done),
        np.uint32(all_sums),
    )
