"""A pool of single-threaded worker processes that outlives a crashed one and names the fatal task."""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import IO, Any

from gbnbench.core.garbage import OBJECTS
from gbnbench.core.process_end import cause_of_end
from gbnbench.execution.messages import receive, send
from gbnbench.execution.one_thread import ONE_THREAD
from gbnbench.opencl.device import DEVICE_VARIABLE, FOUND_VARIABLE, found_already, selected

BACKLOG = 8  # calls a worker that are given out at a time


class LostWorkerError(Exception):
    """A process ended before it answered; the text says of what."""


class Pool(Executor):
    """Run module-level functions in child processes, each with one thread unless told otherwise.

    Parameters
    ----------
    jobs : int
        Largest number of children; each starts when a task needs it.
    environment : mapping of str
        Variables that a child gets beside those of this process.

    Notes
    -----
    It is an executor of ``concurrent.futures``. The standard ProcessPoolExecutor loses all pending tasks when
    one child dies, without naming the one that did it, and leaves its children running when its own process
    is killed. Here each child is attended by a thread that knows its task, and a child whose standard input
    closes ends at once.
    """

    def __init__(self, jobs: int, environment: Mapping[str, str] = ONE_THREAD) -> None:
        self._environment = {**environment}
        self._todo: queue.SimpleQueue[tuple[Future[Any], bytes] | None] = queue.SimpleQueue()
        self._children: set[subprocess.Popen[bytes]] = set()
        self._closing = False
        self._device = selected()  # the context of use_device is not that of the attending threads
        self._lock = threading.Lock()
        self.count = jobs
        self._threads = [threading.Thread(target=self._attend, daemon=True) for _ in range(jobs)]
        for thread in self._threads:
            thread.start()

    @property
    def backlog(self) -> int:
        """Calls to be given out at a time."""
        return BACKLOG * self.count

    def submit(self, fn: Callable[..., Any], /, *args: Any) -> Future[Any]:  # type: ignore[override]
        """Queue one call of a module-level function.

        Parameters
        ----------
        fn : callable
            Found by its module and name in the child.
        *args
            They can be pickled.

        Returns
        -------
        Future
            Its exception is LostWorkerError.
        """
        future: Future[Any] = Future()
        self._todo.put((future, pickle.dumps((fn, args), protocol=5)))
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = True) -> None:  # noqa: ARG002
        """End every child at once, whatever it is doing.

        Parameters
        ----------
        wait, cancel_futures : bool
            Of the protocol; both are so in any case.
        """
        with self._lock:
            self._closing = True
            for child in self._children:
                child.kill()
        for _ in self._threads:
            self._todo.put(None)
        for thread in self._threads:
            thread.join()

    def trouble(self) -> str:
        """Say nothing: a child that died is started anew."""
        return ""

    def avoid(self, worker: str) -> bool:  # noqa: ARG002 - all children are alike
        """Say that no other child is better."""
        return False

    def _attend(self) -> None:
        child: subprocess.Popen[bytes] | None = None
        with _scratch() as complaints:
            while (task := self._todo.get()) is not None:
                future, call = task
                try:
                    child = child or self._start(complaints)
                except OSError as error:
                    future.set_exception(LostWorkerError(f"no process can be started for it: {error}"))
                    continue
                if child is None:
                    break
                try:
                    send(child.stdin, call)
                    succeeded, value = pickle.loads(receive(child.stdout))  # noqa: S301 - our own child
                    if succeeded:
                        future.set_result(value)
                    else:
                        future.set_exception(LostWorkerError(value))
                except (EOFError, OSError):
                    self._end(child)
                    future.set_exception(LostWorkerError(_post_mortem(child.returncode, complaints)))
                    child = None
            if child is not None:
                self._end(child)

    def _start(self, complaints: IO[bytes]) -> subprocess.Popen[bytes] | None:
        """Start a child that imports from where this process imports, unless the pool is closing."""
        complaints.seek(0)
        with contextlib.suppress(OSError):  # the null device has no length
            complaints.truncate()
        program = f"import gc, sys; gc.set_threshold({OBJECTS}); sys.path[:] = {sys.path!r}; "
        program += f"from {__name__} import serve; serve()"
        found = {FOUND_VARIABLE: "1"} if found_already() else {}
        with self._lock:
            if self._closing:
                return None
            child = subprocess.Popen(
                [sys.executable, "-c", program],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=complaints,
                env={**os.environ, **self._environment, **found, DEVICE_VARIABLE: self._device},
            )
            self._children.add(child)
        return child

    def _end(self, child: subprocess.Popen[bytes]) -> None:
        for pipe in (child.stdin, child.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):  # unsent bytes of a task whose child is gone
                    pipe.close()
        child.wait()
        with self._lock:
            self._children.discard(child)


def _post_mortem(code: int, complaints: IO[bytes]) -> str:
    complaints.seek(0)
    return cause_of_end(code, complaints.read())


def _scratch() -> IO[bytes]:
    """Open a file for what a child complains; where no temporary file can be made, complaints are lost."""
    try:
        return tempfile.TemporaryFile()
    except OSError:
        return Path(os.devnull).open("w+b")


def serve() -> None:
    """Answer tasks from standard input on standard output until the input closes: the child's whole life."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the terminal sends Ctrl-C to all; the parent decides
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # a library that prints must not break the protocol
    calls: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(calls,), daemon=True).start()
    while True:
        send(replies, pickle.dumps(_answer(calls.get()), protocol=5))


def _listen(calls: queue.SimpleQueue[bytes]) -> None:
    while True:
        try:
            calls.put(receive(sys.stdin.buffer))
        except EOFError:
            os._exit(0)  # the parent is done, or dead: nobody wants the answer


def _answer(call: bytes) -> tuple[bool, Any]:
    try:
        function, arguments = pickle.loads(call)  # noqa: S301 - our own parent
        return True, function(*arguments)
    except Exception:
        return False, "unexpected error\n" + traceback.format_exc()
