"""Points dealt out to bands of a grid's first axis, and sorted by tile where the grid is larger than the cache."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid
from gbnbench.core.torus import FloatArray

CACHE_BYTES = 1 << 20  # of a grid that needs no sorting
DIVIDED_FROM = 1 << 22  # nodes reached by the points of a set that is worth dividing among cores
BAND_ROWS = 64  # rows of a band in two dimensions
TILE = {1: (4096,), 2: (32, 64), 3: (8, 8)}  # nodes of a tile, on the leading axes


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
    """

    turns: NDArray[Any]
    order: NDArray[np.intp] | None
    starts: NDArray[np.uint32]
    rows: int

    @property
    def count(self) -> int:
        """Number of bands."""
        return self.starts.shape[1] - 1


def dealt_to_bands(p: Precision, grid: RealGrid, x: FloatArray) -> Bands:
    """Deal the points of each set out to as many bands as keep all cores busy.

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
    Bands
    """
    sets, n, d = x.shape
    turns = p.turns(x, n)
    bands, rows = _division(p.runtime.device.compute_units, grid, sets, n)
    starts = np.full((sets, bands + 1), n, np.uint32)
    starts[:, 0] = 0
    if bands == 1 and grid.size * grid.itemsize <= CACHE_BYTES:
        return Bands(turns, None, starts, rows)
    tiles = TILE[d]
    counts = [-(-grid.nodes // tile) for tile in tiles]
    key = np.zeros((sets, n), np.int64)
    for a, (tile, count) in enumerate(zip(tiles, counts, strict=True)):
        key = key * count + cells(turns[:, a], grid.nodes) // tile
    order = np.argsort(key.astype(np.uint16 if math.prod(counts) < 1 << 16 else key.dtype), axis=1, kind="stable")
    in_order = np.take_along_axis(key, order, axis=1)
    edges = np.arange(1, bands) * (rows // tiles[0] * math.prod(counts[1:]))
    for k in range(sets):
        starts[k, 1:-1] = np.searchsorted(in_order[k], edges)
    return Bands(np.take_along_axis(turns, order[:, None], axis=2), order, starts, rows)


def _division(cores: int, grid: RealGrid, sets: int, n: int) -> tuple[int, int]:
    """Count the bands of a set, and the rows of one: at least the window's reach, and whole tiles."""
    tile = TILE[grid.d][0]
    bands = 1
    if grid.d == 2 and grid.size * grid.itemsize > CACHE_BYTES:  # a band stays in the cache while it is filled
        bands = max(1, grid.nodes // BAND_ROWS)
    elif grid.d > 1 and sets % cores and n * grid.width**grid.d > DIVIDED_FROM:
        bands = max(1, min(cores, grid.nodes // max(tile, grid.width)))
    if bands == 1:
        return 1, grid.nodes
    rows = -(-grid.nodes // (bands * tile)) * tile
    return -(-grid.nodes // rows), rows


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
    low = (turns & np.uint64(0xFFFFFFFF)) * size >> half
    return ((turns >> half) * size + low >> half).astype(np.int64)
