"""Points on the device, dealt out to the bands of their grids and ready to be carried there."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.coordinate_rounding import Coordinates
from gbnbench.analysis.spectrum.evaluators.gridded_fft import bands as grid_bands
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid, transform_of_window
from gbnbench.analysis.spectrum.evaluators.turn_rows import TurnRows
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import RepeatedLaunch

PART_POINTS = 1024  # points whose roundings a sum in the kernel's precision holds, a multiple of all lanes
# Types of the arguments of kernels that carry points to grids, as ``Program.prepared`` takes them.
SPREAD_ARGUMENTS = (
    *(None, np.uint32, None, np.uint32),  # points and their stride, weights and theirs
    *(None, np.uint32, None, None),  # beginnings of the bands, their number, crowds, means
    *(np.uint32, np.uint32),  # nodes of an axis, rows of a band
)


class DealtPoints:
    """The points of a batch of sets: rows of turns, in bands, with how crowded their bins are.

    Parameters
    ----------
    p : Precision
        Precision on the device, a CPU.
    grid : RealGrid
        Layout of a grid.
    sets, n : int
        Most sets of a batch, and points of each.
    bands, rows : int
        As ``bands.division`` gives them.

    Attributes
    ----------
    arguments : tuple
        Of the kernels that carry the last batch to its grids, of ``SPREAD_ARGUMENTS``.
    sets : int
        Sets of that batch.
    n, bands : int
        Points of a set, and bands.
    nbytes : int
        Bytes on the device.
    """

    def __init__(self, p: Precision, grid: RealGrid, sets: int, n: int, bands: int, rows: int) -> None:
        self._p, self._grid, self._most_sets, self.n = p, grid, sets, n
        self.bands, self._rows, self.sets = bands, rows, 0
        self._stride = padded(n, p.lanes)
        self._turns = TurnRows(p, sets, n, grid.d, self._stride, PART_POINTS)
        self._crowds = np.zeros((sets, 2), np.uint32)
        self._shared_crowds = p.runtime.shared(self._crowds)
        # Beginnings of the bands; places of points, or their bins; points of each bin; room for one axis.
        sizes = [4 * sets * (bands + 1), 4 * sets * n, 4 * sets * grid.bins**grid.d, sets * n * grid.itemsize]
        self._memory = [p.runtime.empty(size) for size in sizes]
        self._ones = p.runtime.upload(np.ones(n, p.real))
        # The mean of a node for each unit of weight.
        self._mean = transform_of_window(grid)[0] ** grid.d / grid.nodes**grid.d
        self._of_ones = self._arguments(self._ones, 0, np.full(sets, self._mean * n))
        self.arguments = self._of_ones
        self.nbytes = sum(sizes) + self._turns.nbytes + n * grid.itemsize

    def __call__(self, points: Any, weights: FloatArray | None, sets: int, most_crowd: int) -> None:
        """Enqueue the launch that deals out a batch.

        Parameters
        ----------
        points : buffer
            (sets, n, d) float64, points of the unit torus.
        weights : (sets or 1, n) float64 or None
            Their weights.
        sets : int
            Sets of the batch.
        most_crowd : int
            Points in the fullest bin of a set beyond which it is given up.
        """
        weight, dealt, stride, self.arguments = self._ones, self._ones, 0, self._of_ones
        if weights is not None:
            weight, dealt = self._p.runtime.upload(weights.astype(self._p.real)), self._dealt_weight
            stride = self.n if len(weights) > 1 else 0
            means = np.broadcast_to(self._mean * weights.sum(axis=1), (sets,))
            self.arguments = self._arguments(dealt, self.n, means)
        self.sets = sets
        self._launch(
            *(points, weight, dealt, np.uint32(stride), np.uint32(weights is not None)),
            *(np.uint32(sets), np.uint32(min(most_crowd, self.n))),
        )

    def crowds(self) -> set[tuple[int, int]]:
        """Tell how crowded the sets of the batch are, once its kernels have ended.

        Returns
        -------
        set of (int, int)
            Points in the fullest bin, and runs in which points are summed: none of a set that was given up.
        """
        return {(crowd, runs) for crowd, runs in self._crowds[: self.sets].tolist()}

    def coordinates(self) -> Coordinates:
        """Tell how far the coordinates of the batch were rounded, once its kernels have ended.

        Returns
        -------
        Coordinates
            For the worst of its sets, without weights.
        """
        return self._turns.coordinates(self.sets)

    def _arguments(self, weight: Any, weight_stride: int, means: FloatArray) -> tuple[Any, ...]:
        return (
            *(self._turns.buffer, np.uint32(self._stride), weight, np.uint32(weight_stride)),
            *(self._memory[0], np.uint32(self.bands), self._shared_crowds),
            self._p.runtime.upload(means.astype(self._p.real)),
            *(np.uint32(self._grid.nodes), np.uint32(self._rows)),
        )

    @cached_property
    def _dealt_weight(self) -> Any:
        """Weights in the order of the points."""
        nbytes = self._most_sets * self.n * self._grid.itemsize
        self.nbytes += nbytes
        return self._p.runtime.empty(nbytes)

    @cached_property
    def _launch(self) -> RepeatedLaunch:
        grid = self._grid
        in_order = grid.d > 1 and (self.bands > 1 or grid.size * grid.itemsize > grid_bands.CACHE_BYTES)
        return RepeatedLaunch(
            self._p.program(
                *("turn_rows.cl", "grid_cells.cl", "deal_points.cl"),
                AXES=grid.d,
                WIDTH=grid.width,
                CROWDED=grid_bands.CROWDED,
            ),
            "deal_points",
            (self._most_sets,),
            (1,),
            *(None, None, None, np.uint32, np.uint32, np.uint32, np.uint32),  # as each call gives them
            *(np.uint32(self.n), np.uint32(self._stride), np.uint32(grid.nodes)),
            *(np.uint32(self.bands), np.uint32(self._rows), np.uint32(in_order)),
            *(
                np.uint32(grid_bands.most_runs(grid, self.n)),
                np.uint32(PART_POINTS),
                np.uint32(self._turns.items),
            ),
            *(self._turns.buffer, self._turns.lost, self._memory[0], self._shared_crowds, *self._memory[1:]),
        )
