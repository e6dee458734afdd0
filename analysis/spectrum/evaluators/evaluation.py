"""The evaluations there are, by name: the same power from the same points, each at its own cost and error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators import nufft, numpy_product
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.direct_sum import listed_power
from gbnbench.analysis.spectrum.evaluators.gridded_product import gridded_powers
from gbnbench.core.torus import FloatArray

NUMPY = "numpy, no OpenCL device"
PRODUCT, GRIDDED = "two-group product", "gridded product"
STREAMED, DIRECT = "streamed two-group product", "direct sum"
NUFFT, SEPARABLE = "non-uniform FFT", "numpy product"


@dataclass(frozen=True)
class Evaluation:
    """A method at a precision.

    Attributes
    ----------
    method : str
        By name.
    precision : {"double", "float"}
        Of its arithmetic.
    tolerance : float
        Of a non-uniform FFT; 0 for exact methods.
    """

    method: str
    precision: str
    tolerance: float = 0.0

    @property
    def device(self) -> str:
        """Where it runs."""
        if self.method == NUFFT:
            return "FINUFFT on the CPU"
        return NUMPY if self.method == SEPARABLE else precision_of(self.precision).runtime.device.label

    @property
    def label(self) -> str:
        """Method and precision in a few words."""
        return (
            f"{self.method} to {self.tolerance:.2g}"
            if self.tolerance
            else f"{self.method} in {self.precision}"
        )

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Power of a cube, as ``cube_powers`` returns it."""
        if self.method == PRODUCT:
            return cube_powers(precision_of(self.precision), x, fmax, weights, half, mean)
        if self.method == GRIDDED:
            return gridded_powers(precision_of(self.precision), x, fmax, weights, half, mean)
        sets, n, d = x.shape
        shape = (fmax + 1 if half else 2 * fmax + 1, *[2 * fmax + 1] * (d - 1))
        out = np.zeros((1 if mean else sets, *shape))
        rms = bound = 0.0
        for k, one in enumerate(x):
            w = None if weights is None else weights[k if len(weights) > 1 else 0]
            if self.method == NUFFT:
                power = nufft.nufft_power(one, fmax, self.tolerance, w)
                errors = nufft.nufft_errors(n, d, fmax, self.tolerance, w)
            else:
                power = numpy_product.separable_power(one, fmax, self.precision, w)
                errors = numpy_product.separable_errors(n, d, fmax, self.precision, one, w)
            out[0 if mean else k] += power[fmax:] if half else power
            rms, bound = max(rms, errors.rms), max(bound, errors.bound)
        if mean:
            out /= sets
        return (out[0] if mean else out), Errors(rms, bound)

    def listed(
        self, x: FloatArray, frequencies: NDArray[np.int64], weights: FloatArray | None
    ) -> tuple[FloatArray, Errors]:
        """Power at listed frequencies, averaged over sets."""
        if self.method == DIRECT:
            return listed_power(precision_of(self.precision), x, frequencies, weights)
        sets, n, d = x.shape
        largest = int(np.abs(frequencies.astype(np.float64)).max())
        total, rms, bound = np.zeros(len(frequencies)), 0.0, 0.0
        for k, one in enumerate(x):
            w = None if weights is None else weights[k if len(weights) > 1 else 0]
            total += numpy_product.separable_selected(one, frequencies, self.precision, w)
            errors = numpy_product.separable_errors(n, d, largest, self.precision, one, w, listed=True)
            rms, bound = max(rms, errors.rms), max(bound, errors.bound)
        return total / sets, Errors(rms, bound)
