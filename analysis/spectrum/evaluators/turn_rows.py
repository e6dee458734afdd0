"""Coordinates as fixed-point turns, in rows that are kept: new memory costs more than filling it."""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.cached_blocks import block_shape, cached_blocks
from gbnbench.core.torus import FloatArray


class TurnRows:
    """Rows of fixed-point coordinates for batches of sets of n points.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    sets, n, d : int
        Sets of the largest batch, points of a set, and dimension.
    stride : int
        Length of each row, at least n.

    Attributes
    ----------
    rows : (sets, d, stride) uint64 or uint32
        Fractions of a turn in units of 2^-64 or 2^-32 of the last batch; 0 beyond the last point.
    buffer : buffer
        The rows on the device, which on a CPU are the same memory.
    nbytes : int
        Bytes on the host and on the device.
    """

    def __init__(self, p: Precision, sets: int, n: int, d: int, stride: int) -> None:
        self.rows = np.zeros((sets, d, stride), p.turn)
        self._n = n
        self._reals = np.empty((*block_shape(sets, n, d), d))
        self._runtime, self._cpu = p.runtime, p.runtime.device.is_cpu
        self.buffer = p.runtime.shared(self.rows) if self._cpu else p.runtime.empty(self.rows.nbytes)
        self.nbytes = self.rows.nbytes * (1 if self._cpu else 2) + self._reals.nbytes

    def __call__(self, x: FloatArray) -> None:
        """Write the turns of a batch, as ``torus.fixed_point`` gives them; no kernel may read the last ones.

        Parameters
        ----------
        x : (batch, n, d) float64
            Points of the unit torus, of ``sets`` sets at most.

        Notes
        -----
        From 1/2 up a turn is taken off first, which leaves the phase and fits in a signed integer: to that a
        processor converts in one instruction, to unsigned ones not. In float what rounds to 1/2 is 1/2.
        """
        bits = 8 * self.rows.itemsize
        up = (0.0 if bits == 64 else 2.0 ** -(bits + 1)) + 2.0**-53
        signed = self.rows.view(np.int64 if bits == 64 else np.int32)
        for sets, points in cached_blocks(*x.shape):
            some, rows = x[sets, points], signed[sets, :, points]
            reals = self._reals[: some.shape[0], : some.shape[1]]
            np.add(some, up, out=reals)
            np.rint(reals, out=reals)  # 1 from 1/2 up, which is rounded upwards to be no tie
            np.subtract(some, reals, out=reals)
            reals *= 2.0**bits
            np.rint(reals, out=reals)
            np.copyto(rows, reals.transpose(0, 2, 1), casting="unsafe")
        if not self._cpu:
            self._runtime.update(self.buffer, self.rows[: len(x)])
