"""Workers of a Dask scheduler, or a scheduler and workers started here (Rocklin 2015)."""

from __future__ import annotations

import contextlib
import logging
import time
import warnings
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar

from gbnbench.core.errors import InputError, UnfinishedError
from gbnbench.core.readable_text import in_one_line
from gbnbench.execution.executors.dask_call import at_worker, several_threads
from gbnbench.execution.executors.extra import require
from gbnbench.execution.one_thread import ONE_THREAD
from gbnbench.execution.worker_pool import BACKLOG

LOCAL = "local"
COUNTED_SECONDS = 5.0  # between counts of the workers
ORPHANED_SECONDS = "20s"  # after which workers end whose driver, and scheduler with it, is gone


@dataclass(frozen=True)
class DaskScheduler:
    """The workers of a Dask scheduler.

    Attributes
    ----------
    address : str
        Of the scheduler, such as ``tcp://head:8786``; ``local`` starts one here with ``--jobs`` workers.
    tries : int
        How often a piece is tried that its worker could not make.
    connect_seconds : float
        How long the scheduler is waited for.
    wait_seconds : float
        How long a run waits while there is no worker at all.
    """

    name: ClassVar[str] = "dask"
    summary: ClassVar[str] = "workers of a Dask scheduler: dask:tcp://HOST:PORT, or dask:local for one here"
    remote: ClassVar[bool] = True

    address: str = ""
    tries: int = 3
    connect_seconds: float = 30.0
    wait_seconds: float = 60.0

    def start(self, jobs: int) -> DaskWorkers:
        """Connect to the scheduler, or start one."""
        require("distributed", "dask", self.name)
        if not self.address:
            raise InputError("give the address of the Dask scheduler, dask:tcp://HOST:8786, or dask:local")
        return DaskWorkers(self, jobs)


class DaskWorkers:
    """The workers behind a client of a scheduler.

    Parameters
    ----------
    settings : DaskScheduler
        Where they are.
    jobs : int
        How many to start, for ``local``.
    """

    def __init__(self, settings: DaskScheduler, jobs: int) -> None:
        from distributed import Client

        _silence()
        self._settings = settings
        self._stack = contextlib.ExitStack()
        target: Any = settings.address
        if target == LOCAL:
            target = self._stack.enter_context(_started_here(jobs))
        try:
            self._client = self._stack.enter_context(
                Client(target, set_as_default=False, timeout=settings.connect_seconds)  # type: ignore[no-untyped-call]
            )
        except (OSError, TimeoutError, ValueError) as error:
            self._stack.close()
            raise UnfinishedError(
                f"no Dask scheduler answers at {settings.address} ({in_one_line(str(error))}); "
                "start one with: dask scheduler"
            ) from None
        self._executor = self._client.get_executor(pure=False)
        self._avoided: set[str] = set()
        self._alone_since: float | None = None
        self._backlog, self._counted = 0, float("-inf")
        try:
            if target is not settings.address:
                self._client.wait_for_workers(jobs, timeout=settings.connect_seconds)
            self._refuse_threads()
        except BaseException:
            self.shutdown()
            raise

    @property
    def count(self) -> int:
        """Workers that are there now."""
        return max(1, len(self._present()))

    @property
    def backlog(self) -> int:
        """Calls to be given out at a time; workers that come later are counted within seconds."""
        if time.monotonic() - self._counted >= COUNTED_SECONDS:
            self._backlog, self._counted = BACKLOG * self.count, time.monotonic()
        return self._backlog

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Queue a call with the scheduler.

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
        chosen: dict[str, Any] = {}
        if self._avoided:  # else the scheduler need not be asked, which takes as long as a call
            chosen = {"workers": self._fit(), "allow_other_workers": False}
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Sending large graph")  # points and powers are large
            future: Future[Any] = self._executor.submit(at_worker, fn, *args, **chosen)
        return future

    def shutdown(self) -> None:
        """Cancel what is not finished and close the client, and the scheduler that was started."""
        for close in (partial(self._executor.shutdown, wait=False), self._stack.close):
            with contextlib.suppress(Exception):
                close()

    def trouble(self) -> str:
        """Say whether the scheduler is gone, or there has been no worker for too long."""
        where = self._settings.address
        if self._client.status != "running":
            return f"the Dask scheduler at {where} is gone"
        if self._fit():
            self._alone_since = None
            return ""
        self._alone_since = self._alone_since or time.monotonic()
        waited = time.monotonic() - self._alone_since
        if waited < self._settings.wait_seconds:
            return ""
        return (
            f"there has been no worker at the Dask scheduler {where} for {waited:.0f} s; start some with: "
            f"dask worker {where} --nthreads 1"
        )

    def avoid(self, worker: str) -> bool:
        """Send no more calls to a worker.

        Parameters
        ----------
        worker : str
            As its answers name it.

        Returns
        -------
        bool
            False if no other is left.
        """
        self._avoided.add(worker)
        return bool(self._fit())

    def _present(self) -> dict[str, Any]:
        present: dict[str, Any] = self._client.scheduler_info(n_workers=-1)["workers"]
        return present

    def _fit(self) -> list[str]:
        """Addresses of the workers of one thread that have not been found unfit."""
        present = self._present().items()
        return [at for at, about in present if about["nthreads"] == 1 and at not in self._avoided]

    def _refuse_threads(self) -> None:
        """Refuse workers that would carry out several calls in one process; later ones refuse themselves."""
        for address, about in self._present().items():
            if about["nthreads"] != 1:
                raise InputError(several_threads(address, about["nthreads"]))


def _started_here(jobs: int) -> Any:
    """Start a scheduler in this process, which ends with it, and workers in processes of their own."""
    from distributed import Scheduler, SpecCluster
    from distributed.deploy.subprocess import SubprocessWorker

    here = {"host": "127.0.0.1", "dashboard": False}
    about = {
        "nthreads": 1,
        "env": ONE_THREAD,
        "death_timeout": ORPHANED_SECONDS,
        "memory_limit": 0,
        "silence_logs": logging.CRITICAL,
    }
    worker = {"cls": SubprocessWorker, "options": {"worker_kwargs": {**here, **about}}}
    return SpecCluster(  # type: ignore[no-untyped-call]
        workers=dict.fromkeys(range(jobs), worker),
        scheduler={"cls": Scheduler, "options": {**here, "port": 0}},
        worker=worker,
        name="gbnbench",
        silence_logs=logging.CRITICAL,  # pyright: ignore[reportArgumentType]  # a level, and not a truth
    )


def _silence() -> None:
    """Keep logs of distributed off the terminal: what matters of them is said by ``trouble``.

    A result that went with its worker raises in the loop of tornado when it is given up, and only there.
    """
    for name in [*logging.root.manager.loggerDict, "tornado.application"]:
        if name.partition(".")[0] in ("distributed", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL)
