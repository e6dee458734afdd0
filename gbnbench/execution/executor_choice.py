"""The executor in force: what ``--executor`` chose for all work within a block."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any

from gbnbench.execution.calls import Calls
from gbnbench.execution.executors.local_processes import LocalProcesses
from gbnbench.execution.executors.registry import find
from gbnbench.execution.protocol import Executor, Workers

PATIENCE = 3.0  # seconds without an answer of any worker, before that is said


class ChosenExecutor:
    """An executor whose workers are started when they are first needed, and then kept.

    Parameters
    ----------
    executor : Executor
        Which.
    tell : callable, optional
        Given one line where workers are waited for.

    Attributes
    ----------
    facts : dict
        What was found out of its workers, such as their device.
    """

    def __init__(self, executor: Executor, tell: Callable[[str], None] | None = None) -> None:
        self.executor, self._tell = executor, tell
        self.facts: dict[str, Any] = {}
        self._workers: Workers | None = None

    @property
    def remote(self) -> bool:
        """Whether its workers may be on other machines."""
        return self.executor.remote

    def workers(self, jobs: int) -> Workers:
        """Give the workers, started at the first call.

        Parameters
        ----------
        jobs : int
            How many, where their number is chosen here.

        Returns
        -------
        Workers
        """
        if self._workers is None:
            self._workers = self.executor.start(jobs)
        return self._workers

    @contextmanager
    def calls(self, jobs: int, check: Any = None) -> Iterator[Calls]:
        """Take calls within a block; local processes end with it.

        Parameters
        ----------
        jobs : int
            Most workers, where their number is chosen here.
        check : tuple, optional
            As ``Calls`` takes it.

        Yields
        ------
        Calls
        """
        try:
            yield Calls(self.workers(jobs), self.executor.tries, check)
        finally:
            if not self.remote:
                self.close()

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Say within a block that takes long that workers are waited for: a queue may hold them for hours.

        Yields
        ------
        None
        """
        who = ":".join(filter(None, (self.executor.name, self.executor.address)))
        timer = threading.Timer(PATIENCE, self._tell or str, [f"waiting for the first worker of {who}"])
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()

    def close(self) -> None:
        """End the workers that were started."""
        if self._workers is not None:
            self._workers.shutdown()
            self._workers = None


_chosen: ContextVar[ChosenExecutor | None] = ContextVar("executor", default=None)


@contextmanager
def use_executor(
    text: str | None, config: str | Path | None = None, tell: Callable[[str], None] | None = None
) -> Iterator[None]:
    """Let all work within a ``with`` block be done by an executor.

    Parameters
    ----------
    text : str or None
        As ``find`` takes it. None, without a file, changes nothing.
    config : path, optional
        A TOML file of settings.
    tell : callable, optional
        Given one line where its workers are waited for; by default nothing is said.

    Yields
    ------
    None

    Raises
    ------
    InputError, FormatError
        As ``find``.
    """
    if text is None and config is None:
        yield
        return
    chosen = ChosenExecutor(find(text, config), tell)
    token = _chosen.set(chosen)
    try:
        yield
    finally:
        _chosen.reset(token)
        chosen.close()


def chosen_executor() -> ChosenExecutor:
    """Return the executor in force: that of ``use_executor``, else processes on this machine."""
    return _chosen.get() or ChosenExecutor(LocalProcesses())
