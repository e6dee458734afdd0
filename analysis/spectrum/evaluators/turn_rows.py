"""Coordinates as rows of fixed-point turns on the device, and how far they were rounded."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.coordinate_rounding import Coordinates, coordinates_of_sums
from gbnbench.opencl import RepeatedLaunch

GPU_POINTS = 4  # that one work-item of a GPU rounds


class TurnRows:
    """Rows of fixed-point coordinates for batches of sets of n points.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    sets, n, d : int
        Sets of the largest batch, points of a set, and dimension.
    stride : int
        Length of each row, at least n, and a multiple of the lanes.
    each : int or None
        Points that a work-item takes, a multiple of the lanes; None for as many as suit a GPU.

    Attributes
    ----------
    buffer : buffer
        (sets, d, stride) uint64 or uint32 of the last batch: fractions of a turn in units of 2^-64 or 2^-32,
        as ``torus.fixed_point`` gives them; 0 beyond the last point.
    lost : buffer
        (sets, items, 2) numbers of the type ``p.sum``: for each work-item the sums of the absolute values and
        of the squares of what its coordinates were rounded, in these units.
    items : int
        Work-items of a set.
    nbytes : int
        Bytes on the device.
    """

    def __init__(self, p: Precision, sets: int, n: int, d: int, stride: int, each: int | None) -> None:
        self._p, self._sets, self._n, self._d, self._stride = p, sets, n, d, stride
        self._each = each or padded(GPU_POINTS, p.lanes)
        self.items = -(-stride // self._each)
        self._lost = np.zeros((sets, self.items, 2), p.sum)
        self._in_place = p.runtime.device.is_cpu
        self.lost = p.runtime.shared(self._lost) if self._in_place else p.runtime.empty(self._lost.nbytes)
        rows = sets * d * stride * np.dtype(p.turn).itemsize
        self.buffer = p.runtime.empty(rows)
        self.nbytes = rows + self._lost.nbytes

    def __call__(self, points: Any, sets: int) -> None:
        """Enqueue the launch that writes the rows of a batch.

        Parameters
        ----------
        points : buffer
            (sets, n, d) float64, points of the unit torus.
        sets : int
            Sets of the batch.
        """
        self._launch(points, np.uint32(sets))

    @cached_property
    def _launch(self) -> RepeatedLaunch:
        program = self._p.program("turn_rows.cl")
        group = self._p.runtime.group
        return RepeatedLaunch(
            program,
            "turn_rows",
            (padded(self.items, group), self._sets),
            (group, 1),
            *(None, np.uint32),  # points and sets, which each call gives
            np.uint32(self._n),
            np.uint32(self._d),
            np.uint32(self._stride),
            np.uint32(self._each),
            np.uint32(self.items),
            self.buffer,
            self.lost,
        )

    def coordinates(self, sets: int) -> Coordinates:
        """Tell how far the coordinates of the last batch were rounded, once its kernels have ended.

        Parameters
        ----------
        sets : int
            Sets of the batch.

        Returns
        -------
        Coordinates
            For the worst of its sets, without weights.
        """
        if not self._in_place:
            self._p.runtime.download(self.lost, self._lost)
        lost = self._lost[:sets]
        if not lost.any():  # as nearly always in double, and told in a third of the time of the sums
            return coordinates_of_sums(self._p.name, self._n, 0.0, 0.0)
        absolute, square = lost.sum(axis=1, dtype=np.float64).max(axis=0).tolist()
        return coordinates_of_sums(self._p.name, self._n, absolute, square)
