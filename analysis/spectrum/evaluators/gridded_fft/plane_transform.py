"""Powers of points in the plane, by kernels that fill a grid band by band and transform it on the device.

Libraries are slower here: their wheels are compiled for any processor, and they make harmonics that are not
wanted. A row needs f = 0 .. fmax alone, and the last pass over the columns makes no more than what is wanted.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.evaluators.gridded_fft.fourier_tables import radices, turns, twiddles
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import (
    TILE,
    RealGrid,
    transform_of_window,
    window_terms,
)
from gbnbench.analysis.spectrum.evaluators.gridded_fft.spreading import SpreadPoints
from gbnbench.opencl import Program


@dataclass(frozen=True)
class PlaneTransform:
    """Kernels and memory of a transform in the plane.

    Attributes
    ----------
    grid : RealGrid
        Layout of a grid.
    harmonics : int
        Harmonics of a row that are kept: fmax + 1, and as many more as fill a tile.
    cores : int
        Work-items that share the bands.
    bands : buffer
        One band of a grid for each of them, and as much memory again for the runs of crowded sets.
    transforms : buffer
        Transformed rows of a batch.
    terms : buffer
        Polynomials of the window.
    nbytes : int
        Bytes of bands and transforms.
    row_tables, column_tables : (buffer, buffer)
        Radices of the passes, up to a zero, and their twiddles.
    turns, gains : buffer
        exp(-2 pi i f / nodes), and the squared gains of an axis, both at f = 0 .. harmonics - 1.
    row_memory, column_memory, sums : local memory
        Of a work-item.
    program : Program
        The kernels.
    """

    grid: RealGrid
    harmonics: int
    cores: int
    bands: tuple[Any, Any]
    transforms: Any
    terms: Any
    nbytes: int
    row_tables: tuple[Any, Any]
    column_tables: tuple[Any, Any]
    turns: Any
    gains: Any
    row_memory: Any
    column_memory: Any
    sums: Any
    program: Program

    def write_powers(
        self, points: SpreadPoints, over: Any, first: int, half: bool, out: Any, set_size: int
    ) -> None:
        """Carry points to their grids, transform these, and write the powers.

        Parameters
        ----------
        points : SpreadPoints
            Sets of the batch.
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
        grid, size = self.grid, np.uint64(transform_numbers(self.grid))
        self.program.run(
            "plane_rows",
            (self.cores,),
            (1,),
            *points.arguments,
            np.uint32(grid.row_length),
            self.terms,
            *self.bands,
            np.uint64(points.rows * grid.row_length),
            np.uint32(points.sets),
            *self.row_tables,
            self.turns,
            np.uint32(self.harmonics),
            self.transforms,
            size,
            self.row_memory,
        )
        self.program.run(
            "plane_columns",
            (self.harmonics // TILE[grid.precision],),
            (1,),
            self.transforms,
            size,
            np.uint32(self.harmonics),
            np.uint32(grid.nodes),
            *self.column_tables,
            np.int32(grid.fmax),
            np.uint32(points.sets),
            over,
            np.uint32(first),
            self.gains,
            np.uint32(half),
            out,
            np.uint64(set_size),
            self.column_memory,
            self.sums,
        )


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
    column_memory, sums = _local_bytes(p, grid)
    cores = rt.device.compute_units
    held = sets * transform_numbers(grid) * grid.itemsize
    band = cores * rows * grid.row_length * grid.itemsize
    return PlaneTransform(
        grid=grid,
        harmonics=harmonics,
        cores=cores,
        bands=(rt.empty(band), rt.empty(band)),
        transforms=rt.empty(held),
        terms=rt.upload(terms.astype(p.real)),
        nbytes=2 * band + held,
        row_tables=_tables(p, nodes // 2, radices(nodes // 2)),
        column_tables=_tables(p, nodes, radices(nodes // 4)),  # the last pass, of radix 4, is of its own
        turns=rt.upload(turns(np.arange(harmonics), nodes).astype(p.real)),
        gains=rt.upload(gains.astype(p.sum)),
        row_memory=rt.local(2 * (nodes // 2 + 1) * 2 * tile * grid.itemsize),
        column_memory=rt.local(column_memory),
        sums=rt.local(sums),
        program=p.program(
            "fourier_passes.cl", "grid_spread.cl", "plane_transform.cl",
            AXES=grid.d, WIDTH=grid.width, TERMS=len(terms), TILE=tile,
        ),
    )  # fmt: skip


def _tables(p: Precision, length: int, order: list[int]) -> tuple[Any, Any]:
    rt = p.runtime
    table = np.concatenate([twiddles(length, order), [[1.0, 0.0]]])  # never empty
    return rt.upload(np.array([*order, 0], np.uint32)), rt.upload(table.astype(p.real))


def _local_bytes(p: Precision, grid: RealGrid) -> tuple[int, int]:
    """Count the bytes of the two halves of a transform of columns, and of the sums of their powers."""
    tile = TILE[grid.precision]
    return 2 * grid.nodes * 2 * tile * grid.itemsize, (2 * grid.fmax + 1) * tile * np.dtype(p.sum).itemsize
