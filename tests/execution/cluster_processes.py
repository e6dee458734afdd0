"""A Dask scheduler and workers on the loopback, and comparisons spread over them, as processes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from distributed import Client

from gbnbench.execution.one_thread import ONE_THREAD
from tests.processes import COMMAND

ASKED = ["compare", "gbn[gradients=400]", "-n", "256", "--realizations", "20", "--quiet"]


class Cluster:
    """Processes that end with the block that made it.

    Attributes
    ----------
    address : str
        Of the scheduler.
    processes : list of Popen
        All that were started.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._workers = 0
        self.processes: list[subprocess.Popen[bytes]] = []
        told = folder / "scheduler.json"
        self.scheduler = self._start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", told
        )
        until(lambda: told.exists() and told.read_text().strip().endswith("}"))
        self.address = json.loads(told.read_text())["address"]

    def worker(self, *options: object, **environment: str) -> subprocess.Popen[bytes]:
        """Start a worker with these variables in its environment; wait until the scheduler knows it."""
        made = self._start_worker(*options, **environment)
        self._until_known()
        return made

    def several(self, count: int) -> list[subprocess.Popen[bytes]]:
        """Start so many workers at once; wait until the scheduler knows all."""
        made = [self._start_worker() for _ in range(count)]
        self._until_known()
        return made

    def lose(self, *workers: subprocess.Popen[bytes]) -> None:
        """Kill workers as the system does for want of memory."""
        for worker in workers:
            worker.kill()
            worker.wait()
        self._workers -= len(workers)

    def _start_worker(self, *options: object, **environment: str) -> subprocess.Popen[bytes]:
        self._workers += 1
        return self._start(
            "worker", self.address, "--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1",
            "--local-directory", self.folder, *options, **environment,
        )  # fmt: skip

    def _until_known(self) -> None:
        with Client(self.address, set_as_default=False) as client:  # type: ignore[no-untyped-call]
            client.wait_for_workers(self._workers, timeout=120)

    def _start(self, *arguments: object, **environment: str) -> subprocess.Popen[bytes]:
        process = subprocess.Popen(
            [sys.executable, "-m", "dask", *map(str, arguments)],
            env={**os.environ, **ONE_THREAD, **environment},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.processes.append(process)
        return process


@contextmanager
def cluster(folder: Path) -> Iterator[Cluster]:
    """Start a scheduler, and end it and its workers after the block."""
    folder.mkdir(exist_ok=True)
    made = Cluster(folder)
    try:
        yield made
    finally:
        for process in made.processes:
            process.kill()
            process.wait()


def spread(address: str, out: Path, *options: object, asked: Sequence[str] = ASKED) -> subprocess.Popen[str]:
    """Begin a command by the workers of a scheduler, a comparison unless another is asked for.

    It waits for a scheduler and for workers that are not there, but a few seconds.
    """
    config = out.parent / "dask.toml"
    config.write_text("[dask]\nwait_seconds = 4\nconnect_seconds = 10\n")
    return subprocess.Popen(
        [*COMMAND, *asked, "--out", str(out), "--executor", f"dask:{address}",
         "--executor-config", str(config), *map(str, options)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def ended(process: subprocess.Popen[str]) -> tuple[int, str]:
    """Wait for a comparison: its exit code, and all that it said."""
    out, complaints = process.communicate(timeout=500)
    return process.returncode, out + complaints


def finished_pieces(out: Path) -> int:
    """Count the pieces that a comparison has kept so far."""
    return len(list((out / "parts").rglob("*.npz"))) if out.exists() else 0


def sums(out: Path) -> dict[str, str]:
    """Checksums of the files of a run but that which holds CPU seconds."""
    held: dict[str, str] = json.loads((out / "manifest.json").read_text())["sha256"]
    return {name: digest for name, digest in held.items() if not name.endswith("source.json")}


def until(true: Callable[[], Any], seconds: float = 400) -> Any:
    """Wait until something is true, and return it."""
    deadline = time.monotonic() + seconds
    while not (found := true()):
        if time.monotonic() > deadline:
            raise TimeoutError(f"not true after {seconds} s")
        time.sleep(0.02)
    return found
