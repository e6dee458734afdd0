"""A precision on the OpenCL device: its types, its vector width and the programs built for them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import DeviceError, InputError
from gbnbench.core.torus import FloatArray, fixed_point
from gbnbench.opencl import Program, Runtime, devices_present, runtime

SUM_POINTS = 128  # points that a lane sums in registers, at most, before these sums are added up in double
SUM_BYTES = 4096  # of these in all lanes, so that they stay in the first cache
ROWS = 1 << 20  # points that are rounded together
PACKAGE = "gbnbench.analysis"
PrecisionName = Literal["double", "float"]


@dataclass(frozen=True)
class Precision:
    """Double or float arithmetic on an OpenCL device.

    Attributes
    ----------
    runtime : Runtime
        The device's context, queue and program cache.
    double : bool
        True for double, False for float.
    lanes : int
        Width of the vectors that the kernels use; the device was checked to compute correctly with it.
    """

    runtime: Runtime
    double: bool
    lanes: int

    @property
    def name(self) -> str:
        """Name of the precision in requests and messages: "double" or "float"."""
        return "double" if self.double else "float"

    @property
    def real(self) -> type[np.floating[Any]]:
        """Type of tables and of sums in registers."""
        return np.float64 if self.double else np.float32

    @property
    def sum_points(self) -> int:
        """Points that a lane sums in registers before these sums are added up in double."""
        return min(SUM_POINTS, SUM_BYTES // (self.lanes * np.dtype(self.real).itemsize))

    @property
    def turn(self) -> type[np.unsignedinteger[Any]]:
        """Type of fixed-point coordinates."""
        return np.uint64 if self.double else np.uint32

    @property
    def sum(self) -> type[np.floating[Any]]:
        """Type in which register sums are added up: double wherever the device has it."""
        return np.float64 if self.runtime.device.has_double else np.float32

    @property
    def sum_lanes(self) -> int:
        """Width of vectors of ``sum``, of which at most four make one of ``real``."""
        if self.real is self.sum:
            return self.lanes
        return max(min(self.lanes, self.runtime.lanes("double")), self.lanes // 4)

    def program(self, *files: str, **defines: object) -> Program:
        """Build kernel files of the analysis for this precision.

        Parameters
        ----------
        *files : str
            Names of files in ``analysis/kernels``, joined in this order.
        **defines : int or str
            Macros for the compiler, besides those of the precision itself.

        Returns
        -------
        Program
            Kept from call to call.
        """
        return _program(self, files, tuple(sorted(defines.items())))

    def turns(self, x: FloatArray, stride: int) -> NDArray[Any]:
        """Round coordinates to fixed-point turns, so that phases wrap exactly in integer arithmetic.

        Parameters
        ----------
        x : (sets, n, d) float64
            Points of the unit torus.
        stride : int
            Length of each row, at least n.

        Returns
        -------
        (sets, d, stride) uint64 or uint32
            Fractions of a turn in units of 2^-64 or 2^-32; 0 beyond the last point.
        """
        sets, n, d = x.shape
        if n > ROWS:
            rows = np.zeros((sets, d, stride), self.turn)
            for begin in range(0, n, ROWS):  # what rounding takes besides is that of a block
                some = fixed_point(x[:, begin : begin + ROWS], rows.itemsize * 8)
                rows[:, :, begin : begin + some.shape[1]] = some.transpose(0, 2, 1)
            return rows
        if stride == n:
            return np.ascontiguousarray(fixed_point(x, 64 if self.double else 32).transpose(0, 2, 1))
        rows = np.zeros((sets, d, stride), self.turn)
        rows[:, :, :n] = fixed_point(x, rows.itemsize * 8).transpose(0, 2, 1)
        return rows


@lru_cache(maxsize=64)
def _program(p: Precision, files: tuple[str, ...], defines: tuple[tuple[str, object], ...]) -> Program:
    definitions = {
        "DOUBLE": int(p.double),
        "LANES": p.lanes,
        "SUM": "double" if p.sum is np.float64 else "float",
        "SUM_POINTS": p.sum_points,
        **dict(defines),
    }
    return p.runtime.program(PACKAGE, ("/vector.cl", "/turns.cl", *files), definitions)


def precision_of(name: str) -> Precision:
    """Look up a precision on the chosen device.

    Parameters
    ----------
    name : {"double", "float"}
        The precision.

    Returns
    -------
    Precision

    Raises
    ------
    InputError
        If the name is neither of the two.
    DeviceError
        If there is no device, or it has no double precision.
    """
    if name not in ("double", "float"):
        raise InputError(f'precision must be "double" or "float"; got {name!r}')
    chosen = runtime()
    double = name == "double"
    if double and not chosen.device.has_double:
        raise DeviceError(
            f'{chosen.device.label} has no double precision; use precision="float" or another device'
        )
    return Precision(chosen, double, chosen.lanes(name))


def double_device() -> Precision | None:
    """Return double precision on the chosen device, None where there is no device or it has none."""
    if not devices_present() or not runtime().device.has_double:
        return None
    return precision_of("double")


def padded(count: int, step: int) -> int:
    """Round a count up to a multiple of a step.

    Parameters
    ----------
    count, step : int
        Any count, and a positive step.

    Returns
    -------
    int
    """
    return -(-count // step) * step
