"""Moments of power on shells of |f|, by the two-group product in blocks that are reduced at once.

The frequencies of each group are sorted by |f|^2. Those that make up a ball or a band with one frequency of
the other group are then consecutive, and only they are evaluated. Memory is that of one block in any
dimension.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.coordinate_rounding import coordinates, rounded_at_worst
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.cube_product import CubeProduct
from gbnbench.analysis.spectrum.evaluators.device_evaluator import DeviceEvaluator
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.point_blocks import POINTS, amplitudes_of_sets, merged_errors
from gbnbench.analysis.spectrum.evaluators.point_slots import TABLE_BYTES, tile_rows
from gbnbench.analysis.spectrum.evaluators.row_runs import slots_of_all_rows
from gbnbench.analysis.spectrum.evaluators.two_group_product import norms_of, product_errors
from gbnbench.analysis.spectrum.evaluators.work_model import ENTRY, SHELL, TILE, device_cost
from gbnbench.analysis.spectrum.request import Frequencies, Progress, SpectrumRequest
from gbnbench.analysis.spectrum.shell_moments import ShellMoments
from gbnbench.analysis.spectrum.sorted_groups import SortedGroup, count_pairs, two_sorted_groups
from gbnbench.core.torus import FloatArray

BLOCK_ROWS, BLOCK_COLUMNS = 510, 1024  # frequencies of a block's two groups: 17 MB of amplitudes
BIN_BYTES = 64 << 20  # of the moments of all strips
SUMMED = 13  # times that a block's sums are held while those over blocks of points are added up
STRIPS = 4  # strips of rows for each core


@dataclass(frozen=True)
class ShellProduct(DeviceEvaluator):
    """The two-group product over shells on the OpenCL device, in memory that does not grow with d."""

    method: ClassVar[str] = "shells"
    title: ClassVar[str] = "streamed two-group product"
    serves: ClassVar[tuple[Frequencies, ...]] = ("shells",)

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the cost of the blocks that hold a frequency of the shells."""
        points = request.n * request.realizations
        a, b = two_sorted_groups(request.d, request.fmax, request.high)
        count = count_pairs(a, b, request.low, request.high)
        blocks = max(1.0, count / (BLOCK_ROWS * BLOCK_COLUMNS))
        entries = blocks * min(BLOCK_ROWS + BLOCK_COLUMNS, len(a.order) + len(b.order))
        work = (TILE * count + ENTRY * entries) * points + SHELL * count
        launches = 3 * blocks * max(1.0, points / 1024)
        held = 3 * (8 << 20) + TABLE_BYTES + BIN_BYTES
        if request.n <= POINTS:
            return device_cost(self.on_device, request, work, launches, held)
        rows, columns = min(BLOCK_ROWS, len(a.order)), min(BLOCK_COLUMNS, len(b.order))
        held += SUMMED * 64 * rows * columns  # eight sums a pair of frequencies
        return device_cost(self.on_device, request, work, launches, held, points=POINTS)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the product's errors, coordinates being exact in double and rounded at worst in float."""
        p, n = self.on_device, request.n
        at = rounded_at_worst(n, request.d, p.name)
        if n <= POINTS:
            return product_errors(p, n, slots_of_all_rows(p, request), request.fmax, at)
        slots = slots_of_all_rows(p, replace(request, n=POINTS, realizations=1))
        return merged_errors(p, product_errors(p, POINTS, slots, request.fmax, at), at)

    def shells(
        self,
        x: FloatArray,
        request: SpectrumRequest,
        weights: FloatArray | None,
        progress: Progress | None = None,
    ) -> tuple[ShellMoments, Errors]:
        """Evaluate the shells, as ``Evaluator.shells`` describes it.

        In one dimension there is no second group of axes, and the whole cube is evaluated.
        """
        if request.d == 1:
            return CubeProduct(self.precision).shells(x, request, weights, progress)
        p = self.on_device
        return shell_moments(p, x, request.fmax, request.low, request.high, weights, progress)


