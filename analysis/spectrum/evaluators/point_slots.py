"""Slots in which the points of a product are dealt out to work-items.

The points of a set are cut in runs, and its runs are dealt to slots, which work side by side. Several small
sets make one batch. Slots are chosen so that the tables of one stay in cache and every core has work.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gbnbench.analysis.precision import Precision, padded

TABLE_BYTES = 4 << 20  # of both groups' tables of a slot, which then stay in cache
AMPLITUDE_BYTES = 256 << 20  # of the amplitudes of a batch, or of the rows of one pass over the points
LEAST_ITEMS = 4  # work-items for each core of a CPU at least, so that all cores end together
GPU_ITEMS = 256  # the same for each multiprocessor of a GPU
COMPENSATED_FROM = 32  # the rounding of a slot's sums is kept if it adds up more register sums than this


@dataclass(frozen=True)
class Slots:
    """Slots of a batch of sets.

    Attributes
    ----------
    sets : int
        Sets of a batch.
    splits : int
        Slots of a set.
    length : int
        Points that a slot takes in one launch, a multiple of the lanes.
    pitch : int
        Points from one tile of a table to the next: ``length``, or a few more where that would put all
        tiles in the same lines of a cache.
    """

    sets: int
    splits: int
    length: int
    pitch: int

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

    def sums(self, n: int, p: Precision) -> int:
        """Count the register sums that a slot adds up one after another.

        Parameters
        ----------
        n : int
            Points of a set.
        p : Precision
            Precision on the device.

        Returns
        -------
        int
        """
        return -(-self.length // (p.sum_points * p.lanes)) * self.launches(n)


def tile_rows(p: Precision) -> int:
    """Give the rows of a register tile: as many as registers hold beside one column."""
    return 3 if p.lanes > 1 else 4


def items_of(p: Precision) -> int:
    """Count the work-items that keep the device busy."""
    device = p.runtime.device
    return device.compute_units * (LEAST_ITEMS if device.is_cpu else GPU_ITEMS)


def choose_slots(p: Precision, n: int, sets: int, rows: int, columns: int) -> Slots:
    """Choose slots so that the tables of one stay in cache and every core has work.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    n, sets : int
        Points of a set, and number of sets.
    rows, columns : int
        Frequencies of the leading and of the trailing group, padded to whole tiles.

    Returns
    -------
    Slots
    """
    chunk = p.sum_points * p.lanes
    room = max(chunk, TABLE_BYTES // ((rows + columns) * 2 * np.dtype(p.real).itemsize) // chunk * chunk)
    whole = padded(n, p.lanes)
    amplitudes = rows * columns * 8 * np.dtype(p.sum).itemsize
    batch = max(1, min(sets, room // whole, AMPLITUDE_BYTES // amplitudes))
    tiles = rows // tile_rows(p) * columns
    splits = min(-(-items_of(p) // (tiles * batch)), -(-whole // chunk))
    launches = -(-whole // max(room, splits * chunk))
    length = padded(-(-whole // (launches * splits)), p.lanes)
    return Slots(batch, splits, length, length + (p.lanes if p.lanes > 1 else 0))
