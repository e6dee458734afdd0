"""The benchmark of Gaussian Blue Noise as a whole: forces by cut-off, floor against time, into one folder."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from gbnbench.benchmarks.gbn.cutoffs import FORCES, forces
from gbnbench.benchmarks.gbn.floor_cases import FloorBenchmark
from gbnbench.benchmarks.gbn.floor_time import FLOOR_TIME, race
from gbnbench.benchmarks.gbn.speedups import speedup
from gbnbench.benchmarks.timing.machine import Row, Rows, describe
from gbnbench.benchmarks.timing.threads import one_blas_thread
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError
from gbnbench.execution.progress import Progress


@dataclass(frozen=True)
class FloorTables:
    """Everything measured.

    Attributes
    ----------
    machine : dict
        Processor, device, versions.
    floors, forces, speedups : DataFrame
        The three tables; see ``floor_time.FLOOR_TIME``, ``cutoffs.FORCES`` and ``speedups.SPEEDUP``.
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
    return FloorTables(machine, floors, by_cutoff, _speedups(out, floors))


def written(
    out: Path, machine: Mapping[str, Any], floors: Sequence[Row], by_cutoff: Sequence[Row]
) -> FloorTables:
    """Write the tables of rows that were measured elsewhere, as ``run`` does.

    Parameters
    ----------
    out : Path
        The folder.
    machine : mapping
        Where they were measured.
    floors, by_cutoff : sequence of dict
        Rows of ``FLOOR_TIME`` and ``FORCES``.

    Returns
    -------
    FloorTables
    """
    write_whole(out / "machine.json", (json.dumps(machine, indent=2) + "\n").encode())
    for name, columns, rows in (("forces", FORCES, by_cutoff), ("floor_time", FLOOR_TIME, floors)):
        with Rows(out / f"{name}.csv", columns) as file:
            for row in rows:
                file.add(row)
    table = pd.DataFrame(floors, columns=FLOOR_TIME)
    return FloorTables(machine, table, pd.DataFrame(by_cutoff, columns=FORCES), _speedups(out, table))


def _speedups(out: Path, floors: pd.DataFrame) -> pd.DataFrame:
    speedups = speedup(floors)
    write_whole(out / "speedup.csv", speedups.to_csv(index=False, float_format="%.6g").encode())
    return speedups
