"""Points dealt out to bands of a grid's first axis, sorted by bin, and how crowded the bins are."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.bins import bin_counts, bins, bins_nearly
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid
from gbnbench.core.torus import FloatArray

CACHE_BYTES = 1 << 20  # of a grid that needs no sorting
BAND_ROWS = 64  # rows of a band of a larger grid, in two dimensions
DIVIDED_FROM = 1 << 22  # nodes that the points of a set reach, from which it is worth dividing among cores
CROWDED = 32  # points in a bin from which they are summed in several runs
RUN_SHARE, SPACE_RUN_SHARE = 0.25, 0.05  # nodes added up for the runs, over those reached; in space far ones


@dataclass(frozen=True)
class BinnedPoints:
    """Point sets with the bins of their points, which are a window's cells wide.

    Attributes
    ----------
    x : (sets, n, d) float64
        The points.
    turns : (sets, d, n) uint64 or uint32
        Fixed-point coordinates.
    bin_of : (sets, n) int64
        Bins of points: 0 .. grid.bins**d - 1, the last axis fastest. Where sets are not divided into bands,
        a rounding may take a point on a border to the bin beside it.
    counts : (sets, grid.bins**d) int64
        Points of each bin.
    crowd : int
        Points in the fullest bin of any set.
    """

    x: FloatArray
    turns: NDArray[Any]
    bin_of: NDArray[np.int64]
    counts: NDArray[np.int64]
    crowd: int

    def __getitem__(self, sets: slice) -> BinnedPoints:
        """Give some of the sets."""
        counts = self.counts[sets]
        return BinnedPoints(self.x[sets], self.turns[sets], self.bin_of[sets], counts, int(counts.max()))


@dataclass(frozen=True)
class Bands:
    """A batch of point sets, each in bands of its grid.

    Attributes
    ----------
    turns : (sets, d, n) uint64 or uint32
        Fixed-point coordinates, in the order of their bands.
    order : (sets, n) intp or None
        The points' indices before; None where they were left as they were.
    starts : (sets, bands + 1) uint32
        Index of the first point of each band, and n.
    rows : int
        Nodes of the first axis in a band.
    crowd : int
        Points in the fullest bin; bins are a window's cells wide, so that a node is reached from 2^d of them.
    runs : int
        Runs in which the points are summed.
    """

    turns: NDArray[Any]
    order: NDArray[np.intp] | None
    starts: NDArray[np.uint32]
    rows: int
    crowd: int
    runs: int

    @property
    def count(self) -> int:
        """Number of bands."""
        return int(self.starts.shape[1]) - 1


def binned(p: Precision, grid: RealGrid, x: FloatArray) -> BinnedPoints:
    """Find the bins of points, and count the points of each.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        The grid.
    x : (sets, n, d) float64
        Points of the unit torus.

    Returns
    -------
    BinnedPoints
    """
    sets, n, _ = x.shape
    turns = p.turns(x, n)
    divided = _division(p.runtime.device.compute_units, grid, sets, n)[0] > 1
    bin_of = bins(turns, grid) if divided else bins_nearly(x, grid)
    counts = bin_counts(bin_of, grid)
    return BinnedPoints(x, turns, bin_of, counts, int(counts.max()))


def dealt_to_bands(p: Precision, grid: RealGrid, points: BinnedPoints) -> Bands:
    """Deal the points of each set out to as many bands as keep all cores busy, or fit in the cache.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        The grid.
    points : BinnedPoints
        Point sets, with their bins on this grid.

    Returns
    -------
    Bands
    """
    turns, bin_of, counts, crowd = points.turns, points.bin_of, points.counts, points.crowd
    sets, n = bin_of.shape
    runs = run_count(grid, n, crowd)
    bands, rows = _division(p.runtime.device.compute_units, grid, sets, n)
    if grid.d == 1 or (bands == runs == 1 and grid.size * grid.itemsize <= CACHE_BYTES):
        return Bands(turns, None, starts_of_whole(sets, n), rows, crowd, runs)
    starts = np.full((sets, bands + 1), n, np.uint32)
    starts[:, 0] = 0
    few = counts.shape[1] <= 1 << 16  # NumPy sorts 16 bits by radix
    order = np.argsort(bin_of.astype(np.uint16) if few else bin_of, axis=1, kind="stable")
    up_to_row = counts.reshape(sets, grid.bins, -1).sum(axis=2).cumsum(axis=1)
    starts[:, 1:-1] = up_to_row[:, np.arange(1, bands) * (rows // grid.width) - 1]
    return Bands(np.take_along_axis(turns, order[:, None], axis=2), order, starts, rows, crowd, runs)


@lru_cache(maxsize=64)
def starts_of_whole(sets: int, n: int) -> NDArray[np.uint32]:
    """Give the beginnings of bands of sets that are not divided.

    Parameters
    ----------
    sets, n : int
        Number of sets, and points of each.

    Returns
    -------
    (sets, 2) uint32
        0 and n, to be read only.
    """
    return np.tile(np.array([0, n], np.uint32), (sets, 1))


def run_count(grid: RealGrid, n: int, crowd: int) -> int:
    """Count the runs: the rounding of a sum goes with crowd / runs + runs, and a run passes over the grid.

    Parameters
    ----------
    grid : RealGrid
        The grid.
    n : int
        Points of a set.
    crowd : int
        Points in the fullest bin.

    Returns
    -------
    int
        1 where no bin is crowded.
    """
    if crowd <= CROWDED:
        return 1
    share = RUN_SHARE if grid.d < 3 else SPACE_RUN_SHARE
    affordable = share * n * grid.width**grid.d / grid.size
    return max(1, min(math.isqrt(crowd), int(affordable)))


def _division(cores: int, grid: RealGrid, sets: int, n: int) -> tuple[int, int]:
    """Count the bands of a set, and the rows of one: at least the window's reach, and whole bins."""
    bands = 1
    if grid.d == 2 and grid.size * grid.itemsize > CACHE_BYTES:  # a band stays in the cache
        bands = max(1, grid.nodes // BAND_ROWS)
    elif grid.d > 1 and sets % cores and n * grid.width**grid.d > DIVIDED_FROM:
        bands = max(1, min(cores, grid.nodes // grid.width))
    for count in range(bands, 1, -1):
        rows = -(-grid.nodes // (count * grid.width)) * grid.width
        whole, last = divmod(grid.nodes, rows)
        if last == 0 or last >= grid.width:  # a window must reach no farther than the next band
            return whole + (last > 0), rows
    return 1, grid.nodes
