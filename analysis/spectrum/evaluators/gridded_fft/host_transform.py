"""Transform of real grids on the host, by SciPy's or ducc0's FFT, and their powers on the device.

ducc0 (Reinecke) is faster than SciPy's pocketfft, its ancestor. It is under the GPL, so it is an extra
(``pip install gbnbench[fast]``) that is used where it is installed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.dealt_points import DealtPoints
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import (
    RealGrid,
    transform_of_window,
    window_terms,
)
from gbnbench.analysis.spectrum.evaluators.optional_library import loads
from gbnbench.opencl import Program

BLOCK_BYTES = 256 << 10  # of the rows that are transformed at once


@dataclass(frozen=True)
class HostTransform:
    """Memory of a transform by a library, and the kernels before and after it.

    Attributes
    ----------
    needs_runs : bool
        As ``PlaneTransform`` has it.
    grid : RealGrid
        Layout of a grid.
    nodes : (sets, *grid.shape) float64 or float32
        The grids of a batch, in memory that the device and the host share.
    harmonics : (sets, ...) complex128 or complex64
        Their transforms, as ``write_harmonics`` writes them; shared as well.
    grids, transforms : buffer
        The memory of both on the device.
    terms : buffer
        Polynomials of the window.
    gains : buffer
        Squared gains of an axis at f = 0 .. fmax.
    spread, power : Program
        The kernels.
    """

    needs_runs: ClassVar[bool] = True
    grid: RealGrid
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

    def write_powers(
        self, points: DealtPoints, over: Any, first: int, half: bool, out: Any, set_size: int
    ) -> None:
        """Carry points to their grids, transform these, and write the powers.

        Parameters are those of ``PlaneTransform.write_powers``.
        """
        grid, base, rt = self.grid, 2 * self.grid.fmax + 1, self.spread.owner
        self.spread.run(
            "grid_spread",
            (points.bands, points.sets),
            (1, 1),
            *points.arguments,
            np.uint32(grid.row_length),
            self.terms,
            self.grids,
            self.parts if max(runs for _, runs in points.crowds()) > 1 else self.grids,
            np.uint64(grid.size),
        )
        rt.finish()
        transformed = self.harmonics[: points.sets]
        write_harmonics(grid, self.nodes[: points.sets], transformed, rt.device.compute_units)
        self.power.run(
            "grid_power",
            {2: (base, 1), 3: (base, base)}[grid.d],
            (1, 1),
            self.transforms,
            np.uint64(transformed[0].size * 2),
            np.uint32(transformed.shape[-1]),
            np.uint32(grid.nodes),
            np.uint32(base),
            np.int32(grid.fmax),
            np.uint32(points.sets),
            over,
            np.uint32(first),
            self.gains,
            np.uint32(half),
            out,
            np.uint64(set_size),
        )


def host_transform(p: Precision, grid: RealGrid, sets: int) -> HostTransform:
    """Make room for the grids of a batch and their transforms.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        Layout of a grid.
    sets : int
        Most sets of a batch.

    Returns
    -------
    HostTransform
    """
    rt, terms = p.runtime, window_terms(p.name)
    nodes = np.empty((sets, *grid.shape), p.real)
    harmonics = np.empty((sets, *shape_of_harmonics(grid)), np.result_type(p.real, np.complex64))
    return HostTransform(
        grid=grid,
        nodes=nodes,
        harmonics=harmonics,
        grids=rt.shared(nodes),
        transforms=rt.shared(harmonics),
        terms=rt.upload(terms.astype(p.real)),
        gains=rt.upload((transform_of_window(grid) ** -2.0).astype(p.sum)),
        spread=p.program("grid_cells.cl", "grid_spread.cl", AXES=grid.d, WIDTH=grid.width, TERMS=len(terms)),
        power=p.program("grid_power.cl", AXES=grid.d),
    )


def real_transform(real: NDArray[Any], out: NDArray[Any], threads: int) -> None:
    """Transform rows of reals.

    Parameters
    ----------
    real : (rows, m) float64 or float32
        The rows.
    out : (rows, m // 2 + 1) complex128 or complex64
        Their harmonics, which are written.
    threads : int
        Threads that share the rows.
    """
    if ducc_available():
        import ducc0

        ducc0.fft.r2c(real, axes=(1,), nthreads=threads, out=out)
    else:
        from scipy import fft

        out[...] = fft.rfft(real, axis=1, workers=threads)


def ducc_available() -> bool:
    """Tell whether ducc0 is installed and loads here."""
    return loads("ducc0")


def shape_of_harmonics(grid: RealGrid) -> tuple[int, ...]:
    """Shape of the transform of one grid: the last axis has f >= 0.

    On the others negative harmonics stand behind the positive ones; the first keeps all of the grid's.
    """
    m, f = grid.nodes, grid.fmax
    return {1: (m // 2 + 1,), 2: (m, f + 1), 3: (m, 2 * f + 1, f + 1)}[grid.d]


def write_harmonics(grid: RealGrid, nodes: NDArray[Any], out: NDArray[Any], threads: int) -> None:
    """Transform the grids of a batch.

    Parameters
    ----------
    grid : RealGrid
        Their layout.
    nodes : (sets, *grid.shape) float64 or float32
        The grids.
    out : (sets, *shape_of_harmonics(grid)) complex128 or complex64
        Amplitudes, which are written.
    threads : int
        Threads that share the work.
    """
    m, f = grid.nodes, grid.fmax
    if grid.d < 3:
        _rows(nodes.reshape(-1, grid.row_length)[:, :m], out.reshape(-1, f + 1), threads)
    else:
        step = max(1, BLOCK_BYTES // (m * (f + 1) * out.itemsize))
        block = np.empty((step, m, f + 1), out.dtype)
        for one, to in zip(nodes, out, strict=True):
            for first in range(0, m, step):
                planes = one[first : first + step, :m, :m]
                _rows(planes, block[: len(planes)], threads)
                middle = _complex(block[: len(planes)], 1, threads)
                to[first : first + step, : f + 1] = middle[:, : f + 1]
                to[first : first + step, f + 1 :] = middle[:, m - f :]
    found = _complex(out, 1, threads)
    if found is not out:
        out[...] = found


def _rows(real: NDArray[Any], out: NDArray[Any], threads: int) -> None:
    """Transform rows, block by block, so that the harmonics that are not wanted never leave the cache."""
    step = max(threads, BLOCK_BYTES // (math.prod(real.shape[1:]) * real.itemsize))
    for first in range(0, len(real), step):
        out[first : first + step] = _real(real[first : first + step], threads)[..., : out.shape[-1]]


def _real(real: NDArray[Any], threads: int) -> NDArray[Any]:
    if ducc_available():
        import ducc0

        return np.asarray(ducc0.fft.r2c(real, axes=(real.ndim - 1,), nthreads=threads))
    import scipy.fft  # a fifth of a second, which few processes need

    return scipy.fft.rfft(real, axis=-1, workers=threads)


def _complex(part: NDArray[Any], axis: int, threads: int) -> NDArray[Any]:
    """Transform an axis, in place where the library does."""
    if ducc_available():
        import ducc0

        ducc0.fft.c2c(part, axes=(axis,), nthreads=threads, out=part)
        return part
    import scipy.fft

    return scipy.fft.fft(part, axis=axis, workers=threads, overwrite_x=True)
