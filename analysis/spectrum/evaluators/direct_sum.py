"""Power at listed frequencies of 64 bits, by one cosine and sine for each point and frequency."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.coordinate_rounding import Coordinates, coordinates, rounded_at_worst
from gbnbench.analysis.spectrum.error_model import Errors, sum_errors
from gbnbench.analysis.spectrum.evaluators.device_evaluator import DeviceEvaluator
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.point_blocks import (
    POINTS,
    BlockedSum,
    merged_errors,
    point_blocks,
)
from gbnbench.analysis.spectrum.evaluators.two_group_product import norms_of
from gbnbench.analysis.spectrum.evaluators.work_model import COSINE, SET_UP, device_cost, narrow
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.torus import FloatArray

ITEMS = 16  # work-items for each core of a CPU, if the frequencies are few
GPU_ITEMS = 256  # the same for each multiprocessor of a GPU


@dataclass(frozen=True)
class DirectSum(DeviceEvaluator):
    """The direct sum on the OpenCL device, for listed frequencies."""

    method: ClassVar[str] = "direct"
    title: ClassVar[str] = "direct sum"
    serves: ClassVar[tuple[Frequencies, ...]] = ("listed",)

    def work(self, request: SpectrumRequest) -> float:
        """Count the sines and cosines, and the set-up."""
        return super().work(request) + narrow(self.on_device) * SET_UP

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the sum's cost on the device."""
        work = request.frequencies * (COSINE + 2 * request.d) * request.n * request.realizations
        points = min(request.n * request.realizations, POINTS)
        return device_cost(self.on_device, request, work, 2.0, request.frequencies * 64, points=points)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the sum's errors, coordinates being exact in double and rounded at worst in float."""
        p, n = self.on_device, request.n
        length = run_length(p, request.frequencies, min(n, POINTS))
        return _errors(p, n, request.fmax, length, rounded_at_worst(n, request.d, p.name))

    def listed(
        self, x: FloatArray, frequencies: NDArray[np.int64], weights: FloatArray | None
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power at listed frequencies, as ``Evaluator.listed`` describes it."""
        return listed_power(self.on_device, x, frequencies, weights)


def listed_power(
    p: Precision, x: FloatArray, frequencies: NDArray[np.int64], weights: FloatArray | None = None
) -> tuple[FloatArray, Errors]:
    """Evaluate the power at listed frequencies, averaged over sets.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    x : (sets, n, d) float64
        Checked points.
    frequencies : (m, d) int64
        Cycles per unit length.
    weights : (sets or 1, n) float64, optional
        Weights of the points; power is divided by the sum of their squares.

    Returns
    -------
    power : (m,) float64
    errors : Errors
        Errors of the square root of the power of any one set.
    """
    sets, n, d = x.shape
    m, together = len(frequencies), min(n, POINTS)
    stride = padded(together, p.lanes)
    length = run_length(p, m, together)
    runs = -(-stride // length)
    program = p.program("selected.cl")
    multiples = p.runtime.upload(frequencies.T.astype(np.uint64).astype(p.turn))
    out = p.runtime.empty(2 * runs * m * np.dtype(p.sum).itemsize)
    local = p.runtime.group
    total = np.zeros(m)
    for k, (one, norm) in enumerate(zip(x, norms_of(weights, sets, n), strict=True)):
        own = None if weights is None else weights[k if len(weights) > 1 else 0]
        summed = BlockedSum()
        for block, given in point_blocks(one, own) if n > POINTS else _whole(one, own):
            weight = np.zeros(stride, p.real)
            weight[:together] = 1 if given is None else given[0]
            program.run(
                "selected",
                (padded(m, local), runs),
                (local, 1),
                multiples,
                p.runtime.upload(p.turns(block, stride)),
                p.runtime.upload(weight),
                out,
                np.uint32(m),
                np.uint32(d),
                np.uint32(stride),
                np.uint32(length),
            )
            found = p.runtime.download(out, np.empty((runs, 2, m), p.sum))
            summed.add(found.astype(np.float64).sum(axis=0))
        sums = summed.value
        total += (sums[0] ** 2 + sums[1] ** 2) / norm
    largest = int(np.abs(frequencies.astype(np.float64)).max())
    return total / sets, _errors(p, n, largest, length, coordinates(x, p.name, weights))


def _whole(x: FloatArray, weights: FloatArray | None) -> list[tuple[FloatArray, FloatArray | None]]:
    """Give a set that needs no cutting as its only block."""
    return [(x[None], None if weights is None else weights[None])]


def _errors(p: Precision, n: int, largest: int, length: int, at: Coordinates) -> Errors:
    """State the errors, of a set that is cut in blocks those of the sum over these."""
    errors = listed_errors(p, min(n, POINTS), largest, length, at)
    return merged_errors(p, errors, at) if n > POINTS else errors


def run_length(p: Precision, m: int, n: int) -> int:
    """Choose how many points a work-item takes, so that even a few frequencies keep every core busy.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    m, n : int
        Number of frequencies, and points of a set.

    Returns
    -------
    int
        A multiple of the lanes.
    """
    device = p.runtime.device
    items = device.compute_units * (ITEMS if device.is_cpu else GPU_ITEMS)
    runs = max(1, min(-(-items // m), -(-n // (p.sum_points * p.lanes))))
    return padded(-(-n // runs), p.lanes)


def listed_errors(p: Precision, n: int, largest: int, length: int, at: Coordinates) -> Errors:
    """State the errors of sqrt(power), for one cosine a term and sums whose rounding is kept.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    n : int
        Points of a set.
    largest : int
        Largest |f_a|.
    length : int
        Points of a work-item.
    at : Coordinates
        Rounding of the coordinates.

    Returns
    -------
    Errors
    """
    beyond = p.lanes.bit_length() + 2 + -(-n // length)
    in_registers = min(p.sum_points, -(-length // p.lanes))
    return sum_errors(
        p.name, "double" if p.sum is np.float64 else "float", at, largest, 0, in_registers, beyond
    )
