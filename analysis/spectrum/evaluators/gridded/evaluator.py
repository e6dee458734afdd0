"""The gridded product as an evaluator, with its cost and its errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.coordinate_rounding import rounded_at_worst
from gbnbench.analysis.spectrum.digits import half_size, whole_axes
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.cube_product import CubeProduct
from gbnbench.analysis.spectrum.evaluators.device_evaluator import DeviceEvaluator
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.gridded.grid import DEGREE, WIDTH
from gbnbench.analysis.spectrum.evaluators.gridded.product import (
    griddable,
    gridded_errors,
    gridded_powers,
    least_gridded,
)
from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import nodes_for
from gbnbench.analysis.spectrum.evaluators.point_slots import TABLE_BYTES
from gbnbench.analysis.spectrum.evaluators.work_model import ENTRY, TILE, WRITTEN, device_cost, narrow
from gbnbench.analysis.spectrum.limits import BYTES, MEMORY_SHARE
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.memory import memory_limit
from gbnbench.core.torus import FloatArray

# Multiply-adds of carrying a frequency from a point to a node, and of folding it at a node.
SPREAD, CARRIED = 7.0, 60.0
SET_UP = 1.1e7  # multiply-adds that take as long as its additional launches and its sort


@dataclass(frozen=True)
class GriddedProduct(DeviceEvaluator):
    """The gridded product on the OpenCL device, for cubes and half cubes of two or more dimensions."""

    method: ClassVar[str] = "gridded"
    title: ClassVar[str] = "gridded product"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube")

    @classmethod
    def offer(
        cls, request: SpectrumRequest, precision: str, *, floor: float | None = None, forced: bool = False
    ) -> GriddedProduct | None:
        """Offer itself where the grid fits and the product takes less than the plain one, set-up included.

        Parameters and returns are those of ``Evaluator.offer``.
        """
        if request.what not in cls.serves or not griddable(request.d, request.fmax, precision):
            return None
        if super().offer(request, precision) is None:
            return None
        evaluator = cls(precision)
        if forced:
            return evaluator
        if not grid_fits(evaluator.on_device, request):
            return None
        cheaper = evaluator.work(request) < CubeProduct(precision).work(request)
        return evaluator if cheaper else None

    @classmethod
    def why_not(cls, request: SpectrumRequest, precision: str) -> str:
        """Say which dimensions and frequencies it serves.

        Parameters and returns are those of ``Evaluator.why_not``.
        """
        return (
            f"the gridded product in {precision} needs two dimensions and fmax of at least "
            f"{least_gridded(precision)}; got d={request.d}, fmax={request.fmax}"
        )

    def work(self, request: SpectrumRequest) -> float:
        """Count the points carried to the grid, the product of its nodes, and the set-up."""
        return self._product_work(request) + narrow(self.on_device) * SET_UP

    def _product_work(self, request: SpectrumRequest) -> float:
        p, n, d, f = self.on_device, request.n, request.d, request.fmax
        trailing = half_size(whole_axes(d, f)[1:])
        nodes = nodes_for(f, p.lanes)
        reached = WIDTH[p.name] + p.lanes
        carried = n * (ENTRY * trailing + reached * (SPREAD * trailing + 2 * DEGREE[p.name]))
        each = carried + trailing * nodes * (CARRIED + 0.8 * TILE * (f + 1))
        return request.realizations * float(each + WRITTEN * (2 * f + 1) ** d / 2)

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the product's cost on the device, the grid of a set and its folded copy included."""
        p = self.on_device
        held = 3 * 8 * (2 * request.fmax + 1) ** request.d + 2 * TABLE_BYTES + 2 * grid_bytes(p, request)
        return device_cost(p, request, self._product_work(request), 8.0, held, SET_UP)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the product's errors for points that are spread over the torus."""
        p, n, f = self.on_device, request.n, request.fmax
        crowd = min(n, 2 * n * WIDTH[p.name] // nodes_for(f, p.lanes) + 1)
        return gridded_errors(p, f, n, crowd, rounded_at_worst(n, request.d, p.name))

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it."""
        return gridded_powers(self.on_device, x, fmax, weights, half, mean)


def grid_bytes(p: Precision, request: SpectrumRequest) -> int:
    """Size the grid of one set; its folded copy is as large again.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        A request for a cube.

    Returns
    -------
    int
        Bytes.
    """
    trailing = padded(half_size(whole_axes(request.d, request.fmax)[1:]), p.runtime.group)
    return nodes_for(request.fmax, p.lanes) * trailing * 2 * np.dtype(p.real).itemsize


def grid_fits(p: Precision, request: SpectrumRequest) -> bool:
    """Tell whether the grid is a buffer that the device gives, and fits in memory beside the cube.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        A request for a cube.

    Returns
    -------
    bool
    """
    grid, cube = grid_bytes(p, request), BYTES * (2 * request.fmax + 1) ** request.d
    return grid <= p.runtime.largest_buffer and 2 * grid + cube <= MEMORY_SHARE * memory_limit()
