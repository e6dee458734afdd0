"""The numpy product as an evaluator, which serves every request where there is no OpenCL device."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.numpy_product.errors import numpy_errors
from gbnbench.analysis.spectrum.evaluators.numpy_product.product import numpy_listed_power, numpy_power
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.set_by_set import set_by_set
from gbnbench.analysis.spectrum.evaluators.work_model import CALL_SECONDS, NUMPY_RATE
from gbnbench.analysis.spectrum.limits import cube_fits
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import devices_present


@dataclass(frozen=True)
class NumpyProduct(Evaluator):
    """The product of two tables in plain numpy, one set after another."""

    method: ClassVar[str] = "numpy"
    title: ClassVar[str] = "numpy product"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube", "shells", "listed")

    @classmethod
    def offer(
        cls, request: SpectrumRequest, precision: str, *, floor: float | None = None, forced: bool = False
    ) -> NumpyProduct | None:
        """Offer itself where there is no device, for shells only if their whole cube fits in memory.

        Parameters and returns are those of ``Evaluator.offer``.
        """
        if forced:
            return cls(precision)
        if devices_present() or (request.what == "shells" and not cube_fits(request.fmax, request.d)):
            return None
        return cls(precision)

    @property
    def device(self) -> str:
        """Where it runs."""
        return "numpy, no OpenCL device"

    @property
    def remark(self) -> str:
        """Say that there is no device, which is why it was chosen."""
        return ", and there is no OpenCL device"

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the cost on one core."""
        n, d, f, sets = request.n, request.d, request.fmax, request.realizations
        listed = request.what == "listed"
        work = (60.0 if listed else 1.0) * request.frequencies * n * sets
        held = 16 * request.frequencies if listed else 24 * (2 * f + 1) ** d
        seconds = CALL_SECONDS + work / NUMPY_RATE / (2 if self.precision == "float" else 1)
        return EvaluationCost(2 * work, int(held + n * d * 64), seconds)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the errors of any points."""
        n, d, f = request.n, request.d, request.fmax
        return numpy_errors(n, d, f, self.precision, listed=request.what == "listed")

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it."""
        _, n, d = x.shape

        def one_set(one: FloatArray, w: FloatArray | None) -> tuple[FloatArray, Errors]:
            power = numpy_power(one, fmax, self.precision, w)
            errors = numpy_errors(n, d, fmax, self.precision, one, w)
            return power[fmax:] if half else power, errors

        return set_by_set(x, weights, one_set, mean=mean)

    def listed(
        self, x: FloatArray, frequencies: NDArray[np.int64], weights: FloatArray | None
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power at listed frequencies, as ``Evaluator.listed`` describes it."""
        _, n, d = x.shape
        largest = int(np.abs(frequencies.astype(np.float64)).max())

        def one_set(one: FloatArray, w: FloatArray | None) -> tuple[FloatArray, Errors]:
            errors = numpy_errors(n, d, largest, self.precision, one, w, listed=True)
            return numpy_listed_power(one, frequencies, self.precision, w), errors

        return set_by_set(x, weights, one_set, mean=True)
