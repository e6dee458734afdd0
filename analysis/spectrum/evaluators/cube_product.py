"""Power of a cube of frequencies, or of its half with f_0 >= 0, by the exact two-group product."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.coordinate_rounding import coordinates, rounded_at_worst
from gbnbench.analysis.spectrum.digits import (
    Harmonics,
    cheapest_division,
    each_axis,
    half_size,
    multiplied_columns,
)
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.device_evaluator import DeviceEvaluator
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.kept_memory import kept
from gbnbench.analysis.spectrum.evaluators.point_slots import tile_columns, tile_rows
from gbnbench.analysis.spectrum.evaluators.prepared_cube import PreparedCube
from gbnbench.analysis.spectrum.evaluators.row_runs import held_bytes, planned_runs
from gbnbench.analysis.spectrum.evaluators.small_cube import MOST_WORK
from gbnbench.analysis.spectrum.evaluators.two_group_product import product_errors
from gbnbench.analysis.spectrum.evaluators.work_model import (
    CARRIED_POINT,
    ENTRY,
    LAUNCHED,
    SET_UP,
    TILE,
    WRITTEN,
    device_cost,
    narrow,
)
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class CubeProduct(DeviceEvaluator):
    """The two-group product on the OpenCL device, for cubes and half cubes in any dimension."""

    method: ClassVar[str] = "product"
    title: ClassVar[str] = "two-group product"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube")

    def work(self, request: SpectrumRequest) -> float:
        """Count the pairs of frequencies, the tables, the powers that are written, and the set-up."""
        work, p, n = self._product_work(request), self.on_device, request.n
        small = p.runtime.device.is_cpu and work <= MOST_WORK
        carried = request.realizations * n * CARRIED_POINT
        return work + narrow(p) * (carried + SET_UP + (0 if small else LAUNCHED))

    def _product_work(self, request: SpectrumRequest) -> float:
        p, n = self.on_device, request.n
        divided = cheapest_division(request.d, request.largest, tile_rows(p), tile_columns(p))
        a, b = half_size(divided.leading), half_size(divided.trailing)
        each = (TILE * padded(a, tile_rows(p)) * multiplied_columns(b, tile_columns(p)) + ENTRY * (a + b)) * n
        return request.realizations * float(each + WRITTEN * request.frequencies / 2)

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the product's cost on the device."""
        runs = planned_runs(self.on_device, request)
        launches = 3.0 * sum(
            run.times * run.slots.launches(request.n) * -(-request.realizations // run.slots.sets)
            for run in runs
        )
        held = held_bytes(self.on_device, request, runs)
        return device_cost(self.on_device, request, self._product_work(request), launches, held)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the product's errors, coordinates being exact in double and rounded at worst in float."""
        p, n = self.on_device, request.n
        at = rounded_at_worst(n, request.d, p.name)
        errors = Errors(0.0, 0.0)
        for run in planned_runs(p, request):
            errors = errors.or_larger(product_errors(p, n, run.slots, request.fmax, at))
        return errors

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it."""
        return cube_powers(self.on_device, x, fmax, weights, half, mean)

    def box(
        self, x: FloatArray, request: SpectrumRequest, weights: FloatArray | None, *, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a box and nothing beyond it, as ``Evaluator.box`` describes it."""
        half = request.what == "half cube"
        return cube_powers(self.on_device, x, request.largest, weights, half, mean)


def cube_powers(
    p: Precision,
    x: FloatArray,
    fmax: Harmonics,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
) -> tuple[FloatArray, Errors]:
    """Evaluate the power at all frequencies with |f_a| <= fmax, or <= fmax[a].

    Parameters
    ----------
    p : Precision
        Precision on the device.
    x : (sets, n, d) float64
        Checked points.
    fmax : int or tuple of d ints
        Largest harmonic on each axis.
    weights : (sets or 1, n) float64, optional
        Weights of the points; power is divided by the sum of their squares.
    half : bool
        Only the half with f_0 >= 0.
    mean : bool
        Average over sets; otherwise the power of each set.

    Returns
    -------
    power : (2*fmax+1,)*d or (2*fmax[0]+1, ...) float64
        The first axis is only fmax+1 long for a half. An axis of sets precedes it unless ``mean``.
    errors : Errors
        Errors of the square root of the power of any one set.
    """
    sets, n, d = x.shape
    cube = kept(PreparedCube, p, n, d, sets, fmax, half, mean)
    used = cube.fill(x, weights)
    power, largest, errors = cube.writer.result(), max(each_axis(d, fmax)), Errors(0.0, 0.0)
    at = cube.coordinates() if weights is None else coordinates(x, p.name, weights)
    for slots in used:
        errors = errors.or_larger(product_errors(p, n, slots, largest, at))
    return power, errors
