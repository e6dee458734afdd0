"""Values of an integrand at many points, by a kernel in double precision, or by numpy without a device."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision, double_device, padded
from gbnbench.core.torus import FloatArray

DEVICE_POINTS = 1 << 20  # of a launch
NUMPY_POINTS = 1 << 12  # of a chunk that stays in cache


class KernelIntegrand(Protocol):
    """An integrand that both a kernel and numpy compute."""

    def on_device(self, points: FloatArray, device: Precision) -> FloatArray:
        """Values by a kernel.

        Parameters
        ----------
        points : (n, d) float64
            Points of the unit torus.
        device : Precision
            A device in double precision.

        Returns
        -------
        (n,) float64
            Value at each point.
        """
        ...

    def by_numpy(self, points: FloatArray) -> FloatArray:
        """Values at (n, d) points in numpy: (n,)."""
        ...


def evaluate(integrand: KernelIntegrand, x: FloatArray) -> FloatArray:
    """Values of an integrand, bitwise the same however the points are batched.

    Parameters
    ----------
    integrand : KernelIntegrand
        The function.
    x : (..., d) float64
        Points of the unit torus.

    Returns
    -------
    (...) float64
        Value at each point.
    """
    points = np.ascontiguousarray(x, dtype=np.float64).reshape(-1, x.shape[-1])
    device = double_device()
    step = NUMPY_POINTS if device is None else DEVICE_POINTS
    values = np.empty(len(points))
    for begin in range(0, len(points), step):
        part = points[begin : begin + step]
        values[begin : begin + step] = (
            integrand.by_numpy(part) if device is None else integrand.on_device(part, device)
        )
    return values.reshape(x.shape[:-1])


def coordinate_rows(points: FloatArray, device: Precision, turns: bool) -> NDArray[Any]:
    """Lay coordinates out for a kernel, one row an axis, padded with zeros to whole work-groups.

    Parameters
    ----------
    points : (n, d) float64
        Points of the unit torus.
    device : Precision
        The device, whose work-items take ``lanes`` points each.
    turns : bool
        Whether coordinates are given as integer fractions of a turn, not as doubles.

    Returns
    -------
    (d, stride) float64 or uint64
        The first n columns are the points.
    """
    stride = padded(padded(len(points), device.lanes), device.lanes * device.runtime.group)
    if turns:
        exact: NDArray[Any] = device.turns(points[None], stride)[0]
        return exact
    rows = np.zeros((points.shape[1], stride))
    rows[:, : len(points)] = points.T
    return rows


def run_kernel(
    device: Precision, files: tuple[str, ...], rows: NDArray[Any], n: int, *inputs: Any, **defines: object
) -> FloatArray:
    """Run the kernel that is named as the last file, each work-item computing ``lanes`` values.

    Parameters
    ----------
    device : Precision
        The device in double precision.
    files : tuple of str
        Kernel files, joined in this order.
    rows : (d, stride) float64 or uint64
        Coordinates from ``coordinate_rows``.
    n : int
        Points.
    *inputs
        The kernel's arguments between stride and out: arrays, which are uploaded, and numpy scalars.
    **defines
        Macros beside ``DIM``.

    Returns
    -------
    (n,) float64
        Values at the points.
    """
    d, stride = rows.shape
    group = device.runtime.group
    program = device.program(*files, DIM=d, **defines)
    upload = device.runtime.upload
    arguments = (rows, np.uint32(stride), *inputs)
    held = [upload(value) if isinstance(value, np.ndarray) else value for value in arguments]
    out = device.runtime.empty(8 * stride)
    program.run(files[-1].removesuffix(".cl"), (stride // device.lanes,), (group,), *held, out)
    return device.runtime.download(out, np.empty(n))
