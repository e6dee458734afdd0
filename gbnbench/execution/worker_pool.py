"""A pool of single-threaded worker processes that outlives a crashed one and names the fatal task."""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Self

from gbnbench.core.errors import GbnbenchError
from gbnbench.core.process_end import cause_of_end
from gbnbench.opencl.device import DEVICE_VARIABLE, FOUND_VARIABLE, found_already, selected

# One thread a worker: the processes share the cores, and CPU seconds then mean one core's seconds.
ONE_THREAD = {
    "POCL_MAX_PTHREAD_COUNT": "1",  # PoCL up to 4
    "POCL_CPU_MAX_CU_COUNT": "1",  # PoCL from 5
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "VECLIB_MAXIMUM_THREADS": "1",
    # glibc gives memory back and takes it again all through a compilation of kernels, at half its time.
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_TRIM_THRESHOLD_": "4000000000",
    "MALLOC_TOP_PAD_": "67108864",
    "MALLOC_MMAP_MAX_": "0",
}
HEADER = struct.Struct("<Q")


@dataclass(frozen=True)
class Finished:
    """What became of one task.

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


class Pool:
    """Run module-level functions in child processes, each with one thread unless told otherwise.

    Parameters
    ----------
    jobs : int
        Largest number of children; each starts when a task needs it.
    environment : mapping of str
        Variables that a child gets beside those of this process.

    Notes
    -----
    The standard ProcessPoolExecutor loses every pending task when one child dies, without naming the one that
    did it, and leaves its children running when its own process is killed. Here each child is attended by a
    thread that knows its task, and a child whose standard input closes ends at once.
    """

    def __init__(self, jobs: int, environment: Mapping[str, str] = ONE_THREAD) -> None:
        self._environment = {**environment}
        self._todo: queue.SimpleQueue[tuple[Hashable, bytes] | None] = queue.SimpleQueue()
        self._done: queue.SimpleQueue[Finished] = queue.SimpleQueue()
        self._children: set[subprocess.Popen[bytes]] = set()
        self._closing = False
        self._device = selected()  # the context of use_device is not that of the attending threads
        self._lock = threading.Lock()
        self._pending = 0
        self._threads = [threading.Thread(target=self._attend, daemon=True) for _ in range(jobs)]
        for thread in self._threads:
            thread.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    @property
    def pending(self) -> int:
        """Tasks submitted and not yet handed back."""
        return self._pending

    def submit(self, key: Hashable, function: Callable[..., object], *arguments: object) -> None:
        """Queue one call of a module-level function.

        Parameters
        ----------
        key : hashable
            Handed back with what became of the call.
        function : callable
            Found by its module and name in the child.
        *arguments
            They can be pickled.
        """
        self._pending += 1
        self._todo.put((key, pickle.dumps((function, arguments), protocol=5)))

    def next(self) -> Finished:
        """Wait for any task to finish; call it once for each task submitted."""
        finished = self._done.get()
        self._pending -= 1
        return finished

    def close(self) -> None:
        """End every child at once, whatever it is doing."""
        with self._lock:
            self._closing = True
            for child in self._children:
                child.kill()
        for _ in self._threads:
            self._todo.put(None)
        for thread in self._threads:
            thread.join()

    def _attend(self) -> None:
        child: subprocess.Popen[bytes] | None = None
        with _scratch() as complaints:
            while (task := self._todo.get()) is not None:
                key, call = task
                try:
                    child = child or self._start(complaints)
                except OSError as error:
                    self._done.put(Finished(key, failure=f"no process can be started for it: {error}"))
                    continue
                if child is None:
                    break
                try:
                    _send(child.stdin, call)
                    succeeded, value = pickle.loads(_receive(child.stdout))  # noqa: S301 - our own child
                    self._done.put(Finished(key, value) if succeeded else Finished(key, failure=value))
                except (EOFError, OSError):
                    self._end(child)
                    self._done.put(Finished(key, failure=_post_mortem(child.returncode, complaints)))
                    child = None
            if child is not None:
                self._end(child)

    def _start(self, complaints: IO[bytes]) -> subprocess.Popen[bytes] | None:
        """Start a child that imports from where this process imports, unless the pool is closing."""
        complaints.seek(0)
        with contextlib.suppress(OSError):  # the null device has no length
            complaints.truncate()
        program = f"import sys; sys.path[:] = {sys.path!r}; from {__name__} import serve; serve()"
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


def _send(pipe: IO[bytes] | None, message: bytes) -> None:
    if pipe is None:
        raise EOFError
    pipe.write(HEADER.pack(len(message)))
    pipe.write(message)
    pipe.flush()


def _receive(pipe: IO[bytes] | None) -> bytes:
    if pipe is None:
        raise EOFError
    head = pipe.read(HEADER.size)
    if len(head) < HEADER.size:
        raise EOFError
    (size,) = HEADER.unpack(head)
    message = pipe.read(size)
    if len(message) < size:
        raise EOFError
    return message


def serve() -> None:
    """Answer tasks from standard input on standard output until the input closes: the child's whole life."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the terminal sends Ctrl-C to all; the parent decides
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # a library that prints must not break the protocol
    calls: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(calls,), daemon=True).start()
    while True:
        _send(replies, pickle.dumps(_answer(calls.get()), protocol=5))


def _listen(calls: queue.SimpleQueue[bytes]) -> None:
    while True:
        try:
            calls.put(_receive(sys.stdin.buffer))
        except EOFError:
            os._exit(0)  # the parent is done, or dead: nobody wants the answer


def _answer(call: bytes) -> tuple[bool, Any]:
    try:
        function, arguments = pickle.loads(call)  # noqa: S301 - our own parent
        return True, function(*arguments)
    except GbnbenchError as error:
        return False, str(error)
    except MemoryError:
        return False, "not enough memory"
    except Exception:
        return False, "unexpected error\n" + traceback.format_exc()
