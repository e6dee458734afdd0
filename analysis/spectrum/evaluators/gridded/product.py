"""The gridded product: one axis carried to a grid by a window, the others summed as they are.

F(f_0, g) = sum over nodes of exp(-2 pi i f_0 m / M) G_m(g) / window's transform at f_0, where G_m(g) is the
sum over the few points near a node of the window times exp(-2 pi i g.x'). So n points become M nodes, five
for each f_0 >= 0, in the two-group product, after 16 multiply-adds a point and frequency g. No digit is
lost: phases and places in a cell are exact, and in double the window leaves out less than rounding does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import SUM_POINTS, Precision, padded
from gbnbench.analysis.spectrum.digits import Division, whole_axes
from gbnbench.analysis.spectrum.error_model import BITS, UNIT, Coordinates, Errors, coordinates, sum_errors
from gbnbench.analysis.spectrum.evaluators.cube_product import CubeWriter, cube_powers
from gbnbench.analysis.spectrum.evaluators.gridded.kaiser_bessel import Window, nodes_for, window
from gbnbench.analysis.spectrum.evaluators.two_group_product import (
    Points,
    Slots,
    norms_of,
    whole_frequencies,
)
from gbnbench.core.torus import FloatArray

WIDTH = {"double": 16, "float": 8}
DEGREE = {"double": 18, "float": 11}
CHUNK_BYTES = 4 << 20  # tables of the points that are carried to the grid together
BATCH_BYTES = 8 << 20  # of the sets of a batch
GRIDS_A_TABLE = 16  # how much larger a batch's grids and amplitudes may be
PLAIN_FROM = 4096  # points, beyond which the first axis' own frequencies are summed plainly
KEPT_FROM = 1 << 12  # points near a node, from which on the rounding of their sum is kept


@dataclass(frozen=True)
class Sorted:
    """A batch of sets sorted by cell of the first axis.

    Attributes
    ----------
    x : (sets, n, d) float64
        Points in that order.
    order : (sets, n) intp
        Their former places.
    place : (sets, n) float64
        Where in its cell each lies, [0, 1).
    starts : (sets, nodes + 1) uint32
        Where each cell's points begin.
    """

    x: FloatArray
    order: NDArray[np.intp]
    place: FloatArray
    starts: NDArray[np.uint32]

    def crowd(self, width: int) -> int:
        """Points that reach the node that most of them reach."""
        count = np.diff(self.starts.astype(np.int64), axis=1)
        running = np.cumsum(np.concatenate([count, count[:, :width]], axis=1), axis=1)
        return int((running[:, width:] - running[:, :-width]).max())


def sorted_by_cell(x: FloatArray, nodes: int, bits: int) -> Sorted:
    """Sort (sets, n, d) points; cells and places are exact for fixed-point coordinates of so many bits."""
    sets = len(x)
    if bits == 64:
        turns = np.rint(x[..., 0] * 2.0**64).astype(np.uint64)
    else:
        turns = (np.rint(x[..., 0] * 2.0**32).astype(np.uint64) % np.uint64(1 << 32)) << np.uint64(32)
    low, half = np.uint64(0xFFFFFFFF), np.uint64(32)
    size = np.uint64(nodes)
    cell = ((turns >> half) * size + ((turns & low) * size >> half) >> half).astype(np.int64)
    place = np.minimum((turns * size) * 2.0**-64, 1 - 2.0**-53)
    order = np.argsort(cell.astype(np.uint32 if nodes >= 1 << 16 else np.uint16), axis=1, kind="stable")
    flat = (cell + np.arange(sets)[:, None] * nodes).ravel()
    ends = np.cumsum(np.bincount(flat, minlength=sets * nodes).reshape(sets, nodes), axis=1)
    starts = np.zeros((sets, nodes + 1), np.uint32)
    starts[:, 1:] = ends
    rows = np.arange(sets)[:, None]
    return Sorted(x[rows, order], order, place[rows, order], starts)


@lru_cache(maxsize=8)
def node_turns(nodes: int, bits: int) -> NDArray[np.uint64]:
    """Multiples of 1/nodes as fixed-point turns."""
    return np.array([((m << (bits + 1)) // nodes + 1) >> 1 for m in range(nodes)], np.uint64)


def gridded_powers(
    p: Precision,
    x: FloatArray,
    fmax: int,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
) -> tuple[FloatArray, Errors]:
    """Power at all |f_a| <= fmax; parameters and what is returned as those of ``cube_powers``; d >= 2."""
    sets, n, d = x.shape
    grid = Grid(p, n, d, sets, fmax)
    norms, axes = norms_of(weights, sets, n), whole_axes(d, fmax)
    gains = transform_at(p, fmax) ** 2
    divided = Division(axes[:1], axes[1:], 0, 0)
    writer = CubeWriter(p, divided, fmax, norms, d, half=half, mean=mean, gains=gains)
    crowd = 0
    for first in range(0, sets, grid.sets):
        some = slice(first, first + grid.sets)
        held = sorted_by_cell(x[some], grid.nodes, BITS[p.name])
        crowd = max(crowd, held.crowd(grid.window.width))
        grid.carry(
            held, weights if weights is None or len(weights) == 1 else weights[some], crowd > KEPT_FROM
        )
        grid.multiply(len(held.x))
        writer.add(grid.program, grid.amplitude, 1, first, len(held.x), 0, fmax + 1)
    power = writer.result()
    errors = gridded_errors(p, fmax, crowd, coordinates(x, p.name, weights))
    at = (2 * fmax + 1) ** (d - 1) // 2
    if n <= PLAIN_FROM:
        totals = np.full(sets, float(n)) if weights is None else weights.sum(axis=1) ** 2 / norms
        flat = power.reshape(*power.shape[:-d], -1)
        flat[..., (0 if half else fmax) * (2 * at + 1) + at] = totals.mean() if mean else totals
        return power, errors
    # Where g = 0 all that is carried is positive: its rounding, about 0.2 units times sqrt(n), stands out.
    line, plain = cube_powers(p, x[..., :1], fmax, weights, half, mean)
    power.reshape(*line.shape, -1)[..., at] = line
    return power, Errors(max(errors.rms, plain.rms), max(errors.bound, plain.bound))


class Grid:
    """Buffers and programs for sets of n points in d dimensions, whose first axis is carried to a grid.

    Attributes
    ----------
    nodes : int
        Of the grid.
    sets : int
        Of a batch.
    amplitude
        Buffer of a batch's amplitudes.
    """

    def __init__(self, p: Precision, n: int, d: int, sets: int, fmax: int) -> None:
        self._p, self._d = p, d
        axes = whole_axes(d, fmax)
        f = self._frequencies = whole_frequencies(p, d, axes[:1], axes[1:])
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
        self._slots = Slots(self.sets, 1, self._chunk)
        self._point_size = per_point * self._chunk
        self._trailing_size = 2 * f.table_sizes(self._folded)[1]
        self._points = p.runtime.empty(self._point_size * self.sets * real)
        self._leading = node_table(p, d, fmax)
        self._grid = p.runtime.empty(self._grid_size * self.sets * real)
        self._trailing = p.runtime.empty(self._trailing_size * self.sets * real)
        self.amplitude = p.runtime.empty(self.sets * pairs)
        self._ones = p.runtime.upload(np.ones(self._stride, p.real))
        self._coefficients = window_buffer(p)

    def carry(self, held: Sorted, weights: FloatArray | None, kept: bool) -> None:
        """Carry a batch's cosines and sines to the nodes, and fold the grid in two."""
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
        points = Points(p.runtime.upload(p.turns(held.x, self._stride)), self._ones, self._stride, 0)
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

    def _reached(self, held: Sorted, begin: int, end: int) -> tuple[int, int]:
        """First node and number of groups of nodes that points begin .. end of the batch reach."""
        lanes, half = self._p.lanes, self.window.width // 2
        if len(held.x) > 1 or end - begin >= held.x.shape[1]:
            return 0, self.nodes // lanes
        low = int(np.searchsorted(held.starts[0], begin, side="right")) - 1 - half + 1
        high = int(np.searchsorted(held.starts[0], end - 1, side="right")) - 1 + half
        first = low // lanes * lanes
        groups = min((high - first) // lanes + 1, self.nodes // lanes)
        return first % self.nodes, groups

    def multiply(self, count: int) -> None:
        """Leave the amplitudes of a batch that was carried."""
        self._frequencies.multiply(
            *(self.program, (self._leading, self._trailing), (0, self._trailing_size), self._folded, count),
            bounds=self._frequencies.all_columns,
            amplitude=self.amplitude,
        )


@lru_cache(maxsize=8)
def transform_at(p: Precision, fmax: int) -> FloatArray:
    """Transform of the window at f = 0 .. fmax."""
    return window(WIDTH[p.name], DEGREE[p.name]).transform(fmax, nodes_for(fmax, p.lanes))


@lru_cache(maxsize=4)
def window_buffer(p: Precision) -> Any:
    """Coefficients of the window on the device."""
    shape = window(WIDTH[p.name], DEGREE[p.name])
    return p.runtime.upload(padded_coefficients(shape, p.lanes).astype(p.real))


@lru_cache(maxsize=4)
def node_table(p: Precision, d: int, fmax: int) -> Any:
    """Table of the first axis at the nodes, kept from call to call as a transform's twiddle factors are."""
    axes = whole_axes(d, fmax)
    f = whole_frequencies(p, d, axes[:1], axes[1:])
    nodes = nodes_for(fmax, p.lanes)
    folded = padded(nodes // 2 + 1, p.lanes)
    at_nodes = np.zeros((1, d, folded), p.turn)
    at_nodes[0, 0] = node_turns(nodes, BITS[p.name])[:folded]
    ones = p.runtime.upload(np.ones(folded, p.real))
    points = Points(p.runtime.upload(at_nodes), ones, folded, 0)
    table = p.runtime.empty(f.table_sizes(folded)[0] * np.dtype(p.real).itemsize)
    f.tabulate(f.program(folded=True), (0, 1), points, (table, table), Slots(1, 1, folded), (0, 0), 1)
    return table


def padded_coefficients(shape: Window, lanes: int) -> FloatArray:
    """Coefficients with a lane's zeros on either side: nodes beyond the support find the window 0."""
    return np.pad(shape.coefficients, ((0, 0), (lanes, lanes)))


def gridded_errors(p: Precision, fmax: int, crowd: int, at: Coordinates) -> Errors:
    """Errors of sqrt(power) where at most ``crowd`` points reach a node."""
    shape = window(WIDTH[p.name], DEGREE[p.name])
    nodes = nodes_for(fmax, p.lanes)
    transform = transform_at(p, fmax)
    magnified = float(transform[0] / transform.min())
    runs = -(-crowd // SUM_POINTS)
    in_run = min(crowd, SUM_POINTS)
    beyond = 2 if crowd > KEPT_FROM else runs
    # The points' table and the window; then the nodes' table and their sum.
    sums = "double" if p.sum is np.float64 else "float"
    to_nodes = sum_errors(p.name, p.name, Coordinates(0, 0, at.share), 0, 2, in_run, beyond)
    steps = min(SUM_POINTS, nodes // 2 // p.lanes + 1)
    from_nodes = sum_errors(p.name, sums, Coordinates(0, 0, at.share), 0, 2, steps, p.lanes.bit_length() + 1)
    rounded = 2 * math.pi * fmax
    bound = magnified * (to_nodes.bound + from_nodes.bound) + at.share * (2 * shape.left_out)
    typical = math.hypot(to_nodes.rms, from_nodes.rms, UNIT[p.name] * math.sqrt(0.2 * runs))
    typical *= math.sqrt(magnified) / 2
    return Errors(math.hypot(typical, rounded / math.sqrt(6) * at.scattered), bound + rounded * at.coherent)


def least_gridded(precision: str) -> int:
    """Smallest fmax whose grid is wide enough for the window."""
    f = 1
    while not griddable(2, f, precision):
        f += 1
    return f


def griddable(d: int, fmax: int, precision: str) -> bool:
    """Whether there is a first axis among others whose grid is wider than the window."""
    return d >= 2 and nodes_for(fmax, 1) >= 3 * WIDTH[precision]
