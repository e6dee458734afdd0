"""The grid of a gridded product on the device, whose nodes take the place of the points."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.digits import whole_axes
from gbnbench.analysis.spectrum.evaluators.device_points import DevicePoints
from gbnbench.analysis.spectrum.evaluators.frequency_tables import whole_group_tables
from gbnbench.analysis.spectrum.evaluators.gridded.cells import SortedPoints
from gbnbench.analysis.spectrum.evaluators.gridded.node_tables import node_table
from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import Window, nodes_for, window
from gbnbench.analysis.spectrum.evaluators.point_slots import Slots
from gbnbench.analysis.spectrum.evaluators.table_product import multiply
from gbnbench.core.torus import FloatArray

WIDTH = {"double": 16, "float": 8}  # cells of the window
DEGREE = {"double": 18, "float": 11}  # degree of its polynomials
CHUNK_BYTES = 4 << 20  # of the tables of points that are carried in one launch
BATCH_BYTES = 8 << 20  # of a batch's tables
GRIDS_A_TABLE = 16  # a batch's grids and amplitudes may be this many times larger than its tables


class Grid:
    """Buffers and programs that carry the first axis of point sets to a grid and evaluate amplitudes from it.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    n, d, sets : int
        Points of a set, dimension, and number of sets.
    fmax : int
        Largest harmonic on each axis.

    Attributes
    ----------
    nodes : int
        Nodes of the grid.
    sets : int
        Sets of a batch.
    amplitude : buffer
        Amplitudes of a batch.
    """

    def __init__(self, p: Precision, n: int, d: int, sets: int, fmax: int) -> None:
        self._p, self._d = p, d
        axes = whole_axes(d, fmax)
        f = self._frequencies = whole_group_tables(p, d, axes[:1], axes[1:])
        self.window = window(WIDTH[p.name], DEGREE[p.name])
        self.nodes = nodes_for(fmax, p.lanes)
        self.program, self._by_point = f.program(folded=True), f.program_by_point()
        self._folded = padded(self.nodes // 2 + 1, p.lanes)
        real = np.dtype(p.real).itemsize
        per_point = padded(f.b.count, p.lanes) * 2
        self._chunk = min(
            padded(n, p.lanes), max(p.lanes, CHUNK_BYTES // (per_point * real) // p.lanes * p.lanes)
        )
        self._stride = padded(n, self._chunk)
        self._grid_size = f.table_sizes(self.nodes)[1]
        pairs = f.tiles * f.rows * f.columns * 4 * np.dtype(p.sum).itemsize
        held = max(per_point * self._stride * real, (self._grid_size * real + pairs) // GRIDS_A_TABLE)
        self.sets = max(1, min(sets, BATCH_BYTES // held))
        self._slots = Slots(self.sets, 1, self._chunk, self._chunk)
        self._point_size = per_point * self._chunk
        self._trailing_size = 2 * f.table_sizes(self._folded)[1]
        self._points = p.runtime.empty(self._point_size * self.sets * real)
        self._leading = node_table(p, d, fmax, self.nodes)
        self._grid = p.runtime.empty(self._grid_size * self.sets * real)
        self._trailing = p.runtime.empty(self._trailing_size * self.sets * real)
        if f.b.count < f.columns:
            p.runtime.clear(self._trailing, self._trailing_size * self.sets * real)  # columns beyond the last
        self.amplitude = p.runtime.empty(self.sets * pairs)
        self._ones = p.runtime.upload(np.ones(self._stride, p.real))
        self._coefficients = window_buffer(p)

    def carry(self, held: SortedPoints, weights: FloatArray | None, kept: bool) -> None:
        """Carry the cosines and sines of a batch to the nodes, and fold the grid in two.

        Parameters
        ----------
        held : SortedPoints
            The batch.
        weights : (sets or 1, n) float64 or None
            Weights of the points, in the order before sorting.
        kept : bool
            Keep the rounding of the sums at nodes, and add it at the end.
        """
        p, f = self._p, self._frequencies
        count, n, _ = held.x.shape
        weight, weight_stride = self._ones, 0
        if weights is not None:
            dealt = np.zeros((count, self._stride), p.real)
            dealt[:, :n] = np.take_along_axis(np.broadcast_to(weights, (count, n)), held.order, axis=1)
            weight, weight_stride = p.runtime.upload(dealt), self._stride
        place = np.zeros((count, self._stride), p.real)
        place[:, :n] = held.place
        places, starts = p.runtime.upload(place), p.runtime.upload(held.starts)
        points = DevicePoints(p.runtime.upload(p.turns(held.x, self._stride)), self._ones, self._stride, 0)
        program = p.program(
            "spread.cl",
            COLUMNS=f.width,
            WIDTH=self.window.width,
            DEGREE=self.window.degree,
            KEPT_SUMS=int(kept),
        )
        rest = self._grid
        if kept:
            rest = p.runtime.empty(self._grid_size * count * np.dtype(p.real).itemsize)
        once = n <= self._chunk
        if not once:
            for sums in {self._grid, rest}:
                p.runtime.clear(sums, self._grid_size * count * np.dtype(p.real).itemsize)
        for begin in range(0, n, self._chunk):
            tables, sizes = (self._leading, self._points), (0, self._point_size)
            f.tabulate(self._by_point, (1, 1), points, tables, self._slots, sizes, count, begin)
            first, groups = self._reached(held, begin, min(begin + self._chunk, n))
            program.run(
                "spread",
                (padded(groups, p.runtime.group), count),
                (p.runtime.group, 1),
                self._points,
                np.uint64(self._point_size),
                np.uint32(begin),
                np.uint32(self._chunk),
                np.uint32(f.b.count),
                places,
                starts,
                self._coefficients,
                np.uint32(self._stride),
                np.uint32(self.nodes),
                np.uint32(first),
                weight,
                np.uint32(weight_stride),
                self._grid,
                rest,
                np.uint64(self._grid_size),
                np.uint32(groups),
                np.uint32(once),
            )
        program.run(
            "fold",
            (padded(f.b.count, p.runtime.group), count),
            (p.runtime.group, 1),
            self._grid,
            np.uint64(self._grid_size),
            rest,
            np.uint32(self.nodes),
            np.uint32(f.b.count),
            np.uint32(self._folded),
            self._trailing,
            np.uint64(self._trailing_size),
        )

    def _reached(self, held: SortedPoints, begin: int, end: int) -> tuple[int, int]:
        """Give the first node and the number of groups of nodes that the points begin .. end reach."""
        lanes, half = self._p.lanes, self.window.width // 2
        if len(held.x) > 1 or end - begin >= held.x.shape[1]:
            return 0, self.nodes // lanes
        low = int(np.searchsorted(held.starts[0], begin, side="right")) - 1 - half + 1
        high = int(np.searchsorted(held.starts[0], end - 1, side="right")) - 1 + half
        first = low // lanes * lanes
        groups = min((high - first) // lanes + 1, self.nodes // lanes)
        return first % self.nodes, groups

    def multiply(self, count: int) -> None:
        """Evaluate the amplitudes of a batch that was carried, ``count`` sets."""
        multiply(
            *(
                self._frequencies,
                self.program,
                (self._leading, self._trailing),
                (0, self._trailing_size),
                self._folded,
                self._folded,
                count,
            ),
            bounds=self._frequencies.all_columns,
            amplitude=self.amplitude,
        )


@lru_cache(maxsize=8)
def window_transform(p: Precision, fmax: int) -> FloatArray:
    """Give the transform of the window of this precision.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    fmax : int
        Largest harmonic.

    Returns
    -------
    (fmax + 1,) float64
        Values at f = 0 .. fmax.
    """
    return window(WIDTH[p.name], DEGREE[p.name]).transform(fmax, nodes_for(fmax, p.lanes))


@lru_cache(maxsize=4)
def window_buffer(p: Precision) -> Any:
    """Upload the coefficients of the window of this precision; the buffer is kept."""
    shape = window(WIDTH[p.name], DEGREE[p.name])
    return p.runtime.upload(padded_coefficients(shape, p.lanes).astype(p.real))


def padded_coefficients(shape: Window, lanes: int) -> FloatArray:
    """Pad the coefficients with zeros on either side, so that the window is 0 at nodes beyond its support.

    Parameters
    ----------
    shape : Window
        The window.
    lanes : int
        Columns of zeros on each side.

    Returns
    -------
    (degree + 1, width + 2*lanes) float64
    """
    return np.pad(shape.coefficients, ((0, 0), (lanes, lanes)))
