"""Calls that workers carry out: one that fails by its worker is tried again elsewhere, then reported."""

from __future__ import annotations

import queue
from collections.abc import Callable, Hashable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

import gbnbench
from gbnbench.core.errors import UnfinishedError
from gbnbench.core.readable_text import in_one_line
from gbnbench.execution.protocol import Workers
from gbnbench.execution.remote_call import Answer, answered, packed

POLL_SECONDS = 2.0  # between looks at whether the workers are in trouble


@dataclass(frozen=True)
class Finished:
    """What became of one call.

    Attributes
    ----------
    key : hashable
        As given to ``submit``.
    value : object
        What the function returned, None after a failure.
    failure : str
        Empty when it succeeded, else one line, or a traceback where the cause is a bug.
    """

    key: Hashable
    value: Any = None
    failure: str = ""


@dataclass
class _Pending:
    call: bytes
    tried: int = 0


class Calls:
    """Calls of functions by keys, carried out by workers and handed back as they finish.

    Parameters
    ----------
    workers : Workers
        Who carries them out.
    tries : int
        How often a call is tried whose worker is lost or lacks something.
    check : tuple of callable and arguments, optional
        A function of a module that tells, in a worker, why that cannot serve; an empty text if it can.
    """

    def __init__(self, workers: Workers, tries: int = 2, check: tuple[Callable[..., str], Any] | None = None):
        self._workers, self._tries = workers, tries
        self._check = packed(*check) if check else b""
        self._pending: dict[Hashable, _Pending] = {}
        self._settled: queue.SimpleQueue[tuple[Hashable, Future[Any]]] = queue.SimpleQueue()
        self.left_out: list[str] = []

    @property
    def pending(self) -> int:
        """Calls submitted and not yet handed back."""
        return len(self._pending)

    @property
    def enough(self) -> bool:
        """Whether so many calls are given out that no worker waits for more."""
        return len(self._pending) >= self._workers.backlog

    def submit(self, key: Hashable, function: Callable[..., Any], *arguments: object) -> None:
        """Queue one call of a module-level function.

        Parameters
        ----------
        key : hashable
            Handed back with what became of the call.
        function : callable
            Found by its module and name in the worker.
        *arguments
            They can be pickled.
        """
        self._pending[key] = _Pending(packed(function, *arguments))
        self._send(key)

    def next(self) -> Finished:
        """Wait for any call to finish; ask once for each call submitted.

        Returns
        -------
        Finished

        Raises
        ------
        UnfinishedError
            If no call can finish any more, as when a scheduler is gone.
        """
        while True:
            try:
                key, future = self._settled.get(timeout=POLL_SECONDS)
            except queue.Empty:
                self._raise_trouble()
                continue
            answer = self._answer(future)
            if not answer.failure:
                del self._pending[key]
                return Finished(key, answer.value)
            pending = self._pending[key]
            if answer.unfit:
                self._leave_out(answer)
            pending.tried += 1
            if answer.again and pending.tried < self._tries:
                self._send(key)
                continue
            del self._pending[key]
            return Finished(key, failure=answer.failure)

    def _send(self, key: Hashable) -> None:
        try:
            future = self._workers.submit(
                answered, gbnbench.__version__, self._check, self._pending[key].call
            )
        except Exception as error:
            self._raise_trouble()
            raise UnfinishedError(f"work cannot be given out: {in_one_line(str(error))}") from error
        future.add_done_callback(lambda done: self._settled.put((key, done)))

    def _answer(self, future: Future[Any]) -> Answer:
        """Give the answer of a call; a worker that was lost is a failure to be tried again."""
        if future.cancelled():
            self._raise_trouble()
            return Answer(failure="its worker was lost", again=True)
        error = future.exception()
        if error is None:
            answer: Answer = future.result()
            return answer
        self._raise_trouble()
        return Answer(failure=str(error) or type(error).__name__, again=True)

    def _raise_trouble(self) -> None:
        if why := self._workers.trouble():
            raise UnfinishedError(why)

    def _leave_out(self, answer: Answer) -> None:
        if answer.failure not in self.left_out:
            self.left_out.append(answer.failure)
        if not self._workers.avoid(answer.worker):
            raise UnfinishedError(f"no worker can serve: {answer.failure}")
