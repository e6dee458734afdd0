"""Real grids on a line, to which the device carries points, their transform by a library, and the powers."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.gridded_fft.dealt_points import DealtPoints
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import (
    RealGrid,
    transform_of_window,
    window_terms,
)
from gbnbench.analysis.spectrum.evaluators.gridded_fft.host_transform import (
    real_transform,
    shape_of_harmonics,
)


class LineTransform:
    """Memory of the transforms of a batch of grids, and the kernels before and after them.

    Parameters
    ----------
    p : Precision
        Precision on the device, a CPU.
    grid : RealGrid
        Layout of a grid of one axis.
    sets : int
        Most sets of a batch.

    Attributes
    ----------
    needs_runs : bool
        As ``PlaneTransform`` has it.
    """

    needs_runs: ClassVar[bool] = True

    def __init__(self, p: Precision, grid: RealGrid, sets: int) -> None:
        rt, terms = p.runtime, window_terms(p.name)
        self._grid, self._runtime = grid, rt
        self._nodes = np.empty((sets, grid.row_length), p.real)
        self._harmonics = np.empty((sets, *shape_of_harmonics(grid)), np.result_type(p.real, np.complex64))
        self._grids, self._transforms = rt.shared(self._nodes), rt.shared(self._harmonics)
        self._terms = rt.upload(terms.astype(p.real))
        self._gains = rt.upload((transform_of_window(grid) ** -2.0).astype(p.sum))
        self._spread = p.program(
            *("grid_cells.cl", "grid_spread.cl", "line_spread.cl"), AXES=1, WIDTH=grid.width, TERMS=len(terms)
        )
        self._power = p.program("grid_power.cl", AXES=1)
        self._taken = rt.empty(4 * sets * grid.bins)
        self._parts, self._parts_bytes = self._grids, 0

    @property
    def nbytes(self) -> int:
        """Bytes of the grids, of their parts and of their transforms."""
        return self._nodes.nbytes + self._harmonics.nbytes + self._parts_bytes

    def write_powers(
        self, points: DealtPoints, over: Any, first: int, half: bool, out: Any, set_size: int
    ) -> None:
        """Carry points to their grids, transform these, and write the powers.

        Parameters are those of ``PlaneTransform.write_powers``.
        """
        grid, rt, sets = self._grid, self._runtime, points.sets
        of_points, crowds, means = points.arguments[:4], *points.arguments[6:8]
        most_runs = max(runs for _, runs in points.crowds())
        self._spread.run(
            "line_spread",
            (sets,),
            (1,),
            *(*of_points, np.uint32(points.n), crowds, np.uint32(most_runs), means),
            np.uint32(grid.nodes),
            np.uint32(grid.row_length),
            self._terms,
            self._grids,
            self._parts_for(most_runs * sets if most_runs > 1 else 0),
            self._taken,
        )
        rt.finish()
        transformed = self._harmonics[:sets]
        real_transform(self._nodes[:sets, : grid.nodes], transformed, rt.device.compute_units)
        self._power.run(
            "grid_power",
            (1, 1),
            (1, 1),
            self._transforms,
            np.uint64(2 * transformed.shape[1]),
            np.uint32(transformed.shape[1]),
            np.uint32(grid.nodes),
            np.uint32(2 * grid.fmax + 1),
            np.int32(grid.fmax),
            np.uint32(sets),
            over,
            np.uint32(first),
            self._gains,
            np.uint32(half),
            out,
            np.uint64(set_size),
        )

    def _parts_for(self, rows: int) -> Any:
        """Give memory in which each run of each set is summed, more than before if need be."""
        needed = rows * self._nodes[0].nbytes
        if needed > self._parts_bytes:
            self._parts, self._parts_bytes = self._runtime.empty(needed), needed
        return self._parts
