"""The device side that evaluations of the energy share: exact fractions of a turn, buffers that are kept."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import kernel, operation_counts
from gbnbench.generators.gbn.protocol import EnergyGradient
from gbnbench.opencl import Program, Runtime

PACKAGE = "gbnbench.generators"
CHUNK = 256  # points summed before their sum is added to the rest, so that float keeps its digits


class DeviceEvaluation(ABC):
    """Sets of n points in d dimensions on a device, at one sigma and precision.

    Attributes
    ----------
    n, d : int
        Size of a set.
    sigma, side : float
        Kernel width and the box's side, in spacings.
    precision : {"double", "float"}
        Of all that is done for a pair.
    """

    def __init__(self, runtime: Runtime, n: int, d: int, sigma: float, precision: str) -> None:
        if n < 1 or d < 1:
            raise InputError(f"a set has at least one point and one dimension; got n={n}, d={d}")
        if not (math.isfinite(sigma) and sigma > 0):
            raise InputError(f"sigma must be positive; got {sigma}")
        if precision not in kernel.EPS:
            raise InputError(f'precision must be "double" or "float"; got {precision!r}')
        self.runtime, self.n, self.d, self.sigma, self.precision = runtime, n, d, float(sigma), precision
        self.side = kernel.side_of(n, d)
        self.double = precision == "double"
        self.real: type[np.floating[Any]] = np.float64 if self.double else np.float32
        self.bytes = np.dtype(self.real).itemsize
        self.lanes = runtime.lanes(precision)
        self.stride = -(-n // self.lanes) * self.lanes
        self._buffers: dict[str, tuple[int, Any]] = {}

    def program(self, *files: str, **defines: object) -> Program:
        """Build kernel files for the precision, the lanes and the dimension.

        Parameters
        ----------
        *files : str
            Names of kernel files, joined in this order.
        **defines
            Macros beside DOUBLE, LANES and DIM.

        Returns
        -------
        Program
        """
        base = {"DOUBLE": int(self.double), "LANES": self.lanes, "DIM": self.d}
        return self.runtime.program(PACKAGE, ("/vector.cl", *files), {**base, **defines})

    def buffer(self, name: str, count: int) -> Any:
        """Return the buffer of a name with room for count numbers, made or grown if need be.

        Kernels read whole vectors of points: behind the last point are zeros, never what is not there.

        Parameters
        ----------
        name : str
            One buffer is kept for each name.
        count : int
            Numbers of the precision's size.

        Returns
        -------
        pyopencl.Buffer
        """
        nbytes = (count + 4 * self.lanes * self.d) * self.bytes
        held = self._buffers.get(name)
        if held is None or held[0] < nbytes:
            held = (nbytes, self.runtime.empty(nbytes))
            self.runtime.clear(held[1], nbytes)  # what pads a vector is never left to chance
            self._buffers[name] = held
        return held[1]

    def launch(self, program: Program, name: str, items: int, *arguments: Any) -> None:
        """Run a kernel over at least so many work-items.

        Parameters
        ----------
        program : Program
            What holds the kernel.
        name : str
            The kernel.
        items : int
            Work-items, rounded up to whole groups.
        *arguments
            Buffers and numbers that it takes.
        """
        group = self.runtime.group
        program.run(name, (-(-items // group) * group,), (group,), *arguments)

    def send_turns(self, x: FloatArray) -> Any:
        """Send (sets, n, d) coordinates, in or out of [0, 1), as fixed-point fractions of a turn.

        Notes
        -----
        Halves of turns are added and dropped in integers, so nothing overflows; rounding is 2^-64 (double) or
        2^-33 (float) of a turn, on both sides of every border.
        """
        near = x - np.rint(x)
        if self.double:
            turns: NDArray[Any] = np.rint(near * 2.0**63).astype(np.int64) * 2
        else:
            turns = np.rint(near * 2.0**32).astype(np.int64).astype(np.uint32)
        return self.send("turns", turns)

    def send(self, name: str, array: NDArray[Any]) -> Any:
        """Copy numbers of the precision's size into the buffer of a name.

        Parameters
        ----------
        name : str
            The buffer.
        array : ndarray
            Of a type as wide as the precision's.

        Returns
        -------
        pyopencl.Buffer
        """
        buffer = self.buffer(name, array.size)
        self.runtime.update(buffer, array)
        return buffer

    def bytes_a_set(self) -> int:
        """Size of a set's buffers."""
        return 4 * self.stride * self.d * self.bytes

    def __call__(self, x: FloatArray) -> EnergyGradient:
        """Evaluate; see ``EnergyEvaluation``."""
        if x.ndim != 3 or x.shape[1:] != (self.n, self.d):
            raise InputError(f"x must be (sets, {self.n}, {self.d}); got shape {x.shape}")
        step = max(1, operation_counts.LARGEST // self.bytes_a_set())
        parts = [self._sums(x[k : k + step]) for k in range(0, len(x), step)]
        if len(parts) == 1:
            return parts[0]
        return EnergyGradient(
            np.concatenate([p.gradient for p in parts]), np.concatenate([p.excess for p in parts])
        )

    @abstractmethod
    def _sums(self, x: FloatArray) -> EnergyGradient:
        """Evaluate as many sets as buffers hold."""


class AllPairs(DeviceEvaluation):
    """Sums of each point over all points of its set, a work-item for each vector of points."""

    def program(self, *files: str, **defines: object) -> Program:
        """Build kernel files, which sum in chunks.

        Parameters
        ----------
        *files : str
            Names of kernel files.
        **defines
            Macros beside those of every evaluation and CHUNK.

        Returns
        -------
        Program
        """
        return super().program(*files, CHUNK=CHUNK, **defines)

    def sum_pairs(
        self, program: Program, name: str, sets: int, at: Any, *arguments: Any
    ) -> tuple[NDArray[Any], NDArray[Any]]:
        """Launch a kernel of all pairs and wait for its sums.

        Parameters
        ----------
        program, name
            The kernel, whose last arguments are the buffers of its results.
        sets : int
            How many sets.
        at : buffer
            The points as the kernel reads them.
        *arguments
            What it takes between sizes and results.

        Returns
        -------
        slopes : (sets, n, d) float64
        sums : (sets, n)
            In the precision.
        """
        items = self.stride // self.lanes
        gradient = self.buffer("gradient", sets * self.stride * self.d)
        energy = self.buffer("energy", sets * self.stride)
        sizes = (np.uint32(size) for size in (sets, self.n, self.stride, items))
        self.launch(program, name, sets * items, at, *sizes, *arguments, gradient, energy)
        slopes = self.runtime.download(gradient, np.empty((sets, self.stride, self.d), self.real))
        sums = self.runtime.download(energy, np.empty((sets, self.stride), self.real))
        return slopes[:, : self.n].astype(np.float64), sums[:, : self.n]


def means(sums: NDArray[Any]) -> FloatArray:
    """Average over the points of each set, (sets, n), in double."""
    return np.asarray(np.mean(sums, axis=1, dtype=np.float64))
