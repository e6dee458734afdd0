"""Exact evaluators on the OpenCL device: where they offer themselves."""

from __future__ import annotations

from abc import ABC

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.request import SpectrumRequest
from gbnbench.opencl import devices_present


class DeviceEvaluator(Evaluator, ABC):
    """An exact evaluator that runs on the OpenCL device, where there is one."""

    @classmethod
    def offer(
        cls, request: SpectrumRequest, precision: str, *, floor: float | None = None, forced: bool = False
    ) -> Evaluator | None:
        """Offer itself wherever there is a device that has the precision.

        Parameters and returns are those of ``Evaluator.offer``; the floor is not used, since the method is
        exact.
        """
        if request.what not in cls.serves or not devices_present():
            return None
        if precision == "double" and not precision_of("float").runtime.device.has_double:
            return None
        return cls(precision)
