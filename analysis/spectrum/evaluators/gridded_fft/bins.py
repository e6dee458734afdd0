"""Bins of a grid, which are a window's cells wide, and the points in each."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid
from gbnbench.core.torus import FloatArray

ROWS = 1 << 20  # points whose bins are found together
LESS = 1 - 2.0**-50  # so that no coordinate below 1 is rounded up to the end


def bins(turns: NDArray[Any], grid: RealGrid) -> NDArray[np.int64]:
    """Find the bins of points; they are a window's cells wide, but the last one of an axis may be narrower.

    Parameters
    ----------
    turns : (sets, d, n) uint64 or uint32
        Fixed-point coordinates.
    grid : RealGrid
        The grid.

    Returns
    -------
    (sets, n) int64
        0 .. grid.bins**d - 1, the last axis fastest.
    """
    if turns.shape[2] > ROWS:
        return _by_blocks(lambda some: bins(turns[:, :, some], grid), turns.shape[2])
    along = cells(turns, grid.nodes) // grid.width
    found = along[:, 0]
    for a in range(1, turns.shape[1]):
        found = found * grid.bins + along[:, a]
    return found


def bins_nearly(x: FloatArray, grid: RealGrid) -> NDArray[np.int64]:
    """Find the bins of points, of which a rounding may take those on a border to the bin beside theirs.

    That is enough to see crowds and to sort: a node is still reached from 2^d bins alone.

    Parameters
    ----------
    x : (sets, n, d) float64
        Points of the unit torus.
    grid : RealGrid
        The grid.

    Returns
    -------
    (sets, n) int64
        As ``bins`` gives them.
    """
    if x.shape[1] > ROWS:
        return _by_blocks(lambda some: bins_nearly(x[:, some], grid), x.shape[1])
    along = (x * (grid.nodes / grid.width * LESS)).astype(np.int64)
    found = along[:, :, 0]
    for a in range(1, x.shape[2]):
        found = found * grid.bins + along[:, :, a]
    return found


def _by_blocks(find: Callable[[slice], NDArray[np.int64]], n: int) -> NDArray[np.int64]:
    """Find bins of some points after others, so that a large set needs little memory besides."""
    found = [find(slice(begin, begin + ROWS)) for begin in range(0, n, ROWS)]
    return np.concatenate(found, axis=1)


def bin_counts(bin_of: NDArray[np.int64], grid: RealGrid) -> NDArray[np.int64]:
    """Count the points of each bin.

    Parameters
    ----------
    bin_of : (sets, n) int64
        Bins of points.
    grid : RealGrid
        The grid.

    Returns
    -------
    (sets, grid.bins**d) int64
    """
    sets, full = len(bin_of), grid.bins**grid.d
    numbered = bin_of if sets == 1 else bin_of + full * np.arange(sets)[:, None]
    return np.bincount(numbered.ravel(), minlength=sets * full).reshape(sets, full)


def cells(turns: NDArray[Any], nodes: int) -> NDArray[np.int64]:
    """Find the cells of fixed-point coordinates, exactly.

    Parameters
    ----------
    turns : (...) uint64 or uint32
        Fractions of a turn.
    nodes : int
        Cells of the axis, less than 2^32.

    Returns
    -------
    (...) int64
        0 .. nodes - 1.
    """
    half, size = np.uint64(32), np.uint64(nodes)
    if turns.dtype == np.uint32:
        return (turns.astype(np.uint64) * size >> half).astype(np.int64)
    low = turns & np.uint64(0xFFFFFFFF)
    low *= size
    low >>= half
    high = turns >> half
    high *= size
    high += low
    high >>= half
    return high.view(np.int64)  # below 2^32
