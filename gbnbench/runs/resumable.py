"""Tasks that depend on each other: every result is kept as it comes, and only what is missing is done."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from gbnbench.core.errors import GbnbenchError
from gbnbench.execution.calls import Finished
from gbnbench.execution.executor_choice import chosen_executor
from gbnbench.execution.progress import Progress
from gbnbench.runs.device_proof import prove_device_if_any, proven_calls
from gbnbench.runs.held_results import HeldResults
from gbnbench.runs.result_store import ResultStore
from gbnbench.runs.task import Task


class TaskRun:
    """Tasks together with the results that are there and those that are missing.

    Parameters
    ----------
    tasks : sequence of Task
        All of them; they are started in this order, so the longest first leave the least idle at the end.
    store : ResultStore, optional
        Where results are found and kept; without one nothing outlives the run.
    hold : bool
        Keep the results in memory too; else they are in the store only, and None stands for each.

    Attributes
    ----------
    results : dict of str
        Results by key of the tasks that no other task requires, in the order of the tasks, whichever was
        finished first. The results of the others are let go as soon as nothing needs them any more.
    failures : dict of str
        What went wrong, by key.
    reused : int
        Tasks that had nothing to do, because their own result is stored or that of all who require them.
    missing : list of Task
        The tasks that remained to be done when the run was made, each after those that it requires.

    Notes
    -----
    A stored result is read once. What a task requires is read only if the task's own result is missing.
    """

    def __init__(self, tasks: Sequence[Task], store: ResultStore | None = None, hold: bool = True) -> None:
        self._store, self._hold = store, hold
        self._tasks = {task.key: task for task in tasks}
        self._required = {key for task in tasks for key in task.needs}
        self._results: dict[str, Any] = {}
        self._inputs = HeldResults(store)
        self.failures: dict[str, str] = {}
        self.missing: list[Task] = []
        seen: set[str] = set()
        for task in tasks:
            if task.key not in self._required:
                self._find(task, seen)
        self.reused = len(tasks) - len(self.missing)
        lacking = {task.key for task in self.missing}
        self._awaits = {task.key: {key for key in task.needs if key in lacking} for task in self.missing}
        self._users: dict[str, list[str]] = {key: [] for key in seen}
        for task in self.missing:
            for key in task.needs:
                self._users[key].append(task.key)

    @property
    def results(self) -> dict[str, Any]:
        """Results by key, as said above."""
        return {key: self._results[key] for key in self._tasks if key in self._results}

    def complete(
        self,
        jobs: int | None,
        progress: Progress,
        *,
        doing: str = "",
        prove_device: bool = True,
        meanwhile: Callable[[], None] | None = None,
    ) -> Iterator[Finished]:
        """Do the missing tasks; yield each as it is finished, failed ones too.

        Parameters
        ----------
        jobs : int or None
            Most worker processes of the executor ``local``, each with one thread; None does the work in this
            process.
        progress : Progress
            Counts a step a task.
        doing : str
            What the progress says at first; by default the label of the first task.
        prove_device : bool
            Let a worker check the OpenCL device, if there is one, before the tasks begin.
        meanwhile : callable, optional
            Called in this process while a worker does so.

        Yields
        ------
        Finished
            The key with the result, or with what went wrong. Tasks that require a failed one are left out.

        Raises
        ------
        DeviceError
            If there is an OpenCL device and it cannot be used.
        OSError
            If a result cannot be kept.
        """
        doing = doing or (self.missing[0].label if self.missing else "")
        if jobs is None:
            progress.start(len(self._tasks), self.reused, doing)
            for task in self.missing:
                if not self._awaits[task.key]:
                    yield self._done_here(task, progress)
            return
        with proven_calls(jobs, len(self.missing), prove_device) as pool:
            if chosen_executor().remote:
                progress.start(len(self._tasks), self.reused, doing)
                if meanwhile is not None:
                    meanwhile()
            elif prove_device:
                prove_device_if_any(pool, progress, len(self._tasks), self.reused, meanwhile)
            progress.start(len(self._tasks), self.reused, doing)  # the time of the check is not counted
            ready = deque(task for task in self.missing if not self._awaits[task.key])
            while ready or pool.pending:
                if not ready or (pool.enough and not ready[0].here):
                    settled = self._settle(pool.next(), progress)
                    while pool.left_out:
                        progress.say(f"left out: {pool.left_out.pop()}")
                elif (task := ready.popleft()).here:
                    settled = self._done_here(task, progress)
                else:
                    pool.submit(task.key, task.function, *self._arguments(task))
                    continue
                # What is released is next, so that what it needs is soon let go.
                ready.extendleft(reversed(self._released(str(settled.key))))
                yield settled

    def _done_here(self, task: Task, progress: Progress) -> Finished:
        return self._settle(_call(task, self._arguments(task)), progress)

    def _released(self, key: str) -> list[Task]:
        """List the tasks that waited for this one and for no other."""
        return [self._tasks[user] for user in self._users[key] if not self._awaits[user]]

    def _find(self, task: Task, seen: set[str]) -> None:
        """Look for a task's result, and where it is missing for what the task requires."""
        if task.key in seen:
            return
        seen.add(task.key)
        result = self._store.read(task.key) if self._store else None
        if result is not None:
            self._keep(task.key, result)
            return
        for key in task.needs:
            self._find(self._tasks[key], seen)
        self.missing.append(task)

    def _keep(self, key: str, result: Any) -> None:
        """Keep a result for the tasks that need it, or for the caller."""
        if key in self._required:
            self._inputs[key] = result
        else:
            self._results[key] = result if self._hold else None

    def _arguments(self, task: Task) -> tuple[Any, ...]:
        """Give the arguments of a call; a worker is sent what it requires, here that is read as it goes."""
        if not task.requires:
            return task.arguments
        required = self._inputs.several(task.requires)
        return (*task.arguments, required if task.here else list(required))

    def _settle(self, done: Finished, progress: Progress) -> Finished:
        """Keep a result, tell the progress, and let go of what nobody needs any more."""
        task = self._tasks[str(done.key)]
        if done.failure:
            self.failures[task.key] = done.failure
            progress.advance(f"failed: {task.label}")
            return done
        inputs = self._inputs.several(task.collects or task.requires)
        result = task.assemble(done.value, inputs) if task.assemble else done.value
        if self._store:
            self._store.write(task.key, result)
        self._keep(task.key, result)
        for key in self._users[task.key]:
            self._awaits[key].discard(task.key)
        for key in task.needs:
            self._users[key].remove(task.key)
            if not self._users[key]:
                del self._inputs[key]
        progress.advance(task.done or task.label)
        return Finished(task.key, result)


def _call(task: Task, arguments: tuple[Any, ...]) -> Finished:
    """Call a task's function in this process."""
    try:
        return Finished(task.key, task.function(*arguments))
    except GbnbenchError as error:
        return Finished(task.key, failure=str(error))
