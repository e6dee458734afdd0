"""Noise floor against time of the optimisers of Gaussian Blue Noise, in one process and in turn."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.radial.profile_measures import noise_floor, peak, power_at_1
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spatial.bond_order import psi6
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spatial.valence import valence6
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.gbn.cutoffs import FORCES, forces
from gbnbench.benchmarks.gbn.floor_cases import SIGMA, Curve, FloorBenchmark, FloorCase
from gbnbench.benchmarks.timing.machine import Rows, describe
from gbnbench.benchmarks.timing.threads import one_blas_thread
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.execution.progress import Progress
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.operation_counts import CUTOFF
from gbnbench.generators.gbn.optimiser import Descent, Nesterov
from gbnbench.generators.gbn.published_quality import AUTHORS_FLOOR
from gbnbench.generators.gbn.step_sizes import authors_step, step_size
from gbnbench.generators.protocol import realization_rng
from gbnbench.opencl import runtime

MEASURES = ("noise_floor", "power_at_1", "excess", "peak", "valence6", "psi6")
FLOOR_TIME = (
    "case", "n", "d", "curve", "method", "step", "precision", "evaluation", "kernel", "cutoff", "set",
    "gradients", "cpu_s", *MEASURES,
)  # fmt: skip
SPEEDUP = (
    "case", "precision", "against", "floor", "sets", "cpu_s", "gradients", "their_cpu_s", "their_gradients",
    "ratio", "ratio_min", "ratio_max",
)  # fmt: skip
Row = dict[str, Any]


@dataclass(frozen=True)
class FloorTables:
    """Everything measured.

    Attributes
    ----------
    machine : dict
        Processor, device, versions.
    floors, forces, speedups : DataFrame
        The three tables; see ``FLOOR_TIME``, ``cutoffs.FORCES`` and ``SPEEDUP``.
    """

    machine: Mapping[str, Any]
    floors: pd.DataFrame
    forces: pd.DataFrame
    speedups: pd.DataFrame


def run(out: Path, plan: FloorBenchmark, progress: Progress) -> FloorTables:
    """Measure all of a plan and write it into a folder, each row as soon as it is known.

    Parameters
    ----------
    out : Path
        Made where missing; ``floor_time.csv``, ``forces.csv``, ``speedup.csv`` and ``machine.json`` in it are
        replaced.
    plan : FloorBenchmark
        Cases and curves.
    progress : Progress
        Told what is being done; its steps are gradients.

    Returns
    -------
    FloorTables
        The tables, as they were written.

    Raises
    ------
    InputError
        If out cannot be a folder.
    DeviceError
        If there is no OpenCL device.
    """
    if out.exists() and not out.is_dir():
        raise InputError(f"--out must be a folder; {out} is a file")
    machine = describe()
    out.mkdir(parents=True, exist_ok=True)
    write_whole(out / "machine.json", (json.dumps(machine, indent=2) + "\n").encode())
    progress.start(plan.steps, 0, "forces by cut-off")  # before its gradients are counted
    with one_blas_thread():
        with Rows(out / "forces.csv", FORCES) as file:
            for n, d in plan.forces:
                for row in forces(n, d, plan.seconds, plan.probes):
                    file.add(row)
            by_cutoff = pd.DataFrame(file.kept, columns=FORCES)
        progress.start(plan.steps, 0, "noise floors")
        with Rows(out / "floor_time.csv", FLOOR_TIME) as file:
            for case in plan.cases:
                for row in race(case, progress.advance):
                    file.add(row)
            floors = pd.DataFrame(file.kept, columns=FLOOR_TIME)
    speedups = speedup(floors)
    write_whole(out / "speedup.csv", speedups.to_csv(index=False, float_format="%.6g").encode())
    return FloorTables(machine, floors, by_cutoff, speedups)


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
    curves = [c for c in case.curves if c.precision == "float" or runtime().device.has_double]
    for k in range(case.sets):
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
    return energy.method, Nesterov(energy, start, step, sigma=SIGMA)


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


def speedup(floors: pd.DataFrame) -> pd.DataFrame:
    """CPU seconds to one floor, Nesterov beside each descent of its precision.

    Parameters
    ----------
    floors : DataFrame
        Columns ``FLOOR_TIME``.

    Returns
    -------
    DataFrame
        Columns ``SPEEDUP``. The floor is that of the authors' sets, 6.6e-10, or the deepest that every set
        of both methods reaches where that is higher; seconds and gradients are medians over the sets, found
        between stops on straight lines in log-log scale; the ratio is taken set by set, its median, least
        and largest given.
    """
    rows = []
    whole = floors[floors.kernel == "whole"]
    for (case, precision), part in whole.groupby(["case", "precision"], sort=False):
        ours, theirs = part[part.method == "nesterov"], part[part.method == "descent"]
        for name, other in theirs.groupby("curve", sort=False):
            deepest = pd.concat([ours, other]).groupby(["curve", "set"]).noise_floor.min()
            floor = max(AUTHORS_FLOOR, float(deepest.max()))
            mine, his = crossings(ours, floor), crossings(other, floor)
            ratio = his[:, 0] / mine[:, 0]
            rows.append(
                {
                    "case": case,
                    "precision": precision,
                    "against": name,
                    "floor": floor,
                    "sets": len(ratio),
                    "cpu_s": float(np.median(mine[:, 0])),
                    "gradients": float(np.median(mine[:, 1])),
                    "their_cpu_s": float(np.median(his[:, 0])),
                    "their_gradients": float(np.median(his[:, 1])),
                    "ratio": float(np.median(ratio)),
                    "ratio_min": float(ratio.min()),
                    "ratio_max": float(ratio.max()),
                }
            )
    return pd.DataFrame(rows, columns=SPEEDUP)


def crossings(curve: pd.DataFrame, floor: float) -> FloatArray:
    """Find where each set of a curve first reaches a floor.

    Parameters
    ----------
    curve : DataFrame
        Rows of one curve.
    floor : float
        The noise floor.

    Returns
    -------
    (sets, 2) float64
        CPU seconds and gradients; nan where a set does not reach it.
    """
    found = []
    for _, part in curve.groupby("set"):
        level = np.log(part.noise_floor.to_numpy(float))
        spent = np.log(part[["cpu_s", "gradients"]].to_numpy(float))
        below = np.flatnonzero(level <= math.log(floor))
        if not len(below):
            found.append(np.full(2, math.nan))
        elif (k := int(below[0])) == 0:
            found.append(np.exp(spent[0]))
        else:
            share = (level[k - 1] - math.log(floor)) / (level[k - 1] - level[k])
            found.append(np.exp(spent[k - 1] + share * (spent[k] - spent[k - 1])))
    return np.array(found)
