"""A field through the centres of pixels, such as the logarithm of the kernels' width, at points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.gbn.kernel_widths import BORDER
from gbnbench.opencl import Runtime

PACKAGE = "gbnbench.generators"


class SplineField:
    """A cubic spline on the device.

    Parameters
    ----------
    runtime : Runtime
        The device.
    coefficients : (rows, columns[, ...]) float64
        ``BORDER`` more than there are pixels on every side.
    n : int
        Points, at most.
    defines : mapping
        Of the kernel: DOUBLE, LANES, SUM and AXES.
    """

    def __init__(
        self, runtime: Runtime, coefficients: FloatArray, n: int, defines: Mapping[str, int | str]
    ) -> None:
        self._runtime, self._d = runtime, coefficients.ndim
        self._real = np.float64 if defines["DOUBLE"] else np.float32
        self._program = runtime.program(PACKAGE, ("/vector.cl", "adaptive_widths.cl"), defines)
        self._coefficients = runtime.upload(coefficients.astype(self._real))
        self._counts = runtime.upload(np.array(coefficients.shape, np.int32))
        self._found = runtime.empty((self._d + 1) * n * np.dtype(self._real).itemsize)

    def __call__(self, at: Any, n: int) -> tuple[FloatArray, FloatArray]:
        """Look up the field.

        Parameters
        ----------
        at : buffer of (d, n)
            Positions within the pixels.
        n : int
            Points.

        Returns
        -------
        values : (n,) float64
            The field.
        slopes : (n, d) float64
            A pixel.
        """
        rt = self._runtime
        self._program.run(
            "adaptive_widths", (-(-n // rt.group) * rt.group,), (rt.group,),
            np.uint32(n), np.uint32(n), at, self._counts, np.int32(BORDER), self._coefficients, self._found,
        )  # fmt: skip
        found = rt.download(self._found, np.empty((self._d + 1, n), self._real)).astype(np.float64)
        return found[0], found[1:].T
