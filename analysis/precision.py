"""A precision on the OpenCL device: its types, its vector width and the programs built for them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import DeviceError, InputError
from gbnbench.core.torus import FloatArray, fixed_point
from gbnbench.opencl import Program, Runtime, runtime

SUM_POINTS = 128  # points a lane sums in registers before the sum goes on in double
PACKAGE = "gbnbench.analysis"
PrecisionName = Literal["double", "float"]


@dataclass(frozen=True)
class Precision:
    """Double or float on a device.

    Attributes
    ----------
    runtime : Runtime
        The device.
    double : bool
        Which of the two.
    lanes : int
        Proven vector width.
    """

    runtime: Runtime
    double: bool
    lanes: int

    @property
    def name(self) -> str:
        """As the user says it: "double" or "float"."""
        return "double" if self.double else "float"

    @property
    def real(self) -> type[np.floating[Any]]:
        """Type of tables and of sums in registers."""
        return np.float64 if self.double else np.float32

    @property
    def turn(self) -> type[np.unsignedinteger[Any]]:
        """Type of fixed-point coordinates."""
        return np.uint64 if self.double else np.uint32

    @property
    def sum(self) -> type[np.floating[Any]]:
        """Type of what is added up: double where the device has it."""
        return np.float64 if self.runtime.device.has_double else np.float32

    def program(self, *files: str, **defines: object) -> Program:
        """Build kernel files of the analysis for this precision."""
        return _program(self, files, tuple(sorted(defines.items())))

    def turns(self, x: FloatArray, stride: int) -> NDArray[Any]:
        """Return coordinates of (sets, n, d) points as turns, (sets, d, stride), 0 beyond the last."""
        sets, n, d = x.shape
        rows = np.zeros((sets, d, stride), self.turn)
        rows[:, :, :n] = fixed_point(x, rows.itemsize * 8).transpose(0, 2, 1)
        return rows


@lru_cache(maxsize=64)
def _program(p: Precision, files: tuple[str, ...], defines: tuple[tuple[str, object], ...]) -> Program:
    definitions = {
        "DOUBLE": int(p.double),
        "LANES": p.lanes,
        "SUM": "double" if p.sum is np.float64 else "float",
        "SUM_POINTS": SUM_POINTS,
        **dict(defines),
    }
    return p.runtime.program(PACKAGE, ("/vector.cl", "/turns.cl", *files), definitions)


def precision_of(name: str) -> Precision:
    """Look up "double" or "float" on the chosen device.

    Raises
    ------
    InputError
        For another name.
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


def padded(count: int, step: int) -> int:
    """Round count up to a multiple of step."""
    return -(-count // step) * step
