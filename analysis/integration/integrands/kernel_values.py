"""Values of an integrand at many points: by a kernel where a device has double precision, else by numpy."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision, padded, precision_of
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import devices_present, runtime

DEVICE_POINTS = 1 << 20  # of a launch
NUMPY_POINTS = 1 << 12  # of a chunk that stays in cache


class Twofold(Protocol):
    """What is computed by either."""

    def on_device(self, points: FloatArray, device: Precision) -> FloatArray:
        """Values at (n, d) points by a kernel."""
        ...

    def by_numpy(self, points: FloatArray) -> FloatArray:
        """Values at (n, d) points in numpy."""
        ...


def values(integrand: Twofold, x: FloatArray) -> FloatArray:
    """Values at points: (..., d) -> (...), bitwise the same however they are batched."""
    points = np.ascontiguousarray(x, dtype=np.float64).reshape(-1, x.shape[-1])
    device = double_device()
    step = NUMPY_POINTS if device is None else DEVICE_POINTS
    found = np.empty(len(points))
    for begin in range(0, len(points), step):
        part = points[begin : begin + step]
        found[begin : begin + step] = (
            integrand.by_numpy(part) if device is None else integrand.on_device(part, device)
        )
    return found.reshape(x.shape[:-1])


def double_device() -> Precision | None:
    """Return double precision on the chosen device, None where there is no device or it has none."""
    if not devices_present() or not runtime().device.has_double:
        return None
    return precision_of("double")


def rows_of(points: FloatArray, device: Precision, turns: bool) -> NDArray[Any]:
    """Coordinates by axis, (d, stride), as doubles or turns, 0 beyond the last.

    Notes
    -----
    The stride is a whole number of work-groups of ``lanes`` points an item.
    """
    stride = padded(padded(len(points), device.lanes), device.lanes * device.runtime.group)
    if turns:
        exact: NDArray[Any] = device.turns(points[None], stride)[0]
        return exact
    rows = np.zeros((points.shape[1], stride))
    rows[:, : len(points)] = points.T
    return rows


def launch(
    device: Precision, files: tuple[str, ...], rows: NDArray[Any], n: int, *inputs: Any, **defines: object
) -> FloatArray:
    """Run a kernel of its last file's name, an item for each ``lanes`` points: values at the first n.

    Parameters
    ----------
    device : Precision
        Where.
    files : tuple of str
        Of kernels.
    rows : (d, stride)
        Of ``rows_of``.
    n : int
        Points.
    *inputs
        Arrays, which are uploaded, and numpy scalars: the kernel's arguments between stride and out.
    **defines
        Beside ``DIM``.
    """
    d, stride = rows.shape
    group = device.runtime.group
    program = device.program(*files, DIM=d, **defines)
    upload = device.runtime.upload
    given = (rows, np.uint32(stride), *inputs)
    held = [upload(value) if isinstance(value, np.ndarray) else value for value in given]
    out = device.runtime.empty(8 * stride)
    program.run(files[-1].removesuffix(".cl"), (stride // device.lanes,), (group,), *held, out)
    return device.runtime.download(out, np.empty(n))
