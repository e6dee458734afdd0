"""Memory and kernels of a request that are kept from call to call, one for each thread."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid, transform_of_window, window_terms
from gbnbench.analysis.spectrum.evaluators.gridded_fft.transform import shape_of_harmonics
from gbnbench.analysis.spectrum.evaluators.kept_memory import kept
from gbnbench.opencl import Program


@dataclass(frozen=True)
class Workspace:
    """Grids of a batch in memory that the device and the host share, with what the kernels need besides.

    Attributes
    ----------
    nodes : (sets, *grid.shape) float64 or float32
        The grids.
    harmonics : (sets, ...) complex128 or complex64
        Their transforms, as ``transform.harmonics`` writes them.
    grids : buffer
        The memory of the grids on the device.
    transforms : buffer
        The memory of the transforms on the device.
    terms, gains : buffer
        Polynomials of the window, and the squared gains of an axis at f = 0 .. fmax.
    spread, power : Program
        The kernels.
    """

    nodes: NDArray[Any]
    harmonics: NDArray[Any]
    grids: Any
    transforms: Any
    terms: Any
    gains: Any
    spread: Program
    power: Program

    @property
    def nbytes(self) -> int:
        """Bytes of the grids and of their transforms."""
        return self.nodes.nbytes + self.harmonics.nbytes

    @cached_property
    def parts(self) -> Any:
        """Memory as large as the grids', where each of several runs is summed."""
        return self.spread.owner.empty(self.nodes.nbytes)


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
    transforms = np.empty((sets, *shape_of_harmonics(grid)), np.result_type(p.real, np.complex64))
    terms = window_terms(p.name)
    return Workspace(
        nodes=nodes,
        harmonics=transforms,
        grids=rt.shared(nodes),
        transforms=rt.shared(transforms),
        terms=rt.upload(terms.astype(p.real)),
        gains=rt.upload((transform_of_window(grid) ** -2.0).astype(p.sum)),
        spread=p.program("grid_spread.cl", AXES=grid.d, WIDTH=grid.width, TERMS=len(terms)),
        power=p.program("grid_power.cl", AXES=grid.d),
    )
