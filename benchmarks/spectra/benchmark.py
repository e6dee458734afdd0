"""The spectra benchmark as a whole: hard cases, speed against error, growth of cost, into one folder."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from gbnbench.benchmarks.spectra.cases import SpectrumBenchmark
from gbnbench.benchmarks.spectra.cores import Throughput, throughput
from gbnbench.benchmarks.spectra.hard_cases import hard_cases
from gbnbench.benchmarks.spectra.hard_table import evaluate, judged
from gbnbench.benchmarks.spectra.scaling import SCALING, grow
from gbnbench.benchmarks.spectra.speed_error import SPEED, compare
from gbnbench.benchmarks.spectra.tile import tile_share
from gbnbench.benchmarks.timing.machine import Rows, describe, peaks
from gbnbench.benchmarks.timing.threads import one_blas_thread
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError
from gbnbench.execution.progress import Progress


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


def _hard(out: Path, plan: SpectrumBenchmark) -> pd.DataFrame:
    frame = judged([row for case in hard_cases(plan.quick) for row in evaluate(case)])
    write_whole(out / "hard_cases.csv", frame.to_csv(index=False, float_format="%.6g").encode())
    return frame


def _jsonable(value: float) -> float | None:
    return value if math.isfinite(value) else None
