"""The non-uniform FFT as an evaluator of cubes in up to three dimensions, to a tolerance."""

from __future__ import annotations

import os
from contextlib import suppress
from dataclasses import dataclass
from typing import ClassVar

from gbnbench.analysis.spectrum.error_model import Errors, rms_for
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.nufft import transform
from gbnbench.analysis.spectrum.evaluators.nufft.cost import nufft_bytes, nufft_seconds
from gbnbench.analysis.spectrum.evaluators.nufft.errors import nufft_errors, nufft_tolerance
from gbnbench.analysis.spectrum.evaluators.nufft.finufft import FINUFFT
from gbnbench.analysis.spectrum.evaluators.nufft.transform import nufft_power
from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import DIMENSIONS, Library
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.set_by_set import set_by_set
from gbnbench.analysis.spectrum.evaluators.work_model import CALL_SECONDS, NUMPY_RATE
from gbnbench.analysis.spectrum.limits import MEMORY_SHARE
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.errors import InputError
from gbnbench.core.memory import memory_limit
from gbnbench.core.torus import FloatArray

WORTH_A_THREAD = 1e-3  # seconds from which on a set is worth a thread of its own


@dataclass(frozen=True)
class NonuniformFFT(Evaluator):
    """The type 1 transform of ducc0 or FINUFFT, each set by itself, in double.

    Attributes
    ----------
    precision : {"double"}
        Precision of its arithmetic.
    tolerance : float
        Relative error of the transform.
    transformer : Library
        The library that transforms.
    """

    method: ClassVar[str] = "nufft"
    title: ClassVar[str] = "non-uniform FFT"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube")
    approximate: ClassVar[bool] = True

    transformer: Library = FINUFFT

    @classmethod
    def offer(
        cls, request: SpectrumRequest, precision: str, *, floor: float | None = None, forced: bool = False
    ) -> NonuniformFFT | None:
        """Offer the preferred library that resolves the floor, at its loosest tolerance that does.

        Without a floor, or where none resolves it, the preferred library is offered at its tightest.
        Parameters and returns are those of ``Evaluator.offer``.
        """
        if request.what not in cls.serves or precision != "double" or request.d > DIMENSIONS:
            return None
        offers = [
            cls(precision, _tolerance(library, request, floor), library) for library in transform.installed()
        ]
        fitting = [one for one in offers if one._held(request) <= MEMORY_SHARE * memory_limit()]
        for one in fitting:
            if floor is None or one.expected_errors(request).rms <= rms_for(floor):
                return one
        return fitting[0] if fitting else None

    @classmethod
    def why_not(cls, request: SpectrumRequest, precision: str) -> str:
        """Say what is missing: a library, a lower dimension, double precision, or memory.

        Parameters and returns are those of ``Evaluator.why_not``.
        """
        if request.d > DIMENSIONS:
            return f"the non-uniform FFT does up to {DIMENSIONS} dimensions; got d={request.d}"
        if not transform.installed():
            return f"the non-uniform FFT needs ducc0 or FINUFFT: {transform.REMEDY}"
        if precision != "double":
            return f"the non-uniform FFT computes in double; got precision={precision!r}"
        return f"the grid of a non-uniform FFT for {request} does not fit in memory; ask for a smaller fmax"

    @property
    def device(self) -> str:
        """Where it runs."""
        return f"{self.transformer.name} on the CPU"

    @property
    def label(self) -> str:
        """Its title and tolerance in a few words."""
        return f"{self.title} to {self.tolerance:.2g}"

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the transforms' cost: each on one core, and as many at a time as the cores take."""
        n, d, f, sets = request.n, request.d, request.fmax, request.realizations
        seconds = sets * nufft_seconds(self.transformer, n, d, f, self.tolerance)
        together = self._together(sets, n, d, f)
        held = together * self._held(request)
        return EvaluationCost(seconds * NUMPY_RATE, held, CALL_SECONDS + seconds / together)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the errors met on scattered and on coincident points."""
        return nufft_errors(self.transformer, request.n, request.d, request.fmax, self.tolerance)

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it.

        Sets that take long enough are dealt to the cores, as many at a time as there is memory for.
        """
        sets, n, d = x.shape
        together = self._together(sets, n, d, fmax)

        def one_set(one: FloatArray, w: FloatArray | None) -> tuple[FloatArray, Errors]:
            power = nufft_power(self.transformer, one, fmax, self.tolerance, w, half=half)
            return power, nufft_errors(self.transformer, n, d, fmax, self.tolerance, w)

        return set_by_set(x, weights, one_set, mean=mean, together=together)

    def _together(self, sets: int, n: int, d: int, fmax: int) -> int:
        """Count the sets that are transformed at the same time."""
        if nufft_seconds(self.transformer, n, d, fmax, self.tolerance) < WORTH_A_THREAD:
            return 1
        room = MEMORY_SHARE * memory_limit() / nufft_bytes(self.transformer, n, d, fmax, self.tolerance)
        return max(1, min(sets, os.cpu_count() or 1, int(room)))

    def _held(self, request: SpectrumRequest) -> int:
        """Count the bytes of one transform."""
        return nufft_bytes(self.transformer, request.n, request.d, request.fmax, self.tolerance)


def _tolerance(library: Library, request: SpectrumRequest, floor: float | None) -> float:
    """Give the loosest tolerance of a library that resolves the floor, or its tightest."""
    if floor is not None:
        with suppress(InputError):
            return nufft_tolerance(library, rms_for(floor), request.n, request.d, request.fmax)
    return library.tightest[request.d - 1]
