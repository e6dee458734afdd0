"""The gridded FFT as an evaluator, with its cost and its errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from gbnbench.analysis.spectrum.coordinate_rounding import rounded_at_worst
from gbnbench.analysis.spectrum.error_model import UNIT, Errors, rms_for
from gbnbench.analysis.spectrum.evaluators.cube_product import CubeProduct
from gbnbench.analysis.spectrum.evaluators.device_evaluator import DeviceEvaluator
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.gridded_fft.bands import BAND_ROWS, CACHE_BYTES, run_count
from gbnbench.analysis.spectrum.evaluators.gridded_fft.errors import WINDOW_TYPICAL, fft_errors, usual_crowd
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import AXES, real_grid
from gbnbench.analysis.spectrum.evaluators.gridded_fft.host_transform import shape_of_harmonics
from gbnbench.analysis.spectrum.evaluators.gridded_fft.plane_transform import plane_serves, transform_numbers
from gbnbench.analysis.spectrum.evaluators.gridded_fft.powers import (
    TooCrowdedError,
    fft_powers,
    sets_together,
)
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.work_model import device_cost, narrow
from gbnbench.analysis.spectrum.limits import BYTES, MEMORY_SHARE
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.memory import memory_limit
from gbnbench.core.torus import FloatArray


class GridWork(NamedTuple):
    """Narrow multiply-adds (work_model.py) that take as long as the parts of a spectrum.

    Attributes
    ----------
    point : float
        A point, on each axis.
    reached, far_reached : float
        A node that it reaches, on a grid that fits in the cache, and on a larger one.
    level : float
        A node and level of the transform.
    written : float
        A power.
    call : float
        All else of a call.
    """

    point: float
    reached: float
    far_reached: float
    level: float
    written: float
    call: float


# By dimension. Fitted to the CPU times of 132 cubes on one Intel core, n = 64 to 16,384 and F = 6 to 2,048,
# in double and in float: 7 to 9 in 10 are within 15%. In the plane bands of a grid stay in
# the cache; the transform writes the powers.
WORK = {
    1: GridWork(200.0, 2.43, 2.43, 0.0, 429.0, 2.42e6),
    2: GridWork(35.0, 6.57, 6.57, 2.65, 0.0, 2.0e6),
    3: GridWork(737.0, 4.0, 5.37, 3.62, 0.0, 4.16e6),
}
LARGEST_TYPICAL = 9.0  # typical error in units of rounding, beyond which crowded points go to the product


@dataclass(frozen=True)
class GriddedFFT(DeviceEvaluator):
    """The gridded FFT beside an OpenCL device that is a CPU, for cubes in up to three dimensions.

    Attributes
    ----------
    allowed : float
        Typical error of sqrt(power) that crowded points may have; inf where it was asked for by name.
    """

    method: ClassVar[str] = "fft"
    title: ClassVar[str] = "gridded FFT"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube")

    allowed: float = math.inf

    @classmethod
    def offer(
        cls, request: SpectrumRequest, precision: str, *, floor: float | None = None, forced: bool = False
    ) -> Evaluator | None:
        """Offer itself in up to three dimensions where its grids fit in memory.

        Parameters and returns are those of ``Evaluator.offer``.
        """
        if request.d > AXES or super().offer(request, precision) is None:
            return None
        evaluator = cls(precision, allowed=math.inf if forced else allowed_error(precision, floor))
        fits = evaluator._held(request) <= MEMORY_SHARE * memory_limit()
        return evaluator if fits and evaluator.on_device.runtime.device.is_cpu else None

    @classmethod
    def why_not(cls, request: SpectrumRequest, precision: str) -> str:
        """Say what it needs.

        Parameters and returns are those of ``Evaluator.why_not``.
        """
        if request.d > AXES:
            return f"the gridded FFT does up to {AXES} dimensions; got d={request.d}"
        return "the gridded FFT needs an OpenCL device that is a CPU, and memory for its grid"

    def work(self, request: SpectrumRequest) -> float:
        """Count the points carried to the grid, its transform, the powers written, and the set-up."""
        return self._arithmetic(request) + narrow(self.on_device) * WORK[request.d].call

    def _arithmetic(self, request: SpectrumRequest) -> float:
        grid = real_grid(request.d, request.fmax, self.precision)
        plane = request.d == 2 and plane_serves(self.on_device, grid)
        work = WORK[3 if request.d == 2 and not plane else request.d]  # large planes go as volumes do
        far = grid.size * grid.itemsize > CACHE_BYTES
        reached = work.far_reached if far else work.reached
        points = request.n * (work.point * request.d + reached * grid.width**request.d)
        nodes, outputs = grid.nodes**request.d, (2 * request.fmax + 1) ** request.d
        each = points + work.level * nodes * math.log2(nodes) + work.written * outputs
        return float(narrow(self.on_device) * request.realizations * each)

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the cost on the device, the points and grids of a batch and their transforms included."""
        held = self._held(request)
        return device_cost(
            self.on_device, request, self._arithmetic(request), 2.0, held, WORK[request.d].call
        )

    def _held(self, request: SpectrumRequest) -> float:
        """Count the bytes of the points and grids of a batch, their transforms and the cube."""
        p, grid = self.on_device, real_grid(request.d, request.fmax, self.precision)
        sets = sets_together(p, grid, request.realizations)
        # Turns, room to sort an axis of them, weights as given and as dealt; then places, and counts of bins.
        points = sets * (request.n * (grid.itemsize * (request.d + 3) + 4) + 4 * grid.bins**grid.d)
        numbers = float(sets)
        if plane_serves(p, grid):
            numbers *= transform_numbers(grid)
            band = min(grid.size, max(2 * BAND_ROWS * grid.row_length, CACHE_BYTES // grid.itemsize))
            numbers += 2 * p.runtime.device.compute_units * band
        else:
            numbers *= 2 * (grid.size + math.prod(shape_of_harmonics(grid)))
        held = numbers * grid.itemsize
        return float(held + points + BYTES * (2 * request.fmax + 1) ** request.d)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the errors for points that are spread over the torus."""
        p, n, grid = self.on_device, request.n, real_grid(request.d, request.fmax, self.precision)
        crowd = usual_crowd(grid, n)
        at = rounded_at_worst(n, request.d, p.name)
        return fft_errors(p, grid, n, crowd, run_count(grid, n, crowd), at)

    def evaluate(
        self, x: FloatArray, request: SpectrumRequest, weights: FloatArray | None, *, mean: bool
    ) -> tuple[FloatArray, Errors, Evaluator]:
        """Give the product's place to crowded points, as ``Evaluator.evaluate`` describes it."""
        try:
            return *self.box(x, request, weights, mean=mean), self
        except TooCrowdedError:
            product = CubeProduct(self.precision)
            return *product.box(x, request, weights, mean=mean), product

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it.

        Where it was not asked for by name, it raises TooCrowdedError for crowded points.
        """
        return fft_powers(self.on_device, x, fmax, weights, half, mean, self.allowed)


def allowed_error(precision: str, floor: float | None) -> float:
    """Give the typical error that crowded points may have: that of others, or more if a floor allows it.

    Parameters
    ----------
    precision : {"double", "float"}
        Precision of the arithmetic.
    floor : float or None
        Smallest power that must be known to 1%.

    Returns
    -------
    float
        Of sqrt(power).
    """
    usual = math.hypot(LARGEST_TYPICAL * UNIT[precision], WINDOW_TYPICAL[precision])
    return usual if floor is None else max(usual, rms_for(floor))
