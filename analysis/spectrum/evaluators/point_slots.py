"""Slots in which the points of a product are dealt out to work-items.

The points of a set are cut in runs, and its runs are dealt to slots, which work side by side. Several small
sets make one batch. Slots are chosen so that the tables of one stay in cache and every core has work.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gbnbench.analysis.precision import SUM_POINTS, Precision, padded

TABLE_BYTES = 4 << 20  # of both groups' tables of a slot, which then stay in cache
OWN_POINTS = 128  # points whose tables a core makes and multiplies at once: they stay in its second cache
MORE_POINTS, LARGE_SUMS = 256, 3 << 19  # as many where the sums of a slot take more bytes than that cache has
OWN_COLUMNS = 512 << 10  # bytes of its trailing tables that all rows are multiplied with before the next
OWN_BATCH = 12 << 20  # bytes of the sums of a batch of such slots
SMALL = 1 << 18  # pairs of frequencies times points that one core takes alone
LAUNCH_POINTS = 512  # points of a slot whose tables are made first, at least, where there are so many
AMPLITUDE_BYTES = 256 << 20  # of the amplitudes of a batch, or of the rows of one pass over the points
LEAST_ITEMS = 4  # work-items for each core of a CPU at least, so that all cores end together
GPU_ITEMS = 256  # the same for each multiprocessor of a GPU
WIDE = 64  # bytes of a vector of AVX-512, of which there are 32 registers, twice as many as of narrower ones
COMPENSATED_FROM = 32  # the rounding of a slot's sums is kept if it adds up more register sums than this
PART_SUMS = 8  # register sums that are then added up plainly, before the rounding of what they make is kept
PLAIN_POINTS = 24 * SUM_POINTS  # up to so many points no slot adds up more than COMPENSATED_FROM
# Numbers that a pair of frequencies has: its four sums, and where the rounding is kept, of each a part, a
# whole and what was rounded.
PLAIN_SUMS, PAIR_SUMS = 4, 12


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
    items : int
        Work-items that take whole slots, each with tables of its own (slot_sums.cl); 0 where the tables of
        all slots are made first.
    """

    sets: int
    splits: int
    length: int
    pitch: int
    items: int = 0

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

    def sums(self, n: int) -> int:
        """Count the register sums that a slot adds up one after another.

        Parameters
        ----------
        n : int
            Points of a set.

        Returns
        -------
        int
        """
        return -(-self.length // SUM_POINTS) * self.launches(n)


def tile_rows(p: Precision) -> int:
    """Give the rows of a register tile, whose sums with two vectors of columns registers hold."""
    if p.lanes == 1:
        return 4
    return 6 if p.lanes * np.dtype(p.real).itemsize == WIDE else 3


def tile_columns(p: Precision) -> int:
    """Give the columns of the smallest part of a block: a vector holds the cosines and sines of so many."""
    return max(1, p.lanes // 2)


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
    if p.runtime.device.is_cpu:
        own = _own_slots(p, n, sets, rows, columns)
        if own is not None:
            return own
    chunk = LAUNCH_POINTS
    room = max(chunk, TABLE_BYTES // ((rows + columns) * 2 * np.dtype(p.real).itemsize) // chunk * chunk)
    whole = padded(n, p.lanes)
    amplitudes = rows * columns * PAIR_SUMS * np.dtype(p.sum).itemsize
    batch = max(1, min(sets, room // whole, AMPLITUDE_BYTES // amplitudes))
    tiles = rows // tile_rows(p) * columns
    splits = min(-(-items_of(p) // (tiles * batch)), -(-whole // chunk))
    launches = -(-whole // max(room, splits * chunk))
    length = padded(-(-whole // (launches * splits)), p.lanes)
    return Slots(batch, splits, length, length + (p.lanes if p.lanes > 1 else 0))


def _own_slots(p: Precision, n: int, sets: int, rows: int, columns: int) -> Slots | None:
    """Choose slots that are one core's each, or None where there are too few points for all cores."""
    cores, sums = p.runtime.device.compute_units, rows * columns * PAIR_SUMS * np.dtype(p.sum).itemsize
    splits = min(-(-cores // sets), max(1, n // OWN_POINTS))
    if (splits * sets < cores and rows * columns * n > SMALL) or sums > OWN_BATCH:
        return None
    most = OWN_POINTS if sums < LARGE_SUMS else MORE_POINTS
    whole = padded(n, p.lanes)
    runs = -(-whole // (splits * most))
    length = padded(-(-whole // (runs * splits)), p.lanes)
    batch = max(1, min(sets, max(LEAST_ITEMS * cores, OWN_BATCH // sums) // splits))
    return Slots(batch, splits, length, length + p.lanes, min(batch * splits, LEAST_ITEMS * cores))
