"""Protocol of evaluators, each of which is one way to compute the power of point sets.

An evaluator states the frequencies that it serves, its cost and its errors, and evaluates. Each stands in a
module of its own and is named once, in ``registry.py``. ``gbnbench.analysis.spectrum.choice`` asks every one
of them and knows none by name.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision, precision_of
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.limits import cube_fits
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.analysis.spectrum.shell_moments import ShellMoments, moments_of_cube
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Evaluator(ABC):
    """One way to compute power, at a precision.

    Subclasses state ``method``, ``title`` and ``serves``, and define ``offer``, ``cost``, ``expected_errors``
    and at least one of ``cube`` and ``listed``; ``shells`` is taken from the whole cube unless defined too.

    Attributes
    ----------
    precision : {"double", "float"}
        Precision of its arithmetic.
    tolerance : float
        Relative error that was chosen for an approximate method; 0 for an exact one.
    """

    method: ClassVar[str]
    """One word by which users ask for it."""
    title: ClassVar[str]
    """Its name in sentences and tables."""
    serves: ClassVar[tuple[Frequencies, ...]]
    """The sets of frequencies that it evaluates."""
    approximate: ClassVar[bool] = False
    """Whether it leaves out more than rounding does, so that it is taken only where a floor allows it."""

    precision: str
    tolerance: float = 0.0

    @classmethod
    @abstractmethod
    def offer(
        cls, request: SpectrumRequest, precision: str, *, floor: float | None = None, forced: bool = False
    ) -> Evaluator | None:
        """Return an evaluator for a request, or None where it cannot serve it or is not worth its set-up.

        Parameters
        ----------
        request : SpectrumRequest
            The frequencies, points and sets.
        precision : {"double", "float"}
            Precision of the arithmetic.
        floor : float, optional
            Smallest power that must be known to 1%; an approximate method chooses its tolerance by it.
        forced : bool
            Whether the user asked for this method.

        Returns
        -------
        Evaluator or None
        """

    @classmethod
    def why_not(cls, request: SpectrumRequest, precision: str) -> str:
        """Say why ``offer`` gave nothing for a request whose frequencies it serves.

        Parameters
        ----------
        request : SpectrumRequest
            The request that it cannot serve.
        precision : {"double", "float"}
            Precision that was asked for.

        Returns
        -------
        str
            A sentence for an error message.
        """
        return (
            f"{cls.method} needs an OpenCL device, and there is none; gbnbench devices tells how to get one"
        )

    @abstractmethod
    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate what a request takes, before there are any points."""

    @abstractmethod
    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the errors of sqrt(power) for one set, before the points are known."""

    def work(self, request: SpectrumRequest) -> float:
        """Count what a request takes in multiply-adds, to compare exact evaluators without any timing."""
        return self.cost(request).flops / 2

    @property
    def device(self) -> str:
        """Where it runs."""
        return self.on_device.runtime.device.label

    @property
    def label(self) -> str:
        """Its title and precision in a few words."""
        return f"{self.title} in {self.precision}"

    @property
    def remark(self) -> str:
        """A remark for tables besides the reason of the choice; empty for most."""
        return ""

    @cached_property
    def on_device(self) -> Precision:
        """The precision on the OpenCL device; raises DeviceError where the device lacks it."""
        return precision_of(self.precision)

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube.

        Parameters
        ----------
        x : (sets, n, d) float64
            Checked points.
        fmax : int
            Largest harmonic on each axis.
        weights : (sets or 1, n) float64 or None
            Weights of the points; power is divided by the sum of their squares.
        half : bool
            Only the half with f_0 >= 0.
        mean : bool
            Average over sets; otherwise the power of each set.

        Returns
        -------
        power : (2*fmax+1,)*d float64
            The first axis only fmax+1 long for a half; preceded by an axis of sets unless ``mean``.
        errors : Errors
            Errors of the square root of the power of any one set.
        """
        raise InputError(f"{self.method} does not evaluate cubes of frequencies")

    def box(
        self, x: FloatArray, request: SpectrumRequest, weights: FloatArray | None, *, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, or of a box: the cube of its largest harmonic, cut, if not better.

        Parameters and returns are those of ``Evaluator.cube``, with the request in place of ``fmax`` and
        ``half``; power is (2*f_a+1, ...), f_a being the largest harmonic on axis a.
        """
        half, f = request.what == "half cube", request.fmax
        if not request.harmonics:
            return self.cube(x, f, weights, half=half, mean=mean)
        if not cube_fits(f, request.d):
            raise InputError(
                f"{request} are evaluated as a cube where there is no OpenCL device, and that does not fit "
                "in memory; ask for a smaller fmax"
            )
        power, errors = self.cube(x, f, weights, half=half, mean=mean)
        inner: list[Any] = [slice(f - h, f + h + 1) for h in request.harmonics]
        if half:
            inner[0] = slice(0, request.harmonics[0] + 1)
        return np.ascontiguousarray(power[(..., *inner)]), errors

    def evaluate(
        self, x: FloatArray, request: SpectrumRequest, weights: FloatArray | None, *, mean: bool
    ) -> tuple[FloatArray, Errors, Evaluator]:
        """Evaluate the power of a cube or a box, or have an exact evaluator do it for points that are hard.

        Parameters are those of ``box``.

        Returns
        -------
        power, errors
            As ``box`` returns them.
        evaluator : Evaluator
            Itself, or an exact one where these points make its errors larger than it stated without them.
        """
        power, errors = self.box(x, request, weights, mean=mean)
        return power, errors, self

    def listed(
        self, x: FloatArray, frequencies: NDArray[np.int64], weights: FloatArray | None
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power at listed frequencies, averaged over sets.

        Parameters
        ----------
        x : (sets, n, d) float64
            Checked points.
        frequencies : (m, d) int64
            Cycles per unit length.
        weights : (sets or 1, n) float64 or None
            As in ``cube``.

        Returns
        -------
        power : (m,) float64
        errors : Errors
            As in ``cube``.
        """
        raise InputError(f"{self.method} does not evaluate listed frequencies")

    def shells(
        self,
        x: FloatArray,
        request: SpectrumRequest,
        weights: FloatArray | None,
        progress: Callable[[float], None] | None = None,
    ) -> tuple[ShellMoments, Errors]:
        """Evaluate count, mean and spread of the power on shells, averaged over sets before.

        Parameters
        ----------
        x : (sets, n, d) float64
            Checked points.
        request : SpectrumRequest
            A request for shells.
        weights : (sets or 1, n) float64 or None
            As in ``cube``.
        progress : callable, optional
            Called now and then with the share done.

        Returns
        -------
        moments : ShellMoments
        errors : Errors
            As in ``cube``.
        """
        fmax = min(request.fmax, math.isqrt(request.high))
        power, errors = self.cube(x, fmax, weights, half=False, mean=True)
        return moments_of_cube(power, fmax, request), errors
