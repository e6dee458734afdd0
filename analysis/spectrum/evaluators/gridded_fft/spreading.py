"""Points on the device, ready to be carried to their grids by grid_spread.cl."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.bands import Bands, starts_of_whole
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid, transform_of_window
from gbnbench.core.torus import FloatArray

KEPT_POINTS = 1 << 16  # up to which weights of 1 are kept from call to call
# Types of the arguments from the points to the number of rows of a band, as ``Program.prepared`` takes them.
SPREAD_ARGUMENTS = (
    *(None, np.uint32, None, np.uint32),  # points and their stride, weights and theirs
    *(None, np.uint32, np.uint32, None),  # beginnings of the bands, their number, that of the runs, means
    *(np.uint32, np.uint32),  # nodes of an axis, rows of a band
)


@dataclass(frozen=True)
class SpreadPoints:
    """A batch of point sets on the device.

    Attributes
    ----------
    sets : int
        Sets of the batch.
    bands : int
        Bands of a set.
    rows : int
        Nodes of the first axis in a band.
    runs : int
        Runs in which the points are summed.
    arguments : tuple
        Of the kernels, from the points to the number of rows of a band.
    """

    sets: int
    bands: int
    rows: int
    runs: int
    arguments: tuple[Any, ...]


def spread_points(p: Precision, grid: RealGrid, bands: Bands, weights: FloatArray | None) -> SpreadPoints:
    """Bring a batch of point sets to the device.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        Layout of a grid.
    bands : Bands
        The points.
    weights : (sets or 1, n) float64 or None
        Weights of the points, in the order before they were dealt to bands.

    Returns
    -------
    SpreadPoints
    """
    sets, _, n = bands.turns.shape
    rt = p.runtime
    if weights is None and n <= KEPT_POINTS and bands.count == 1:
        rest = _of_equal_points(p, grid, sets, n, bands.rows, bands.runs)
    else:
        rest = _rest(p, grid, bands.starts, n, bands.rows, bands.runs, weights, bands.order)
    return SpreadPoints(sets, bands.count, bands.rows, bands.runs, (rt.shared(bands.turns), *rest))


@lru_cache(maxsize=32)
def _of_equal_points(
    p: Precision, grid: RealGrid, sets: int, n: int, rows: int, runs: int
) -> tuple[Any, ...]:
    """Arguments after the points, of whole sets of weight 1: their buffers are only read."""
    return _rest(p, grid, starts_of_whole(sets, n), n, rows, runs, None, None)


def _rest(
    p: Precision,
    grid: RealGrid,
    starts: NDArray[np.uint32],
    n: int,
    rows: int,
    runs: int,
    weights: FloatArray | None,
    order: NDArray[np.intp] | None,
) -> tuple[Any, ...]:
    """Arguments after the points."""
    sets, ends = starts.shape
    values, stride = _in_order(p, weights, order, sets, n)
    return (
        np.uint32(n),
        p.runtime.upload(values),
        np.uint32(stride),
        p.runtime.upload(starts),
        np.uint32(ends - 1),
        np.uint32(runs),
        _means(p, grid, weights, sets, n, runs),
        np.uint32(grid.nodes),
        np.uint32(rows),
    )


def _means(
    p: Precision, grid: RealGrid, weights: FloatArray | None, sets: int, n: int, runs: int
) -> Any:  # a buffer
    """Mean of a node in each run of each set."""
    mean = transform_of_window(grid)[0] ** grid.d / grid.nodes**grid.d / runs
    each = np.broadcast_to(mean * (n if weights is None else weights.sum(axis=1)), (sets,))
    return p.runtime.upload(each.astype(p.real))


def _in_order(
    p: Precision, weights: FloatArray | None, order: NDArray[np.intp] | None, sets: int, n: int
) -> tuple[NDArray[Any], int]:
    """Bring weights in the order of the points; the numbers from one set's to the next set's, 0 if shared."""
    if weights is None:
        return np.ones(n, p.real), 0
    if order is not None:
        return np.take_along_axis(np.broadcast_to(weights, (sets, n)), order, axis=1).astype(p.real), n
    return weights.astype(p.real), 0 if len(weights) == 1 else n
