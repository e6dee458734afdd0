"""The non-uniform FFT as an evaluator of cubes in up to three dimensions, to a tolerance."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import ClassVar

from gbnbench.analysis.spectrum.error_model import Errors, rms_for
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.nufft import transform
from gbnbench.analysis.spectrum.evaluators.nufft.cost import nufft_bytes, nufft_seconds
from gbnbench.analysis.spectrum.evaluators.nufft.errors import nufft_errors, nufft_tolerance
from gbnbench.analysis.spectrum.evaluators.nufft.limits import DIMENSIONS, TIGHTEST
from gbnbench.analysis.spectrum.evaluators.nufft.transform import nufft_power
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.set_by_set import set_by_set
from gbnbench.analysis.spectrum.evaluators.work_model import CALL_SECONDS, NUMPY_RATE
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class NonuniformFFT(Evaluator):
    """FINUFFT's type 1 transform, one set after another, in double."""

    method: ClassVar[str] = "nufft"
    title: ClassVar[str] = "non-uniform FFT"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube")
    approximate: ClassVar[bool] = True

    @classmethod
    def offer(
        cls, request: SpectrumRequest, precision: str, *, floor: float | None = None, forced: bool = False
    ) -> NonuniformFFT | None:
        """Offer itself at the loosest tolerance that resolves the floor, or at its tightest.

        Parameters and returns are those of ``Evaluator.offer``.
        """
        if request.what not in cls.serves or precision != "double":
            return None
        if request.d > DIMENSIONS or not transform.available():
            return None
        tolerance = TIGHTEST
        if floor is not None:
            with suppress(InputError):  # where the floor is out of reach, it is offered at its tightest
                tolerance = nufft_tolerance(rms_for(floor), request.n, request.d, request.fmax)
        return cls(precision, tolerance)

    @classmethod
    def why_not(cls, request: SpectrumRequest, precision: str) -> str:
        """Say what is missing: FINUFFT, a lower dimension, or double precision.

        Parameters and returns are those of ``Evaluator.why_not``.
        """
        if request.d > DIMENSIONS:
            return f"the non-uniform FFT does up to {DIMENSIONS} dimensions; got d={request.d}"
        if not transform.available():
            return "the non-uniform FFT needs FINUFFT: pip install finufft"
        return f"the non-uniform FFT computes in double; got precision={precision!r}"

    @property
    def device(self) -> str:
        """Where it runs."""
        return "FINUFFT on the CPU"

    @property
    def label(self) -> str:
        """Its title and tolerance in a few words."""
        return f"{self.title} to {self.tolerance:.2g}"

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the transforms' cost on one core."""
        n, d, f = request.n, request.d, request.fmax
        seconds = request.realizations * nufft_seconds(n, d, f, self.tolerance)
        room = nufft_bytes(n, d, f, self.tolerance)
        return EvaluationCost(seconds * NUMPY_RATE, room, CALL_SECONDS + seconds)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the errors met on scattered and on coincident points."""
        return nufft_errors(request.n, request.d, request.fmax, self.tolerance)

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it."""
        _, n, d = x.shape

        def one_set(one: FloatArray, w: FloatArray | None) -> tuple[FloatArray, Errors]:
            power = nufft_power(one, fmax, self.tolerance, w)
            return power[fmax:] if half else power, nufft_errors(n, d, fmax, self.tolerance, w)

        return set_by_set(x, weights, one_set, mean=mean)
