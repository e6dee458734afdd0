"""Jobs of a Slurm cluster, by submitit: each carries out a number of calls."""

from __future__ import annotations

import contextlib
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from gbnbench.core.errors import InputError, UnfinishedError
from gbnbench.core.readable_text import in_one_line
from gbnbench.execution.executors.extra import require
from gbnbench.execution.one_thread import carried_out

CLUSTERS = ("slurm", "local", "debug")


@dataclass(frozen=True)
class SlurmJobs:
    """Jobs that submitit sends to Slurm.

    Attributes
    ----------
    address : str
        ``local`` or ``debug`` for submitit's stand-ins on this machine; empty for Slurm.
    tries : int
        How often a piece is tried whose job failed.
    folder : str
        Where submitit keeps calls, results and logs; all nodes reach it.
    jobs : int
        Most jobs at a time.
    calls_a_job : int
        Most pieces that one job makes, one after another.
    poll_seconds : float
        Between looks at the jobs.
    partition, account, constraint : str
        Of the jobs, as Slurm has them; empty for the cluster's own.
    timeout_min : int
        Minutes after which Slurm ends a job.
    mem_gb : int
        Memory of a job.
    gpus : int
        GPUs of a job.
    """

    name: ClassVar[str] = "slurm"
    summary: ClassVar[str] = "jobs of a Slurm cluster by submitit; slurm:local tries it on this machine"
    remote: ClassVar[bool] = True

    address: str = ""
    tries: int = 3
    folder: str = "gbnbench-slurm"
    jobs: int = 32
    calls_a_job: int = 32
    poll_seconds: float = 2.0
    partition: str = ""
    account: str = ""
    constraint: str = ""
    timeout_min: int = 60
    mem_gb: int = 4
    gpus: int = 0

    def start(self, jobs: int) -> JobWorkers:  # noqa: ARG002 - the settings say how many
        """Make ready to send jobs."""
        require("submitit", "slurm", self.name)
        require("threadpoolctl", "slurm", self.name)
        cluster = self.address or "slurm"
        if cluster not in CLUSTERS:
            raise InputError(f"slurm takes no address but local or debug; got slurm:{self.address}")
        return JobWorkers(self, cluster)

    def parameters(self) -> dict[str, Any]:
        """Give the settings of the jobs in submitit's words."""
        given = {
            f"slurm_{name}": value
            for name in ("partition", "account", "constraint")
            if (value := getattr(self, name))
        }
        gpus = {"gpus_per_node": self.gpus} if self.gpus else {}
        return {"timeout_min": self.timeout_min, "mem_gb": self.mem_gb, "cpus_per_task": 1, **gpus, **given}


class JobWorkers:
    """Calls gathered into jobs by a thread, which also looks for finished ones.

    Parameters
    ----------
    settings : SlurmJobs
        Of the jobs.
    cluster : str
        One of ``CLUSTERS``.
    """

    def __init__(self, settings: SlurmJobs, cluster: str) -> None:
        import submitit

        self._settings = settings
        try:
            self._executor = submitit.AutoExecutor(Path(settings.folder), cluster=cluster)
            self._executor.update_parameters(**settings.parameters())
        except (RuntimeError, OSError) as error:
            raise UnfinishedError(
                f"no Slurm here ({in_one_line(str(error))}); run it where sbatch is"
            ) from None
        self._waiting: deque[tuple[Future[Any], tuple[Any, ...]]] = deque()
        self._running: dict[Any, list[Future[Any]]] = {}
        self._trouble = ""
        self._ended = threading.Event()
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
        for job in self._running:
            with contextlib.suppress(Exception):
                job.cancel()

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
        while not self._ended.wait(self._settings.poll_seconds / 4):
            try:
                self._send()
            except Exception as error:  # sbatch refused: nothing can be sent
                self._trouble = f"a job cannot be sent: {in_one_line(str(error))}"
                return
            for job in [job for job in self._running if job.done()]:
                self._hand_back(self._running.pop(job), job)
            time.sleep(self._settings.poll_seconds / 2 if self._running else 0)

    def _send(self) -> None:
        """Share what waits among the jobs that are free."""
        free = self._settings.jobs - len(self._running)
        while self._waiting and free > 0:
            size = min(self._settings.calls_a_job, -(-len(self._waiting) // free))
            taken = [self._waiting.popleft() for _ in range(size)]
            job = self._executor.submit(carried_out, [call for _, call in taken])
            self._running[job] = [future for future, _ in taken]
            free -= 1

    @staticmethod
    def _hand_back(futures: Sequence[Future[Any]], job: Any) -> None:
        try:
            values = job.result()
        except Exception as error:
            for future in futures:
                last = str(error).strip().splitlines()[-1:] or [type(error).__name__]
                future.set_exception(RuntimeError(f"its job {job.job_id} failed: {last[0]}"))
            return
        for future, value in zip(futures, values, strict=True):
            future.set_result(value)
