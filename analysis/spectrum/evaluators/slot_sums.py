"""Two groups' tables and their product on a CPU in one launch: each core makes its own turns and tables."""

from __future__ import annotations

from typing import Any

import numpy as np

from gbnbench.analysis.precision import padded
from gbnbench.analysis.spectrum.evaluators.device_points import DevicePoints
from gbnbench.analysis.spectrum.evaluators.frequency_tables import FrequencyTables
from gbnbench.analysis.spectrum.evaluators.point_slots import OWN_COLUMNS, Slots
from gbnbench.analysis.spectrum.evaluators.turn_rows import TurnRows
from gbnbench.opencl import Program, RepeatedLaunch


class SlotSums:
    """The launch that rounds, tabulates and multiplies the slots of a batch.

    Parameters
    ----------
    frequencies : FrequencyTables
        Layout of the tables.
    program : Program
        Kernels that ``FrequencyTables.program`` built.
    slots : Slots
        Slots of a batch, whose ``items`` is not 0.
    n, stride : int
        Points of a set, and numbers from one coordinate of a set to the next.
    tables, sizes : (buffer, buffer), (int, int)
        Leading and trailing tables of the work-items, and numbers from one's to the next one's.
    bounds : buffer
        First and end of the columns that each row tile takes.
    turns : TurnRows
        Where the turns go.
    sums : buffer
        What is written.
    """

    def __init__(
        self,
        frequencies: FrequencyTables,
        program: Program,
        slots: Slots,
        n: int,
        stride: int,
        turns: TurnRows,
        *,
        tables: tuple[Any, Any],
        sizes: tuple[int, int],
        bounds: Any,
        sums: Any,
    ) -> None:
        self._frequencies, self._program, self._slots = frequencies, program, slots
        self._turns = turns
        self._n, self._stride, self._tables, self._sizes = n, stride, tables, sizes
        self._bounds, self._sums = bounds, sums
        self._launches: dict[int, RepeatedLaunch] = {}

    def __call__(self, reals: Any, points: DevicePoints, sets: int) -> None:
        """Enqueue the launch.

        Parameters
        ----------
        reals : buffer
            Coordinates of the batch: (sets, n, d) float64.
        points : DevicePoints
            The batch, whose turns are written.
        sets : int
            Its number of sets.
        """
        stride = points.weight_stride
        if stride not in self._launches:
            self._launches[stride] = self._launch(stride)
        self._launches[stride](reals, points.weight, np.uint32(sets * self._slots.splits))

    def _launch(self, weight_stride: int) -> RepeatedLaunch:
        slots, f = self._slots, self._frequencies
        of_a_column = 2 * slots.length * np.dtype(f.p.real).itemsize
        return RepeatedLaunch(
            self._program,
            "slot_sums",
            (slots.items,),
            (1,),
            *(None, None, np.uint32),  # points, weights and slots, which each call gives
            np.uint32(self._n),
            self._turns.buffer,
            self._turns.lost,
            np.uint32(self._stride),
            np.uint32(f.d),
            np.uint32(weight_stride),
            *f.layout,
            self._tables[0],
            np.uint64(self._sizes[0]),
            self._tables[1],
            np.uint64(self._sizes[1]),
            np.uint32(slots.length),
            np.uint32(slots.pitch),
            np.uint32(slots.splits),
            np.uint32(slots.launches(self._n)),
            self._bounds,
            np.uint32(f.tiles),
            np.uint32(f.columns),
            np.uint32(f.zero_last),
            np.uint32(padded(max(1, OWN_COLUMNS // of_a_column), f.p.lanes)),
            self._sums,
            np.uint32(-(-slots.count // slots.items)),
        )
