"""Memory and kernels of a request that are kept from call to call, one for each thread."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid, window_terms
from gbnbench.analysis.spectrum.evaluators.gridded_fft.host_transform import HostTransform, host_transform
from gbnbench.analysis.spectrum.evaluators.gridded_fft.plane_transform import (
    PlaneTransform,
    plane_transform,
    serves,
)
from gbnbench.analysis.spectrum.evaluators.kept_memory import kept
from gbnbench.opencl import Program


@dataclass(frozen=True)
class Workspace:
    """Grids of a batch in memory that the device and the host share, with what the kernels need besides.

    Attributes
    ----------
    nodes : (sets, *grid.shape) float64 or float32
        The grids.
    grids : buffer
        Their memory on the device.
    terms : buffer
        Polynomials of the window.
    program : Program
        The kernel that carries points to the grids.
    transform : PlaneTransform or HostTransform
        What makes powers of them.
    """

    nodes: NDArray[Any]
    grids: Any
    terms: Any
    program: Program
    transform: PlaneTransform | HostTransform

    @property
    def nbytes(self) -> int:
        """Bytes of the grids and of their transforms."""
        return self.nodes.nbytes + self.transform.nbytes

    @cached_property
    def parts(self) -> Any:
        """Memory as large as the grids', where each of several runs is summed."""
        return self.program.owner.empty(self.nodes.nbytes)


def workspace(p: Precision, grid: RealGrid, sets: int) -> Workspace:
    """Give the workspace of this thread for such requests, or make one.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        Layout of a grid.
    sets : int
        Sets of a batch.

    Returns
    -------
    Workspace
    """
    return kept(_made, p, grid, sets)


def _made(p: Precision, grid: RealGrid, sets: int) -> Workspace:
    rt = p.runtime
    nodes = np.empty((sets, *grid.shape), p.real)
    terms = window_terms(p.name)
    return Workspace(
        nodes=nodes,
        grids=rt.shared(nodes),
        terms=rt.upload(terms.astype(p.real)),
        program=p.program("grid_spread.cl", AXES=grid.d, WIDTH=grid.width, TERMS=len(terms)),
        transform=plane_transform(p, grid, sets) if serves(p, grid) else host_transform(p, grid, nodes),
    )
