"""Cubes of power on the device, to which the amplitudes of batches are added as squares."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.digits import Division, Harmonics, each_axis, half_size
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import Program, RepeatedLaunch

GPU_COLUMNS = 64  # frequencies of a row that one work-item of a GPU turns into power
ITEM_POWERS = 4096  # frequencies that one work-item of a CPU turns into power: waking a core takes as long


class CubeWriter:
    """A cube of power on the device, to which batches of amplitudes are added.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    divided : Division
        The two groups of axes.
    fmax : int or tuple of d ints
        Largest harmonic on each axis.
    sets, d : int
        Number of sets, and dimension.
    half, mean : bool
        As in ``cube_powers``.
    gains : (rows,) float64, optional
        Numbers by which the squared amplitudes at each leading frequency are divided besides; 1 if not given.

    Attributes
    ----------
    out, gains : buffer
        The cube, and the gains.
    start, set_size : int
        Index of the whole cube at which it begins, and numbers from a set's to the next set's, 0 for a mean.
    nbytes : int
        Bytes of the cube.
    """

    def __init__(
        self,
        p: Precision,
        divided: Division,
        fmax: Harmonics,
        sets: int,
        d: int,
        half: bool,
        mean: bool,
        gains: FloatArray | None = None,
    ) -> None:
        self._p, self._harmonics, self._half, self._mean = p, each_axis(d, fmax), half, mean
        self._sets = sets
        self._rows, self._columns = half_size(divided.leading), half_size(divided.trailing)
        shape = covered(divided, d)
        self.start = shape[0] // 2 * math.prod(shape[1:]) if half else 0
        self._count = math.prod(shape) - self.start
        self._shape = (shape[0] - shape[0] // 2, *shape[1:]) if half else shape
        self.nbytes = self._count * (1 if mean else self._sets) * np.dtype(p.sum).itemsize
        self.set_size = 0 if mean else self._count
        self._power = np.empty((1 if mean else sets, *self._shape), p.sum)
        self._in_place = (
            p.runtime.device.is_cpu
        )  # whose kernels write the host's memory: a copy wakes a thread
        self.out = p.runtime.shared(self._power) if self._in_place else p.runtime.empty(self.nbytes)
        self._launches: dict[tuple[int, int, int, bool], RepeatedLaunch] = {}
        self.gains = p.runtime.upload((np.ones(self._rows) if gains is None else gains).astype(p.sum))

    def add(
        self,
        program: Program,
        amplitude: Any,
        splits: int,
        norms: Any,
        first: int,
        count: int,
        first_row: int,
        rows: int,
        zero_last: bool = False,
    ) -> None:
        """Turn the amplitudes of a batch into power, which is added up over sets or written set by set.

        Parameters
        ----------
        program : Program
            The kernels that were built for the product.
        amplitude : buffer
            Amplitudes of the batch.
        splits : int
            Slots of a set, whose amplitudes are added up.
        norms : buffer
            Numbers by which the squared amplitudes of each set are divided.
        first, count : int
            First set of the batch, and how many sets it has.
        first_row, rows : int
            First leading frequency of the amplitudes, and how many there are.
        zero_last : bool
            Whether the trailing frequency 0 stands behind the others.
        """
        key = id(program), first_row, rows, zero_last
        if key not in self._launches:
            self._launches[key] = self._launch(program, first_row, rows, zero_last)
        self._launches[key](amplitude, norms, np.uint32(splits), np.uint32(count), np.uint32(first))

    def _launch(self, program: Program, first_row: int, rows: int, zero_last: bool) -> RepeatedLaunch:
        """Prepare the launch for a run of leading frequencies."""
        group, columns = self._p.runtime.group, self._columns
        each, rows_each = (GPU_COLUMNS, 1) if group > 1 else (columns, max(1, ITEM_POWERS // columns))
        return RepeatedLaunch(
            program,
            "cube_power",
            (-(-columns // each), -(-rows // rows_each)),
            (1, 1),
            *(None, None, np.uint32, np.uint32, np.uint32),
            np.uint32(self._rows),
            np.uint32(first_row),
            np.uint32(rows),
            np.uint32(rows_each),
            np.uint32(columns),
            np.uint32(zero_last),
            np.uint32(padded(columns, group * self._p.lanes)),
            np.uint32(each),
            self.gains,
            self.out,
            np.uint64(self.start),
            np.uint64(self.set_size),
        )

    def result(self) -> FloatArray:
        """Download the cube, and cut off the frequencies beyond its edge that the groups cover."""
        if self._in_place:
            self._p.runtime.finish()
        else:
            self._p.runtime.download(self.out, self._power)
        inner = tuple(
            slice(0, f + 1) if self._half and a == 0 else slice(have // 2 - f, have // 2 + f + 1)
            for a, (f, have) in enumerate(zip(self._harmonics, self._shape, strict=True))
        )
        power = np.array(
            self._power[(slice(None), *inner)], np.float64, order="C"
        )  # the next cube is another
        if not self._mean:
            return power
        if self._sets > 1:
            power /= self._sets
        mean: FloatArray = power[0]
        return mean


def covered(divided: Division, d: int) -> tuple[int, ...]:
    """Count the frequencies on each axis that the sums of the two groups cover.

    Parameters
    ----------
    divided : Division
        The two groups of axes.
    d : int
        Dimension.

    Returns
    -------
    tuple of int
        2*fmax+1 on each axis, or a few more on the one that is cut.
    """
    shape = [1] * d
    for axis in (*divided.leading, *divided.trailing):
        shape[axis.coordinate] *= axis.base
    return tuple(shape)
