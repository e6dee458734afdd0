"""The table of an experiment filled by one process or by workers, from where it was left."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

from gbnbench.core.errors import GbnbenchError
from gbnbench.execution import progress
from gbnbench.execution.executor_choice import use_executor
from gbnbench.execution.progress import Progress
from gbnbench.runs.result_store import ResultStore
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.task import Task


def add_workers(parser: argparse.ArgumentParser) -> None:
    """Add ``--jobs``, ``--executor`` and ``--executor-config``."""
    parser.add_argument("--jobs", type=int, help="worker processes; without one this process does the work")
    parser.add_argument("--executor", help="who does the work, as of gbnbench compare")
    parser.add_argument("--executor-config", type=Path, help="settings of the executor")


def fill(
    tasks: Sequence[Task],
    store: ResultStore,
    given: argparse.Namespace,
) -> None:
    """Do the tasks whose rows a table lacks.

    Parameters
    ----------
    tasks : sequence of Task
        In the order in which they are begun.
    store : ResultStore
        The table.
    given : Namespace
        With the options that ``add_workers`` adds.

    Raises
    ------
    GbnbenchError
        If a task failed; the rows of those before it are kept.
    """
    spread = given.jobs is not None or given.executor is not None or given.executor_config is not None
    store.path.parent.mkdir(parents=True, exist_ok=True)
    run = TaskRun(tasks, store)
    if not run.missing:
        return
    with (
        use_executor(given.executor, given.executor_config),
        progress.choose(False) if spread else nullcontext(Progress()) as teller,
    ):
        for done in run.complete((given.jobs or 1) if spread else None, teller):
            if done.failure:
                raise GbnbenchError(f"{done.key} failed: {done.failure}")
            print(done.key, flush=True)
