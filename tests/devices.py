"""The device at hand in the form of another, for tests of kernels."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from gbnbench.analysis.precision import Precision
from gbnbench.opencl import Runtime, runtime


@cache
def gpu_form(double: bool = True, has_double: bool = True) -> Precision:
    """Precision as on a GPU, one lane a work-item and work-groups of 64, on the device at hand."""
    device = replace(runtime().device, is_cpu=False, has_double=has_double)
    return Precision(Runtime(device), double, 1)
