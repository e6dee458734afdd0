"""Every task of a study done in workers, or an error that says what failed and where the rest is kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from gbnbench.core.errors import UnfinishedError
from gbnbench.execution.progress import Progress
from gbnbench.runs.result_store import ResultStore
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.task import Task


def run_tasks(
    tasks: Sequence[Task],
    store: ResultStore,
    jobs: int,
    progress: Progress,
    doing: str = "",
    meanwhile: Callable[[], None] | None = None,
    hold: bool = True,
) -> TaskRun:
    """Do the tasks whose results a store lacks, in worker processes.

    Parameters
    ----------
    tasks : sequence of Task
        All of them.
    store : ResultStore
        Where results are found and kept.
    jobs : int
        Most worker processes, each with one thread.
    progress : Progress
        Counts a step a task.
    doing : str
        What the progress says at first; by default the label of the first task.
    meanwhile : callable, optional
        Called in this process while a worker checks the OpenCL device.
    hold : bool
        As ``TaskRun`` takes it.

    Returns
    -------
    TaskRun
        With every result.

    Raises
    ------
    UnfinishedError
        If tasks failed, the first named; every other result is kept.
    DeviceError
        If there is an OpenCL device and it cannot be used.
    OSError
        If a result cannot be kept.
    """
    run = TaskRun(tasks, store, hold)
    if not run.missing:
        return run
    if run.reused:
        progress.say(f"resuming {store.path}: {run.reused} of {len(tasks)} pieces are there")
    labels = {task.key: task.label for task in run.missing}
    failures = []
    try:
        for done in run.complete(jobs, progress, doing=doing, meanwhile=meanwhile):
            if done.failure:
                failures.append(f"{labels[str(done.key)]}: {done.failure}")
                progress.say(failures[-1])
    except UnfinishedError as error:
        kept = f"what is finished is kept in {store.path}, and the same command continues from there"
        raise UnfinishedError(f"{error}; {kept}") from error
    if failures:
        raise UnfinishedError(
            f"{len(failures)} of {len(run.missing)} pieces failed (what is finished is kept in {store.path}; "
            f"the same command tries only the rest); the first: {failures[0]}"
        )
    return run
