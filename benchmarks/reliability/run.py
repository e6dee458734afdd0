"""Try everything, or some parts, into a table that keeps what was tried before, and make the page of it.

    python -m gbnbench.benchmarks.reliability [PART...] [--quick] [--table FILE.csv] [-o PAGE.md]

The parts are files, kills, disk, together, memory, runtimes and plants. Runtimes beside the usual one are
found by GBNBENCH_TRIAL_VENDORS (runtimes.py); full disks take root on Linux.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from gbnbench.benchmarks.reliability.page import page
from gbnbench.benchmarks.reliability.registry import PARTS, Part
from gbnbench.benchmarks.reliability.table import PieceResult, TrialTable
from gbnbench.benchmarks.reliability.trial import FAULT
from gbnbench.benchmarks.timing.machine import describe
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.execution.progress import choose
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.task import Task

JOBS = 2
TABLE, QUICK_TABLE = "benchmarks/results/reliability/trials.csv", "build/reliability/trials.csv"
PAGE = "docs/reliability.md"


def timed(function: Callable[..., list[Any]], *arguments: Any) -> PieceResult:
    """Carry out a piece and take its time.

    Parameters
    ----------
    function : callable
        Gives trials.
    *arguments
        Its arguments.

    Returns
    -------
    PieceResult
    """
    began = time.monotonic()
    return PieceResult(tuple(function(*arguments)), time.monotonic() - began)


def fill(path: Path, parts: Sequence[Part], quick: bool) -> TrialTable:
    """Carry out the pieces that the table does not have; keep each as soon as it is known.

    Parameters
    ----------
    path : Path
        Of the table.
    parts : sequence of Part
        What to try.
    quick : bool
        A little of everything.

    Returns
    -------
    TrialTable

    Raises
    ------
    GbnbenchError
        If a piece could not be carried out at all.
    """
    table = TrialTable(path)
    pieces = [piece for part in parts for piece in part.pieces(quick)]
    tasks = [Task(piece.key, piece.key, timed, (piece.function, *piece.arguments)) for piece in pieces]
    with choose(False) as progress:
        for done in TaskRun(tasks, table).complete(JOBS, progress, prove_device=False):
            if done.failure:
                raise GbnbenchError(f"{done.key} could not be carried out: {done.failure}")
            for trials in done.value.trials:
                if trials.verdict == FAULT:
                    progress.say(f"{done.key}: {trials.tried}: {trials.outcome}: {trials.note}")
    return table


def named(names: Sequence[str]) -> list[Part]:
    """Parts of these names, or all.

    Raises
    ------
    InputError
        If there is none of a name.
    """
    known = {part.name: part for part in PARTS}
    for name in names:
        if name not in known:
            raise InputError(f"no part is called {name!r}; there are {', '.join(known)}")
    return [part for part in PARTS if not names or part.name in names]


def main(arguments: Sequence[str] | None = None) -> None:
    """Fill the table, and write the page made from it."""
    parser = argparse.ArgumentParser(
        prog="python -m gbnbench.benchmarks.reliability", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("parts", nargs="*", metavar="PART", help="by name; all where none is given")
    parser.add_argument("--quick", action="store_true", help="a little of everything, in minutes")
    parser.add_argument("--table", type=Path, help=f"default {TABLE}; {QUICK_TABLE} of --quick")
    parser.add_argument("-o", "--out", type=Path, help=f"page to write; default {PAGE}, none of --quick")
    given = parser.parse_args(arguments)
    path = given.table or Path(QUICK_TABLE if given.quick else TABLE)
    table = fill(path, named(given.parts), given.quick).table
    write_whole(path.with_name("machine.json"), (json.dumps(describe(), indent=1) + "\n").encode())
    out = given.out or (None if given.quick else Path(PAGE))
    if out is not None:
        write_whole(out, page(table).encode())
    faults = sum(t.count for result in table.values() for t in result.trials if t.verdict == FAULT)
    tried = sum(t.count for result in table.values() for t in result.trials)
    print(f"{tried:,} trials, {faults:,} faults: {path}" + (f", {out}" if out else ""))
    raise SystemExit(1 if faults else 0)
