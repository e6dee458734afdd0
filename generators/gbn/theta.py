"""The energy over all pairs, each dimension's theta function as a polynomial: exact in any dimension."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import kernel, operation_counts
from gbnbench.generators.gbn.evaluation import AllPairs, means
from gbnbench.generators.gbn.protocol import EnergyGradient
from gbnbench.opencl import Runtime


class Theta(AllPairs):
    """All pairs by polynomials in cos 2 pi (x_k - x_l); see ``EnergyEvaluation`` and kernels/gbn_theta.cl.

    Notes
    -----
    Of degree 1.41 n^(1/d) / sigma or so in double and 1.0 in float: cheap where the box is a few sigmas wide.
    2 degree + 9 vector instructions a pair and dimension.
    """

    method = "theta"

    def __init__(self, runtime: Runtime, n: int, d: int, sigma: float, precision: str) -> None:
        super().__init__(runtime, n, d, sigma, precision)
        self.error = operation_counts.theta(n, d, self.sigma, precision).error
        self.degree = kernel.degree(self.side, sigma, precision)
        self._unit = kernel.unit(self.side, sigma, d, precision)
        flat = self._unit != 1
        coefficients = kernel.polynomial(self.side, sigma, self.degree, flat)
        self._weight = runtime.upload(coefficients.astype(self.real))
        self._program = self.program(
            "/turns.cl", "gbn_circle.cl", "gbn_theta.cl", DEGREE=self.degree, FLAT=int(flat)
        )

    def _sums(self, x: FloatArray) -> EnergyGradient:
        circle = self.buffer("circle", 2 * x.size)
        turns = self.send_turns(x)
        self.launch(self._program, "gbn_circle", -(-x.size // self.lanes), turns, np.uint32(x.size), circle)
        slopes, sums = self.sum_pairs(self._program, "gbn_theta", len(x), circle, self._weight)
        # The kernel's theta has mean 1 over the box, and its slope is by y over -2 pi, per box side.
        mean = self._unit * (math.sqrt(2 * math.pi) * self.sigma / self.side) ** self.d
        slopes *= -2 * math.pi * mean / self.side
        return EnergyGradient(slopes, means(sums) * (mean / 2))
