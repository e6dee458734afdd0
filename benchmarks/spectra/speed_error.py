"""Speed against error of the periodogram beside its rivals, and how its cost grows, in one process."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from gbnbench.analysis.spectrum.evaluators.cube_product import CubeProduct
from gbnbench.benchmarks.spectra.cases import SpectrumBenchmark, SpectrumCase
from gbnbench.benchmarks.spectra.cores import Throughput, throughput
from gbnbench.benchmarks.spectra.hard_cases import hard_cases
from gbnbench.benchmarks.spectra.hard_table import evaluate, judged
from gbnbench.benchmarks.spectra.reference import LongArray, reference_roots
from gbnbench.benchmarks.spectra.rivals import Rival, ours, rivals
from gbnbench.benchmarks.spectra.tile import tile_share
from gbnbench.benchmarks.timing.interleaved import Timing, interleave
from gbnbench.benchmarks.timing.machine import Rows, describe, peaks
from gbnbench.benchmarks.timing.threads import one_blas_thread
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError
from gbnbench.core.results.resolution import resolvable_power
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress

STEEP = 1e7  # operations from which a slope is fitted: below, launching the kernels is what costs
TIMES = ("cpu_ms", "cpu_ms_median", "wall_ms", "wall_ms_median")
SIZE = ("n", "d", "F", "sets")
SPEED = (
    "case", *SIZE, "method", "family", "precision", "evaluation", "rounds", *TIMES, "ratio", "ratio_min",
    "ratio_max", "error_rms", "error_largest", "resolvable", "share_of_peak",
)  # fmt: skip
SCALING = (
    "sweep",
    *SIZE,
    "method",
    "family",
    "precision",
    "evaluation",
    "flops",
    "rounds",
    *TIMES,
    "share_of_peak",
)
Row = dict[str, Any]


@dataclass(frozen=True)
class SpectrumTables:
    """Everything measured.

    Attributes
    ----------
    machine : dict
        Processor, device, versions, peaks, throughput of two cores.
    speed, scaling, hard : DataFrame
        The three tables; see ``SPEED``, ``SCALING`` and ``hard_table.judged``.
    throughput : Throughput
        Of two cores over one.
    """

    machine: Mapping[str, Any]
    speed: pd.DataFrame
    scaling: pd.DataFrame
    hard: pd.DataFrame
    throughput: Throughput


def run(out: Path, plan: SpectrumBenchmark, progress: Progress) -> SpectrumTables:
    """Measure all of a plan and write it into a folder, each row as soon as it is known.

    Parameters
    ----------
    out : Path
        Made where missing; ``periodogram.csv``, ``scaling.csv``, ``hard_cases.csv`` and ``machine.json`` in
        it are replaced.
    plan : SpectrumBenchmark
        Cases and sweeps.
    progress : Progress
        Told what is being done.

    Returns
    -------
    SpectrumTables
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
    progress.start(plan.steps(), 0, "hard cases")
    hard = _hard(out, plan)
    most = peaks()
    progress.advance("periodogram")
    with one_blas_thread(), Rows(out / "periodogram.csv", SPEED) as file:
        for case in plan.cases:
            progress.advance(case.title, 0)
            for row in compare(case, plan, most):
                file.add(row)
            progress.advance(case.title)
        speed = pd.DataFrame(file.kept, columns=SPEED)
    with Rows(out / "scaling.csv", SCALING) as file:
        for name, cases in plan.sweeps.items():
            for case in cases:
                for row in grow(name, case, plan, most):
                    file.add(row)
                progress.advance(f"sweep of {name}")
        scaling = pd.DataFrame(file.kept, columns=SCALING)
    progress.advance("two cores over one", 0)
    cores = (
        throughput(plan.core_seconds, plan.core_rounds)
        if plan.core_rounds
        else Throughput(reason="not asked")
    )
    machine |= {"fma_flops_a_second": {p: _jsonable(peak) for p, peak in most.items()}}
    machine |= {
        "tile_flops_a_second": {p: dict(zip(("tile", "peak"), tile_share(p), strict=True)) for p in most}
    }
    machine |= {"two_cores": asdict(cores) | {"ratio": _jsonable(cores.ratio)}}
    write_whole(out / "machine.json", (json.dumps(machine, indent=2) + "\n").encode())
    progress.advance("done")
    return SpectrumTables(machine, speed, scaling, hard, cores)


def compare(case: SpectrumCase, plan: SpectrumBenchmark, most: Mapping[str, float]) -> Iterator[Row]:
    """Time every rival on one case and take its error.

    Parameters
    ----------
    case : SpectrumCase
        Points in a set, dimension, largest harmonic, number of sets.
    plan : SpectrumBenchmark
        Gives the time to spend, the longest call and the number of probes.
    most : mapping
        The multiply-add peak of one core by precision.

    Returns
    -------
    iterator of dict
        One row for each rival, ours first.
    """
    x = case.points()
    every = list(rivals(case.n, case.d, case.fmax, case.sets, plan.longest))
    timings = interleave({r.name: r.prepare(x, case.fmax) for r in every}, plan.seconds)
    f, truth = sample(case, x[0], plan.probes)
    for rival in every:
        timing = timings[rival.name]
        ratio = timing.over(timings[every[0].name])
        error = errors(rival, x[0], case.fmax, f, truth)
        yield {
            **_size(case),
            "case": case.title,
            "method": rival.name,
            "family": rival.family,
            "precision": rival.precision,
            "evaluation": rival.evaluation,
            **_times(timing),
            "ratio": float(np.median(ratio)),
            "ratio_min": float(ratio.min()),
            "ratio_max": float(ratio.max()),
            "error_rms": float(np.sqrt(np.mean(error**2))),
            "error_largest": float(error.max()),
            "resolvable": resolvable_power(float(np.sqrt(np.mean(error**2)))),
            "share_of_peak": _share(case, rival, timing, most),
        }
    if case.quoted is not None:
        name, seconds = case.quoted
        ratio = seconds / timings[every[0].name].cpu
        row: Row = dict.fromkeys(SPEED, math.nan)
        yield {
            **row,
            **_size(case),
            "case": case.title,
            "method": name,
            "family": name,
            "precision": "float",
            "evaluation": "",
            "rounds": 0,
            "cpu_ms": 1e3 * seconds,
            "ratio": float(np.median(ratio)),
            "ratio_min": float(ratio.min()),
            "ratio_max": float(ratio.max()),
        }


