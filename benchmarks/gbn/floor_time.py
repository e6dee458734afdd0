"""Noise floor against time of the optimisers of Gaussian Blue Noise, in one process and in turn."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.radial.profile_measures import noise_floor, peak, power_at_1
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spatial.bond_order import psi6
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spatial.valence import valence6
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.gbn.floor_cases import SIGMA, Curve, FloorCase
from gbnbench.benchmarks.timing.machine import Row
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.operation_counts import CUTOFF
from gbnbench.generators.gbn.optimiser import Descent, Nesterov
from gbnbench.generators.gbn.step_sizes import authors_step, gaussian_curvature, step_size
from gbnbench.generators.protocol import realization_rng
from gbnbench.opencl import runtime

MEASURES = ("noise_floor", "power_at_1", "excess", "peak", "valence6", "psi6")
FLOOR_TIME = (
    "case", "n", "d", "curve", "method", "step", "precision", "evaluation", "kernel", "cutoff", "set",
    "gradients", "cpu_s", *MEASURES,
)  # fmt: skip


def race(case: FloorCase, advance: Callable[[str, int], object] = lambda *_: None) -> Iterator[Row]:
    """Run every curve of a case to its stops, in turn.

    Parameters
    ----------
    case : FloorCase
        The size, the sets and the curves.
    advance : callable
        Told the curve and the gradients that were done.

    Returns
    -------
    iterator of dict
        One row for each stop, as soon as it is reached.

    Notes
    -----
    CPU time is over all threads, of the optimiser alone: from its construction, the kernels being built
    already, to the stop. What the points are like is measured in double beside the clock.
    """
    for k in range(case.sets):
        yield from race_of_set(case, k, advance)


def race_of_set(
    case: FloorCase, k: int, advance: Callable[[str, int], object] = lambda *_: None
) -> Iterator[Row]:
    """Run every curve of a case on one of its sets, in turn.

    Parameters
    ----------
    case : FloorCase
        The size and the curves.
    k : int
        Number of the set.
    advance : callable
        As ``race`` takes it.

    Returns
    -------
    iterator of dict
        One row for each stop, as soon as it is reached.
    """
    curves = [c for c in case.curves if c.precision == "float" or runtime().device.has_double]
    start = realization_rng(0, k).random((1, case.n, case.d))
    runners = [_Runner(case, curve, start) for curve in curves]
    for stop in sorted({stop for curve in curves for stop in curve.stops()}):
        for runner in runners:
            if stop not in runner.curve.stops():
                continue
            advance(f"{case.title}, set {k + 1}: {runner.curve.title}", runner.advance(stop))
            yield {**runner.row(), "set": k}


class _Runner:
    """One optimiser on one set, with its clock."""

    def __init__(self, case: FloorCase, curve: Curve, start: FloatArray) -> None:
        self.case, self.curve = case, curve
        _optimiser(case, curve, start)[1].advance()  # builds the kernels
        began = time.process_time()
        self.evaluation, self.optimiser = _optimiser(case, curve, start)
        self.spent = time.process_time() - began

    def advance(self, stop: int) -> int:
        """Go on to so many gradients; return how many that took."""
        before, began = self.optimiser.gradients, time.process_time()
        while self.optimiser.gradients < stop:
            self.optimiser.advance()
        self.spent += time.process_time() - began
        return stop - before

    def row(self) -> Row:
        """Tell what was reached, all but the number of the set."""
        cut = CUTOFF[self.curve.precision] if self.evaluation == "strips" else math.nan
        return {
            "case": self.case.title,
            "n": self.case.n,
            "d": self.case.d,
            "curve": self.curve.title,
            "method": self.curve.method,
            "step": self.curve.step,
            "precision": self.curve.precision,
            "evaluation": self.evaluation,
            "kernel": "cut off" if self.curve.cutoff else "whole",
            "cutoff": self.curve.cutoff or cut,
            "gradients": self.optimiser.gradients,
            "cpu_s": self.spent,
            **measured(wrap(self.optimiser.x[0])),
        }


def _optimiser(case: FloorCase, curve: Curve, start: FloatArray) -> tuple[str, Descent]:
    n, d = case.n, case.d
    energy = energy_evaluation(n, d, SIGMA, curve.precision, cutoff=curve.cutoff or None)
    step = authors_step(n, d) if curve.step == "authors" else step_size(n, d, SIGMA)
    if curve.method == "descent":
        return energy.method, Descent(energy, start, step)
    return energy.method, Nesterov(energy, start, step, curvature=gaussian_curvature(d, SIGMA))


def measured(x: FloatArray) -> dict[str, float]:
    """Exact measures of one set (n, d); nan for those that its dimension has not.

    Notes
    -----
    The noise floor is the mean power over 0 < nu <= 0.25, or the lowest shell where that band is empty; the
    excess is that of the whole kernel; the peak is looked for up to nu = 1.5, in three dimensions at most.
    """
    n, d = x.shape
    precision: PrecisionName = "double" if runtime().device.has_double else "float"
    shells = radial(periodogram(x, math.ceil(1.5 * n ** (1 / d)) if d <= 3 else 1, precision=precision))
    try:
        summit = peak(shells)[0]
    except RefusalError:
        summit = math.nan
    around = neighbours(x) if d == 2 else None
    return {
        "noise_floor": noise_floor(shells),
        "power_at_1": power_at_1(shells),
        "excess": float(energy_evaluation(n, d, SIGMA, precision)(x[None]).excess[0]),
        "peak": summit,
        "valence6": math.nan if around is None else float(valence6(around)[0]),
        "psi6": math.nan if around is None else float(psi6(around)[0]),
    }
