"""Bands of a grid's first axis, and the runs in which the points of a crowded set are summed."""

from __future__ import annotations

import math

from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid

CACHE_BYTES = 1 << 20  # of a grid that needs no sorting
BAND_ROWS = 64  # rows of a band of a larger grid, in two dimensions
DIVIDED_FROM = 1 << 22  # nodes that the points of a set reach, from which it is worth dividing among cores
CROWDED = 32  # points in a bin from which they are summed in several runs
RUN_SHARE, SPACE_RUN_SHARE = 0.25, 0.05  # nodes added up for the runs, over those reached; in space far ones


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
        1 where no bin is crowded, as deal_points.cl counts them.
    """
    return 1 if crowd <= CROWDED else min(math.isqrt(crowd), most_runs(grid, n))


def most_runs(grid: RealGrid, n: int) -> int:
    """Count the runs that take no more than a share of the time of spreading.

    Parameters
    ----------
    grid : RealGrid
        The grid.
    n : int
        Points of a set.

    Returns
    -------
    int
        At least 1.
    """
    share = RUN_SHARE if grid.d < 3 else SPACE_RUN_SHARE
    return max(1, int(share * n * grid.width**grid.d / grid.size))


def division(cores: int, grid: RealGrid, sets: int, n: int) -> tuple[int, int]:
    """Count the bands of a set that keep all cores busy, or fit in the cache, and the rows of one.

    Parameters
    ----------
    cores : int
        Cores of the device.
    grid : RealGrid
        The grid.
    sets, n : int
        Sets of a batch, and points of each.

    Returns
    -------
    bands, rows : int
        A band has at least the window's reach, and whole bins where there are several.
    """
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
