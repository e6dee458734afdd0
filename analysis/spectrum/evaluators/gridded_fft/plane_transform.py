"""Powers of points in the plane, by kernels that fill a grid band by band and transform it on the device.

Libraries are slower here: their wheels are compiled for any processor, and they make harmonics that are not
wanted. A row needs f = 0 .. fmax alone, and the last pass over the columns makes no more than what is wanted.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.evaluators.gridded_fft.dealt_points import SPREAD_ARGUMENTS, DealtPoints
from gbnbench.analysis.spectrum.evaluators.gridded_fft.fourier_tables import radices, turns, twiddles
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import (
    TILE,
    RealGrid,
    transform_of_window,
    window_terms,
)
from gbnbench.opencl.program import Launch


@dataclass(frozen=True)
class PlaneTransform:
    """Kernels and memory of a transform in the plane, for one thread.

    Attributes
    ----------
    needs_runs : bool
        Whether the points must have been dealt out before the host enqueues more.
    rows : Launch
        Carries points to bands of their grids, and transforms the rows of these.
    columns : Launch
        Transforms the columns, and writes their powers.
    nbytes : int
        Bytes of the bands and of the transformed rows.
    """

    needs_runs: ClassVar[bool] = False
    rows: Launch
    columns: Launch
    nbytes: int

    def write_powers(
        self, points: DealtPoints, over: Any, first: int, half: bool, out: Any, set_size: int
    ) -> None:
        """Carry points to their grids, transform these, and write the powers.

        Parameters
        ----------
        points : DealtPoints
            Sets of the batch, which are dealt out by kernels that may still run.
        over : buffer
            One over the norm of every set, those of other batches included.
        first : int
            The first set of the batch.
        half : bool
            Only the half of the cube with f_0 >= 0.
        out : buffer
            Powers; those of several sets are added up where ``set_size`` is 0.
        set_size : int
            Numbers from the powers of one set to those of the next one.
        """
        sets = np.uint32(points.sets)
        self.rows(*points.arguments, sets)
        self.columns(sets, over, np.uint32(first), np.uint32(half), out, np.uint64(set_size))


def transform_numbers(grid: RealGrid) -> int:
    """Count the numbers of a grid's transformed rows, twice the complex ones.

    Parameters
    ----------
    grid : RealGrid
        Layout of a grid.

    Returns
    -------
    int
    """
    return 2 * grid.nodes * padded(grid.fmax + 1, TILE[grid.precision])


def plane_serves(p: Precision, grid: RealGrid) -> bool:
    """Tell whether a grid is one of the plane, and its columns fit in the device's local memory.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        Layout of a grid.

    Returns
    -------
    bool
    """
    return grid.d == 2 and sum(_local_bytes(p, grid)) <= p.runtime.local_bytes


def plane_transform(p: Precision, grid: RealGrid, sets: int, rows: int) -> PlaneTransform:
    """Build the kernels and the tables for a batch of sets.

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
    PlaneTransform
    """
    rt, tile, nodes, terms = p.runtime, TILE[p.name], grid.nodes, window_terms(p.name)
    harmonics = padded(grid.fmax + 1, tile)
    gains = np.zeros(harmonics)
    gains[: grid.fmax + 1] = transform_of_window(grid) ** -2.0
    cores = rt.device.compute_units
    band, size = rows * grid.row_length, transform_numbers(grid)
    band_bytes, transform_bytes = cores * band * grid.itemsize, sets * size * grid.itemsize
    transforms = rt.empty(transform_bytes)
    program = p.program(
        "fourier_passes.cl", "grid_cells.cl", "grid_spread.cl", "plane_transform.cl",
        AXES=grid.d, WIDTH=grid.width, TERMS=len(terms), TILE=tile,
    )  # fmt: skip
    return PlaneTransform(
        rows=program.prepared(
            "plane_rows",
            (cores,),
            (1,),
            *SPREAD_ARGUMENTS,
            np.uint32,  # sets
            np.uint32(grid.row_length),
            rt.upload(terms.astype(p.real)),
            *(rt.empty(band_bytes), rt.empty(band_bytes)),  # the latter for the runs of crowded sets
            np.uint64(band),
            *_tables(p, nodes // 2, radices(nodes // 2)),
            rt.upload(turns(np.arange(harmonics), nodes).astype(p.real)),
            np.uint32(harmonics),
            transforms,
            np.uint64(size),
            rt.local(2 * (nodes // 2 + 1) * 2 * tile * grid.itemsize),
        ),
        columns=program.prepared(
            "plane_columns",
            (harmonics // tile,),
            (1,),
            *(np.uint32, None, np.uint32, np.uint32, None, np.uint64),  # as write_powers gives them
            transforms,
            np.uint64(size),
            np.uint32(harmonics),
            np.uint32(nodes),
            *_tables(p, nodes, radices(nodes // 4)),  # the last pass, of radix 4, is of its own
            np.int32(grid.fmax),
            rt.upload(gains.astype(p.sum)),
            *(rt.local(nbytes) for nbytes in _local_bytes(p, grid)),
        ),
        nbytes=2 * band_bytes + transform_bytes,
    )


def _tables(p: Precision, length: int, order: list[int]) -> tuple[Any, Any]:
    rt = p.runtime
    table = np.concatenate([twiddles(length, order), [[1.0, 0.0]]])  # never empty
    return rt.upload(np.array([*order, 0], np.uint32)), rt.upload(table.astype(p.real))


def _local_bytes(p: Precision, grid: RealGrid) -> tuple[int, int]:
    """Count the bytes of the two halves of a transform of columns, and of the sums of their powers."""
    tile = TILE[grid.precision]
    return 2 * grid.nodes * 2 * tile * grid.itemsize, (2 * grid.fmax + 1) * tile * np.dtype(p.sum).itemsize
