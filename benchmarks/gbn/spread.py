"""The benchmark of Gaussian Blue Noise by several workers: each times whole races, a set of a case each."""

from __future__ import annotations

import hashlib
import json
import shutil
from dataclasses import asdict
from pathlib import Path
from typing import Any

from gbnbench import __version__
from gbnbench.benchmarks.gbn.benchmark import FloorTables, written
from gbnbench.benchmarks.gbn.cutoffs import forces
from gbnbench.benchmarks.gbn.floor_cases import FloorBenchmark, FloorCase
from gbnbench.benchmarks.gbn.floor_time import race_of_set
from gbnbench.benchmarks.timing.machine import describe
from gbnbench.benchmarks.timing.row_folder import FOLDER, Measured, RowFolder
from gbnbench.benchmarks.timing.threads import one_blas_thread
from gbnbench.core.errors import InputError
from gbnbench.execution.progress import Progress
from gbnbench.runs.device_proof import needed_device
from gbnbench.runs.every_task import run_tasks
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.runs.task import Task


def run_by_workers(out: Path, plan: FloorBenchmark, jobs: int, progress: Progress) -> FloorTables:
    """Measure all of a plan by the workers of the executor in force, from where an earlier call was stopped.

    Parameters
    ----------
    out : Path
        Made where missing; the tables in it are replaced when all is measured. Until then what each worker
        measured stands in ``races``.
    plan : FloorBenchmark
        Cases and curves.
    jobs : int
        Worker processes, where their number is chosen here.
    progress : Progress
        Counts a step a race.

    Returns
    -------
    FloorTables
        The rows of ``run`` in the same order. Optimisers that are compared were timed by one worker; the
        machine is that of the first race, and ``machines`` has them all where there are several.

    Raises
    ------
    InputError
        If out cannot be a folder, or holds races of another plan.
    DeviceError
        If no worker has an OpenCL device.
    UnfinishedError
        If races failed; every other is kept.
    """
    if out.exists() and not out.is_dir():
        raise InputError(f"--out must be a folder; {out} is a file")
    identity = {
        "gbnbench": __version__,
        "device": needed_device(jobs),
        "cases": [f"{case.title} to {case.gradients} gradients" for case in plan.cases],
        "plan": {"sha256": hashlib.sha256(json.dumps(asdict(plan)).encode()).hexdigest()},
    }
    races = [(case, k) for case in plan.cases for k in range(case.sets)]
    tasks = [
        Task(_race_key(case, k), f"{case.title}, set {k + 1}", timed_race, (case, k)) for case, k in races
    ]
    tasks.sort(key=lambda task: -task.arguments[0].cost)
    tasks += [
        Task(_forces_key(n, d), f"forces, n={n} {d}D", timed_forces, (n, d, plan.seconds, plan.probes))
        for n, d in plan.forces
    ]
    out.mkdir(parents=True, exist_ok=True)
    store = RowFolder(out / "races", identity)
    with store.lock(), explain_interruption(store.path):
        store.begin()
        found: dict[str, Measured] = run_tasks(tasks, store, jobs, progress, "noise floors").results
        ordered = [found[_race_key(case, k)] for case, k in races]
        by_cutoff = [row for n, d in plan.forces for row in found[_forces_key(n, d)]["rows"]]
        floors = [row for one in ordered for row in one["rows"]]
        tables = written(out, _machine([one["machine"] for one in ordered]), floors, by_cutoff)
        store.drop(FOLDER)
    shutil.rmtree(store.path, ignore_errors=True)
    return tables


def timed_race(case: FloorCase, k: int) -> Measured:
    """Let all curves of a case race on one of its sets, in a worker.

    Parameters
    ----------
    case : FloorCase
        The size and the curves.
    k : int
        Number of the set.

    Returns
    -------
    mapping
        ``rows`` and ``machine``.
    """
    with one_blas_thread():
        return {"rows": list(race_of_set(case, k)), "machine": describe()}


def timed_forces(n: int, d: int, seconds: float, probes: int) -> Measured:
    """Time forces by cut-off in a worker; parameters are those of ``forces``, what is returned as above."""
    with one_blas_thread():
        return {"rows": list(forces(n, d, seconds, probes)), "machine": describe()}


def _machine(found: list[dict[str, Any]]) -> dict[str, Any]:
    several = [one for k, one in enumerate(found) if one not in found[:k]]
    return found[0] if len(several) == 1 else {**found[0], "machines": several}


def _race_key(case: FloorCase, k: int) -> str:
    return f"n{case.n}_d{case.d}/{k:03d}"


def _forces_key(n: int, d: int) -> str:
    return f"n{n}_d{d}/forces"
