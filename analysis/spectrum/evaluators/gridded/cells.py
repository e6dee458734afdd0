"""Points sorted by their cell on a grid of the first axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class SortedPoints:
    """A batch of point sets sorted by their cell on the first axis.

    Attributes
    ----------
    x : (sets, n, d) float64
        Points in that order.
    order : (sets, n) intp
        Their indices before.
    place : (sets, n) float64
        Place of each point in its cell, [0, 1).
    starts : (sets, nodes + 1) uint32
        Index of the first point of each cell, and n.
    """

    x: FloatArray
    order: NDArray[np.intp]
    place: FloatArray
    starts: NDArray[np.uint32]

    def crowd(self, width: int) -> int:
        """Count the points that reach a node, at the node with most, for a window of ``width`` cells."""
        count = np.diff(self.starts.astype(np.int64), axis=1)
        running = np.cumsum(np.concatenate([count, count[:, :width]], axis=1), axis=1)
        return int((running[:, width:] - running[:, :-width]).max())


def sorted_by_cell(x: FloatArray, nodes: int, bits: int) -> SortedPoints:
    """Sort points by their cell; cells and places are exact for fixed-point coordinates.

    Parameters
    ----------
    x : (sets, n, d) float64
        Points of the unit torus.
    nodes : int
        Cells of the first axis.
    bits : {64, 32}
        Bits of a fixed-point coordinate.

    Returns
    -------
    SortedPoints
    """
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
    return SortedPoints(x[rows, order], order, place[rows, order], starts)