def shell_moments(
    p: Precision,
    x: FloatArray,
    fmax: int,
    low: int,
    high: int,
    weights: FloatArray | None = None,
    progress: Progress | None = None,
) -> tuple[ShellMoments, Errors]:
    """Evaluate the moments of power on every shell low <= |f|^2 <= high of the cube |f_a| <= fmax.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    x : (sets, n, d) float64
        Checked points.
    fmax : int
        Largest harmonic on each axis.
    low, high : int
        Smallest and largest |f|^2; shells beyond fmax^2 are cut by the cube.
    weights : (sets or 1, n) float64, optional
        Weights of the points.
    progress : callable, optional
        Called with the share done.

    Returns
    -------
    moments : ShellMoments
        Moments of the shells that hold a frequency; DC is left out.
    errors : Errors
        Errors of the square root of the power of any one set.
    """
    sets, n, d = x.shape
    at, worst = coordinates(x, p.name, weights), Errors(0.0, 0.0)
    a, b = two_sorted_groups(d, fmax, high)
    bins = high - low + 1
    device = p.runtime.device
    strips = max(1, min(STRIPS * device.compute_units, BIN_BYTES // (24 * bins)))
    out = p.runtime.upload(np.zeros(strips * bins * 2, p.sum))
    counts = p.runtime.upload(np.zeros(strips * bins, np.uint32))
    norms = p.runtime.upload(norms_of(weights, sets, n).astype(p.sum))
    work, done = (1 if progress is None else _pairs(p, a, b, low, high)), 0
    power = p.runtime.empty(2 * BLOCK_ROWS * BLOCK_COLUMNS * np.dtype(p.sum).itemsize)
    for rows, columns, bounds in blocks(a, b, low, high, tile_rows(p)):
        leading, trailing = Group(a.axes, a.order[rows]), Group(b.axes, b.order[columns])
        limits = p.runtime.upload(bounds)
        pairs = int((bounds[:, 1] - bounds[:, 0]).sum())

        def tell(share: float, done: int = done, pairs: int = pairs) -> None:
            if progress is not None:
                progress(min((done + share * pairs) / work, 1.0))

        evaluated = amplitudes_of_sets(p, x, weights, (leading, trailing), bounds, fmax, at, tell)
        for product, amplitude, splits, first, batch, errors in evaluated:
            worst = worst.or_larger(errors)
            width = product.frequencies.columns
            each = 1 if p.runtime.group > 1 else width
            product.program.run(
                "pair_power",
                (-(-width // each), leading.count),
                (1, 1),
                amplitude,
                limits,
                np.uint32(leading.count),
                np.uint32(width),
                np.uint32(each),
                np.uint32(splits),
                np.uint32(batch),
                norms,
                np.uint32(first),
                power,
            )
        p.program("shells.cl", ROWS=tile_rows(p)).run(
            "shells",
            (strips,),
            (1,),
            power,
            limits,
            np.uint32(leading.count),
            np.uint32(width),
            p.runtime.upload(a.square[rows].astype(np.uint32)),
            p.runtime.upload(b.square[columns].astype(np.uint32)),
            np.uint32(low),
            np.uint32(high),
            p.sum(sets),
            out,
            counts,
        )
        p.runtime.finish()
        done += pairs
        tell(0.0, done)
    parts = p.runtime.download(out, np.empty((strips, bins, 2), p.sum)).astype(np.float64)
    count = p.runtime.download(counts, np.empty((strips, bins), np.uint32))
    return merged(count.astype(np.int64), parts[..., 0], parts[..., 1], low), worst


def _pairs(p: Precision, a: SortedGroup, b: SortedGroup, low: int, high: int) -> int:
    """Count the columns that all row tiles take, wanted ones and others."""
    each = blocks(a, b, low, high, tile_rows(p))
    return sum(int(np.diff(bounds.astype(np.int64)).sum()) for *_, bounds in each)


def blocks(
    a: SortedGroup, b: SortedGroup, low: int, high: int, rows: int
) -> Iterator[tuple[slice, slice, NDArray[np.uint32]]]:
    """List the blocks that hold a pair of the band.

    Parameters
    ----------
    a, b : SortedGroup
        The leading and the trailing axes.
    low, high : int
        Smallest and largest |f|^2.
    rows : int
        Rows of a register tile.

    Yields
    ------
    rows, columns : slice
        Leading and trailing frequencies of the block.
    bounds : (row tiles, 2) uint32
        For each tile of rows the first and the end of the columns that are wanted.
    """
    for i in range(0, len(a.order), BLOCK_ROWS):
        squares = a.square[i : i + BLOCK_ROWS]
        nearest = squares[::rows]
        farthest = squares[np.minimum(np.arange(rows - 1, len(squares) + rows - 1, rows), len(squares) - 1)]
        start = np.searchsorted(b.square, low - farthest)
        end = np.searchsorted(b.square, high - nearest, side="right")
        for j in range(0, len(b.order), BLOCK_COLUMNS):
            stop = min(j + BLOCK_COLUMNS, len(b.order))
            bounds = np.stack([np.clip(start, j, stop), np.clip(end, j, stop)], axis=1) - j
            bounds[:, 1] = np.maximum(bounds[:, 1], bounds[:, 0])
            if (bounds[:, 1] > bounds[:, 0]).any():
                yield slice(i, i + BLOCK_ROWS), slice(j, stop), bounds.astype(np.uint32)


def merged(count: NDArray[np.int64], mean: FloatArray, deviation: FloatArray, low: int) -> ShellMoments:
    """Merge the moments of strips shell by shell (Chan, Golub & LeVeque 1979).

    Parameters
    ----------
    count : (strips, bins) int64
        Frequencies that a strip met on each shell.
    mean, deviation : (strips, bins) float64
        Mean power of these, and sum of squared departures from it.
    low : int
        |f|^2 of the first bin.

    Returns
    -------
    ShellMoments
        Moments of the shells that hold a frequency.
    """
    total = count.sum(axis=0)
    held = total > 0
    count, mean, deviation, total = count[:, held], mean[:, held], deviation[:, held], total[held]
    middle = (count * mean).sum(axis=0) / total
    spread = deviation.sum(axis=0) + (count * (mean - middle) ** 2).sum(axis=0)
    return ShellMoments(low + np.flatnonzero(held), total, middle, spread)