def grow(sweep: str, case: SpectrumCase, plan: SpectrumBenchmark, most: Mapping[str, float]) -> Iterator[Row]:
    """Time gbnbench on one size of a sweep, and the plain product where it chooses another.

    Parameters
    ----------
    sweep : str
        Name of the sweep.
    case : SpectrumCase
        The size.
    plan : SpectrumBenchmark
        Gives the time to spend.
    most : mapping
        The multiply-add peak of one core by precision.

    Returns
    -------
    iterator of dict
    """
    x = case.points()
    every = list(ours(case.n, case.d, case.fmax, case.sets))
    timings = interleave({r.name: r.prepare(x, case.fmax) for r in every}, plan.sweep_seconds)
    for rival in every:
        yield {
            **_size(case),
            "sweep": sweep,
            "method": rival.name,
            "family": rival.family,
            "precision": rival.precision,
            "evaluation": rival.evaluation,
            "flops": case.flops,
            **_times(timings[rival.name]),
            "share_of_peak": _share(case, rival, timings[rival.name], most),
        }


def sample(case: SpectrumCase, x: FloatArray, probes: int) -> tuple[Any, LongArray]:
    """Choose random frequencies of the cube, and compute the square root of the true power there.

    Parameters
    ----------
    case : SpectrumCase
        The size.
    x : (n, d) float64
        Points of one set.
    probes : int
        Number of frequencies.

    Returns
    -------
    frequencies : (m, d) int64
    roots : (m,) long double
    """
    f = np.random.default_rng(case.n).integers(-case.fmax, case.fmax + 1, (probes, case.d))
    return f, reference_roots(x, f)


def errors(rival: Rival, x: FloatArray, fmax: int, f: Any, truth: LongArray) -> FloatArray:
    """Measure the errors of the square root of power of one set.

    Parameters
    ----------
    rival : Rival
        The way to the power.
    x : (n, d) float64
        Points of one set.
    fmax : int
        Largest harmonic on each axis.
    f : (m, d) int64
        Frequencies.
    truth : (m,) long double
        The true roots there.

    Returns
    -------
    (m,) float64
        Absolute errors.
    """
    power = rival.prepare(x[None], fmax)()[tuple((f + fmax).T)]
    away: FloatArray = np.abs(np.sqrt(power.astype(np.longdouble)) - truth).astype(np.float64)
    return away


def slopes(scaling: pd.DataFrame) -> pd.DataFrame:
    """Slope of log CPU time against log work asked for, a row a sweep and method.

    Returns
    -------
    DataFrame
        sweep, method, sizes, slope (least squares over sizes of at least 1e7 operations; nan where these span
        less than a factor of ten), steepest (largest slope between neighbours), share_least and share_most
        (of the peak, over the same sizes; nan where the plain product is not what ran).
    """
    rows = []
    for (sweep, method), part in scaling.groupby(["sweep", "method"], sort=False):
        large = part[part.flops >= STEEP].sort_values("flops")
        work, cost = np.log(large.flops.to_numpy(float)), np.log(large.cpu_ms.to_numpy(float))
        wide = len(work) > 1 and work[-1] - work[0] >= math.log(10)
        apart = np.diff(work) > math.log(1.2)
        local = np.diff(cost)[apart] / np.diff(work)[apart]
        rows.append(
            {
                "sweep": sweep,
                "method": method,
                "sizes": len(large),
                "slope": float(np.polyfit(work, cost, 1)[0]) if wide else math.nan,
                "steepest": float(local.max()) if wide else math.nan,
                "share_least": float(large.share_of_peak.min()),
                "share_most": float(large.share_of_peak.max()),
            }
        )
    return pd.DataFrame(rows)


def _hard(out: Path, plan: SpectrumBenchmark) -> pd.DataFrame:
    frame = judged([row for case in hard_cases(plan.quick) for row in evaluate(case)])
    write_whole(out / "hard_cases.csv", frame.to_csv(index=False, float_format="%.6g").encode())
    return frame


def _size(case: SpectrumCase) -> Row:
    return {"n": case.n, "d": case.d, "F": case.fmax, "sets": case.sets}


def _times(timing: Timing) -> Row:
    return {
        "rounds": len(timing.cpu),
        "cpu_ms": 1e3 * float(timing.cpu.min()),
        "cpu_ms_median": 1e3 * float(np.median(timing.cpu)),
        "wall_ms": 1e3 * float(timing.wall.min()),
        "wall_ms_median": 1e3 * float(np.median(timing.wall)),
    }


def _share(case: SpectrumCase, rival: Rival, timing: Timing, most: Mapping[str, float]) -> float:
    """Share of what one core can do, by the product's operations; other evaluations do not do these."""
    if rival.evaluation != CubeProduct.title:
        return math.nan
    return case.flops / float(timing.cpu.min()) / most[rival.precision]


def _jsonable(value: float) -> float | None:
    return value if math.isfinite(value) else None
