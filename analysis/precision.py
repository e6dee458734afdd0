"""A precision on the device at hand: its types, its lanes and the programs built for them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gbnbench.errors import DeviceError, InputError
from gbnbench.opencl import Program, Runtime, runtime
from gbnbench.torus import FloatArray, fixed_point

SUM_POINTS = 128  # points summed in registers before the sum goes on in double
GROUP = "gbnbench.analysis"


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
    real, turn, sum : type
        Of tables, of fixed-point coordinates, and of what is added up: double where the device has it.
    """

    runtime: Runtime
    double: bool
    lanes: int
    real: type[np.floating[Any]]
    turn: type[np.unsignedinteger[Any]]
    sum: type[np.floating[Any]]

    def program(self, *files: str, **defines: object) -> Program:
        """Build kernel files of the analysis for this precision."""
        definitions = {
            "DOUBLE": int(self.double),
            "LANES": self.lanes,
            "SUM": "double" if self.sum is np.float64 else "float",
            "SUM_POINTS": SUM_POINTS,
            **defines,
        }
        return self.runtime.program(GROUP, ("/vector.cl", "/turns.cl", *files), definitions)

    def upload_points(self, x: FloatArray) -> Any:
        """Upload a row of fixed-point coordinates a dimension, and room for a vector past the last."""
        rows = fixed_point(x, np.dtype(self.turn).itemsize * 8).T
        return self.runtime.upload(np.append(rows.ravel(), np.zeros(self.lanes, self.turn)))


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
    return Precision(
        runtime=chosen,
        double=double,
        lanes=chosen.lanes(name),
        real=np.float64 if double else np.float32,
        turn=np.uint64 if double else np.uint32,
        sum=np.float64 if chosen.device.has_double else np.float32,
    )


def padded(count: int, step: int) -> int:
    """Round count up to a multiple of step."""
    return -(-count // step) * step
