"""Jobs by submitit that carry out calls: sent, looked for in Slurm's queue, and taken out of it."""

from __future__ import annotations

import contextlib
import signal
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, TypeAlias

from gbnbench.core.errors import InputError, UnfinishedError
from gbnbench.core.readable_text import in_one_line
from gbnbench.execution.executors.inside_job import carried_out_in_time
from gbnbench.execution.executors.slurm_queue import HELD, DriverFolder, cancel, waiting_jobs

if TYPE_CHECKING:
    from gbnbench.execution.executors.slurm_jobs import SlurmJobs

Call: TypeAlias = tuple[Future[Any], tuple[Any, ...]]

LOOKS = 5  # at the files of jobs for one at the queue, which costs Slurm more
GRACE_SECONDS = 15.0  # from a job's end until a network file system shows what it left

# What srun reads from the environment, and sbatch does not set for a new job: where the driver is in a job
# itself, it would be that one's.
INHERITED = (
    "SLURM_MEM_PER_CPU SLURM_MEM_PER_GPU ${!SLURM_CPU_BIND*} ${!SLURM_MEM_BIND*} ${!SLURM_TRES_*} "
    "SLURM_NTASKS_PER_CORE SLURM_NTASKS_PER_GPU SLURM_NTASKS_PER_SOCKET SLURM_DISTRIBUTION SLURM_GPU_BIND"
)


