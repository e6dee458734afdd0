"""The gridded FFT as an evaluator, with its cost and its errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.device_evaluator import DeviceEvaluator
from gbnbench.analysis.spectrum.evaluators.gridded_fft.powers import fft_powers
from gbnbench.analysis.spectrum.evaluators.protocol import EvaluationCost
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class GriddedFFT(DeviceEvaluator):
    """The gridded FFT, for cubes and half cubes of one to three dimensions."""

    method: ClassVar[str] = "fft"
    title: ClassVar[str] = "gridded FFT"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube")

    @classmethod
    def offer(cls, request, precision, *, floor=None, forced=False):
        if not forced or request.d > 3 or request.what not in cls.serves:
            return None
        return cls(precision)

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        return EvaluationCost(1.0, 1, 1.0)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        return Errors(1e-15, 1e-13)

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it."""
        return fft_powers(self.on_device, x, fmax, weights, half, mean), Errors(1e-15, 1e-13)
