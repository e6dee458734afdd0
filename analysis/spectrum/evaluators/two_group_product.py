"""Amplitudes at all sums of two groups' frequencies, as one real product of two tables.

The axes are divided in a leading and a trailing group (``digits.py``), whose half spaces are tabulated. Four
real sums over points give F(fa, fb) and F(fa, -fb), and Hermitian symmetry gives the other two quadrants.
This takes one multiply-add for each frequency and point, half of what a complex product would take.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import SUM_POINTS, Precision, padded
from gbnbench.analysis.spectrum.coordinate_rounding import NOT_ROUNDED, Coordinates
from gbnbench.analysis.spectrum.error_model import Errors, sum_errors
from gbnbench.analysis.spectrum.evaluators.device_points import DevicePoints
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.frequency_tables import (
    FrequencyTables,
    whole_group_tables,
)
from gbnbench.analysis.spectrum.evaluators.point_slots import (
    COMPENSATED_FROM,
    PAIR_SUMS,
    PART_SUMS,
    PLAIN_SUMS,
    Slots,
    choose_slots,
)
from gbnbench.analysis.spectrum.evaluators.slot_sums import SlotSums
from gbnbench.analysis.spectrum.evaluators.table_product import multiply
from gbnbench.analysis.spectrum.evaluators.turn_rows import TurnRows
from gbnbench.core.torus import FloatArray


class TwoGroupProduct:
    """Buffers and programs that evaluate the amplitudes of sets of n points in d dimensions.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    n, d, sets : int
        Points of a set, dimension, and number of sets.
    a, b : Group
        Leading and trailing group of frequencies.
    bounds : (row tiles, 2) uint32, optional
        For each tile of leading frequencies the first and the end of the trailing ones that are wanted; all
        if not given.

    Attributes
    ----------
    amplitude : buffer
        Amplitudes of one batch; layout in product.cl.
    amplitude_numbers : int
        How many numbers these are.
    slots : Slots
        Slots of a batch.
    stride : int
        Numbers from one coordinate of a set to the next.
    tables, sizes : (buffer, buffer), (int, int)
        Leading and trailing table of a batch, and numbers from one slot's to the next slot's.
    turns : TurnRows
        Fixed-point coordinates of a batch.
    rounded : Coordinates
        How far the coordinates of the last sets were rounded, which had no weights.
    nbytes : int
        Bytes of the tables and amplitudes of a batch.
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
        self.frequencies = whole_group_tables(p, d, a.axes, b.axes) if whole else FrequencyTables(p, d, a, b)
        rows, columns = self.frequencies.tiles * self.frequencies.rows, self.frequencies.columns
        self.slots = choose_slots(p, n, sets, rows, columns)
        self.stride = padded(n, self.slots.span)
        compensated = self.slots.sums(n) > COMPENSATED_FROM
        self._bounds = self.frequencies.all_columns if bounds is None else p.runtime.upload(bounds)
        self.program = self.frequencies.program(compensated)
        self.sizes = self.frequencies.table_sizes(self.slots.pitch)
        real, total = np.dtype(p.real).itemsize, np.dtype(p.sum).itemsize
        of_tables = [size * (self.slots.items or self.slots.count) * real for size in self.sizes]
        of_amplitudes = self.slots.count * rows * columns * (PAIR_SUMS if compensated else PLAIN_SUMS) * total
        self.amplitude_numbers = of_amplitudes // total
        self.nbytes = sum(of_tables) + of_amplitudes
        self.tables = p.runtime.empty(of_tables[0]), p.runtime.empty(of_tables[1])
        self.amplitude = p.runtime.empty(of_amplitudes)
        own_length = self.slots.length if p.runtime.device.is_cpu else None
        self.turns = TurnRows(p, min(sets, self.slots.sets), n, d, self.stride, own_length)
        self._own_slots = SlotSums(
            *(self.frequencies, self.program, self.slots, n, self.stride, self.turns),
            tables=self.tables,
            sizes=self.sizes,
            bounds=self._bounds,
            sums=self.amplitude,
        )
        self.nbytes += self.turns.nbytes
        self.rounded = NOT_ROUNDED

    def batches(self, x: FloatArray, weights: FloatArray | None = None) -> Iterator[tuple[int, int]]:
        """Evaluate the amplitudes of one batch of sets after another, and leave each on the device.

        Parameters
        ----------
        x : (sets, n, d) float64
            Points.
        weights : (sets or 1, n) float64, optional
            Weights of the points; 1 where not given.

        Yields
        ------
        first, count : int
            First set and number of sets whose amplitudes ``amplitude`` holds until the next batch.
        """
        slots = self.slots
        self.rounded = NOT_ROUNDED
        for first in range(0, len(x), slots.sets):
            batch = slice(first, first + slots.sets)
            shared = weights is None or len(weights) == 1
            reals = self.p.runtime.readable(x[batch])  # it lives until kernels have read it
            points = self.with_weights(weights if weights is None or shared else weights[batch])
            count = len(x[batch])
            if slots.items:
                self._own_slots(reals, points, count)
            else:
                self.turns(reals, count)
                for begin in range(0, self.stride, slots.span):
                    self.frequencies.tabulate(
                        *(self.program, (0, 2), points, self.tables, slots), self.sizes, count, begin
                    )
                    self.multiply(count, done=slots.sums(begin), all_sums=slots.sums(self.n))
            yield first, count
            self.p.runtime.finish()  # before the next points take the place of these, or nothing holds them
            if weights is None:
                self.rounded = self.rounded.or_larger(self.turns.coordinates(count))

    def with_weights(self, weights: FloatArray | None) -> DevicePoints:
        """Bring the weights of a batch to the device, beside the turns that are to be written.

        Parameters
        ----------
        weights : (sets or 1, n) float64 or None
            Their weights.

        Returns
        -------
        DevicePoints
        """
        if weights is None:
            return DevicePoints(self.turns.buffer, self._ones, self.stride, 0)
        own = self._upload_weights(weights)
        return DevicePoints(self.turns.buffer, own, self.stride, 0 if len(weights) == 1 else self.stride)

    @cached_property
    def _ones(self) -> Any:
        """The weights of points without weights."""
        return self._upload_weights(np.ones((1, self.n)))

    def _upload_weights(self, weights: FloatArray) -> Any:
        """Upload weights, which are 0 beyond the last point: (k, n) float64."""
        padded_weights = np.zeros((len(weights), self.stride), self.p.real)
        padded_weights[:, : self.n] = weights
        return self.p.runtime.upload(padded_weights)

    def multiply(self, sets: int, done: int = 0, all_sums: int = 1) -> None:
        """Multiply the tables of a batch.

        Parameters
        ----------
        sets : int
            Sets of the batch.
        done, all_sums : int
            Register sums of a slot that there are, and that there will be.
        """
        multiply(
            *(
                self.frequencies,
                self.program,
                self.tables,
                self.sizes,
                self.slots.length,
                self.slots.pitch,
                sets * self.slots.splits,
            ),
            bounds=self._bounds,
            amplitude=self.amplitude,
            done=done,
            all_sums=all_sums,
        )


@lru_cache(maxsize=256)
def product_errors(p: Precision, n: int, slots: Slots, fmax: int, at: Coordinates) -> Errors:
    """State the errors of sqrt(power), for terms of four cosines and three complex products.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    n : int
        Points of a set.
    slots : Slots
        Slots by which the points are summed.
    fmax : int
        Largest harmonic on an axis.
    at : Coordinates
        Rounding of the coordinates.

    Returns
    -------
    Errors
    """
    sums = slots.sums(n)
    beyond = (PART_SUMS + 2 if sums > COMPENSATED_FROM else sums) + slots.splits
    in_registers = min(SUM_POINTS, slots.length, n)  # points beyond the last weigh nothing and round nothing
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
