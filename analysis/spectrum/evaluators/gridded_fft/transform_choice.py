"""The transform of a request's grids, with memory and kernels that are kept from call to call."""

from __future__ import annotations

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid
from gbnbench.analysis.spectrum.evaluators.gridded_fft.host_transform import HostTransform, host_transform
from gbnbench.analysis.spectrum.evaluators.gridded_fft.line_transform import LineTransform
from gbnbench.analysis.spectrum.evaluators.gridded_fft.plane_transform import (
    PlaneTransform,
    plane_serves,
    plane_transform,
)
from gbnbench.analysis.spectrum.evaluators.kept_memory import kept

Transform = LineTransform | PlaneTransform | HostTransform


def transform_for(p: Precision, grid: RealGrid, sets: int, rows: int) -> Transform:
    """Give this thread's transform for such requests, or make one.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        Layout of a grid.
    sets : int
        Most sets of a batch.
    rows : int
        Rows of a band.

    Returns
    -------
    LineTransform, PlaneTransform or HostTransform
    """
    return kept(_made, p, grid, sets, rows)


def _made(p: Precision, grid: RealGrid, sets: int, rows: int) -> Transform:
    if grid.d == 1:
        return LineTransform(p, grid, sets)
    if plane_serves(p, grid):
        return plane_transform(p, grid, sets, rows)
    return host_transform(p, grid, sets)