class JobWorkers:
    """Calls gathered into jobs by a thread, which also looks for finished ones.

    Parameters
    ----------
    settings : SlurmJobs
        Of the jobs.
    cluster : str
        ``slurm``, or a stand-in of submitit: ``local``, ``debug``.
    """

    def __init__(self, settings: SlurmJobs, cluster: str) -> None:
        import submitit

        self._settings, self._real = settings, cluster == "slurm"
        try:
            self._folder = DriverFolder(settings.folder)
        except OSError as error:
            raise InputError(f"the folder {settings.folder} of slurm cannot be made: {error}") from None
        try:
            self._executor = submitit.AutoExecutor(self._folder.path, cluster=cluster)
            self._executor.update_parameters(
                **settings.parameters(), name=self._folder.name, slurm_setup=[f"unset {INHERITED}"]
            )
        except (RuntimeError, OSError) as error:
            self._folder.close(keep=False)
            raise UnfinishedError(
                f"no Slurm here ({in_one_line(str(error))}); run it where sbatch is"
            ) from None
        if self._real:
            self._folder.end_dead_drivers()
        self._waiting: deque[Call] = deque()
        self._running: dict[Any, list[Call]] = {}
        self._missed: dict[Any, float] = {}  # since when a job is neither in the queue nor finished
        self._since: dict[str, float] = {}  # when what ails began
        self._trouble, self._accepted, self._failed = "", False, False
        self._ended = threading.Event()
        self._handlers = _told_to_end()
        self._thread = threading.Thread(target=self._attend, daemon=True)
        self._thread.start()

    @property
    def count(self) -> int:
        """Most jobs at a time."""
        return self._settings.jobs

    @property
    def backlog(self) -> int:
        """Calls to be given out at a time: those of all jobs, and as many that wait for a free one."""
        return 2 * self._settings.jobs * self._settings.calls_a_job

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Queue a call for the next job.

        Parameters
        ----------
        fn : callable
            A function of a module.
        *args
            They can be pickled.

        Returns
        -------
        Future
        """
        future: Future[Any] = Future()
        self._waiting.append((future, (fn, *args)))
        return future

    def shutdown(self) -> None:
        """Cancel the jobs that are not finished."""
        self._ended.set()
        self._thread.join()
        dead = True
        if self._real:
            dead = not self._accepted or cancel(self._folder.name)
        else:
            for job in self._running:
                with contextlib.suppress(Exception):
                    job.cancel()
        self._folder.close(keep=self._failed, dead=dead)
        with contextlib.suppress(ValueError):  # only the main thread sets handlers
            for number, handler in self._handlers.items():
                signal.signal(number, handler)

    def trouble(self) -> str:
        """Say why jobs cannot be sent."""
        return self._trouble

    def avoid(self, worker: str) -> bool:  # noqa: ARG002 - Slurm chooses
        """Say that there may be others: the next job may be given another node.

        Parameters
        ----------
        worker : str
            As its answers name it.

        Returns
        -------
        bool
            False if no other is left.
        """
        return True

    def _attend(self) -> None:
        seconds, looks = self._settings.poll_seconds, 0
        try:
            while not self._ended.wait(seconds * (0.75 if self._running else 0.25)):
                self._send()
                self._collect()
                looks += 1
                if self._real and looks % LOOKS == 0:
                    self._look_at_queue()
        except Exception as error:
            self._trouble = in_one_line("; ".join(str(error).splitlines()) or type(error).__name__)

    def _send(self) -> None:
        """Share what waits among the jobs that are free."""
        free = self._settings.jobs - len(self._running)
        while self._waiting and free > 0:
            size = min(self._settings.calls_a_job, -(-len(self._waiting) // free))
            taken = [self._waiting.popleft() for _ in range(size)]
            try:
                job = self._executor.submit(carried_out_in_time, [call for _, call in taken])
            except Exception as error:
                self._waiting.extendleft(reversed(taken))
                self._refused(error)
                return
            self._since.pop("refused", None)
            self._accepted = True
            self._running[job] = taken
            free -= 1

    def _refused(self, error: Exception) -> None:
        """Try again later while jobs are there, which may be as many as one may have, or were."""
        why = f"a job cannot be sent: {error}"
        if not self._accepted:
            raise UnfinishedError(why)
        if not self._running:
            self._bear("refused", why)
        self._ended.wait(LOOKS * self._settings.poll_seconds)

    def _collect(self) -> None:
        if self._real:  # submitit would ask sacct, which many clusters do not have
            there = self._folder.finished()
            finished = [job for job in self._running if job.paths.result_pickle.name in there]
        else:
            finished = [job for job in self._running if job.done()]
        for job in finished:
            try:
                values = job.result()
            except Exception as error:
                self._give_up(job, str(error) or type(error).__name__)
                continue
            calls = self._running.pop(job)
            self._missed.pop(job, None)
            self._folder.forget(job.job_id)
            self._waiting.extendleft(reversed(calls[len(values) :]))  # its time ran out
            for (future, _), value in zip(calls, values, strict=False):
                future.set_result(value)

    def _look_at_queue(self) -> None:
        """Miss jobs that ended without a result, and see whether any can start."""
        queue = waiting_jobs(self._folder.name)
        if queue is None:
            self._bear("silent", "Slurm does not answer: squeue failed")
            return
        self._since.pop("silent", None)
        now = time.monotonic()
        for job in list(self._running):
            if job.job_id in queue:
                self._missed.pop(job, None)
            elif now - self._missed.setdefault(job, now) > GRACE_SECONDS:
                self._give_up(job, job.stderr() or "it left the queue without a result")
        states = [queue.get(job.job_id, ("", "")) for job in self._running]
        if states and all(state == "PENDING" and reason in HELD for state, reason in states):
            reasons = ", ".join(sorted({reason for _, reason in states}))
            self._bear("held", f"none of the jobs is started: the reason that Slurm gives is {reasons}")
        else:
            self._since.pop("held", None)

    def _bear(self, ailment: str, why: str) -> None:
        """Wait while something ails, but not for ever."""
        began = self._since.setdefault(ailment, time.monotonic())
        if time.monotonic() - began > self._settings.wait_seconds:
            raise UnfinishedError(f"{why}; so it has been for {self._settings.wait_seconds:g} s")

    def _give_up(self, job: Any, why: str) -> None:
        self._failed = True
        self._missed.pop(job, None)
        last = why.strip().splitlines()[-1]
        error = RuntimeError(f"its job {job.job_id} failed: {last} (its log: {job.paths.stderr})")
        for future, _ in self._running.pop(job):
            future.set_exception(error)


def _told_to_end() -> dict[int, Any]:
    """Let what ends a process, as a closed terminal does, be as Ctrl-C, so that the jobs are cancelled."""
    changed: dict[int, Any] = {}
    if threading.current_thread() is threading.main_thread():
        for name in ("SIGTERM", "SIGHUP"):
            number = getattr(signal, name, None)
            if number is not None and signal.getsignal(number) is signal.SIG_DFL:
                changed[number] = signal.signal(number, signal.default_int_handler)
    return changed
