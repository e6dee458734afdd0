"""Worker processes: one that dies costs its task, and none goes on without the device of its parent."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from gbnbench.core.errors import InputError
from gbnbench.execution import worker_pool
from gbnbench.execution.calls import Calls
from gbnbench.execution.one_thread import ONE_THREAD
from gbnbench.execution.worker_pool import Pool
from gbnbench.opencl import devices_present
from tests.processes import NO_DEVICE


def work(number: int) -> tuple[int, int, str | None]:
    if number == 13:
        os.kill(os.getpid(), signal.SIGKILL)
    if number == 14:
        raise InputError("n must be even; got 13")
    if number == 15:
        raise ZeroDivisionError
    print("noise on standard output", flush=True)
    return number * number, os.getpid(), os.environ.get("OMP_NUM_THREADS")


def test_a_dead_child_costs_only_its_own_task() -> None:
    done = {}
    with Pool(2) as workers:
        pool = Calls(workers)
        for number in (1, 13, 14, 15, 2, 3):
            pool.submit(number, work, number)
        while pool.pending:
            finished = pool.next()
            done[finished.key] = finished
    assert {key: done[key].value[0] for key in (1, 2, 3)} == {1: 1, 2: 4, 3: 9}
    assert "killed by SIGKILL" in done[13].failure
    assert done[14].failure == "n must be even; got 13"
    assert "ZeroDivisionError" in done[15].failure
    assert os.getpid() not in {done[key].value[1] for key in (1, 2, 3)}
    assert {done[key].value[2] for key in (1, 2, 3)} == {ONE_THREAD["OMP_NUM_THREADS"]}


def device_is_present() -> bool:
    return devices_present()


def test_a_child_without_its_parents_device_refuses_instead_of_turning_to_numpy() -> None:
    assert devices_present()
    with Pool(1, {**ONE_THREAD, **NO_DEVICE}) as workers:
        pool = Calls(workers)
        pool.submit(0, device_is_present)
        finished = pool.next()
    assert "finds no OpenCL device where the process that started it found one" in finished.failure
    assert "--jobs" in finished.failure


PARENT = """
import os, sys, time
from gbnbench.execution.worker_pool import Pool
from gbnbench.execution.calls import Calls
pool = Calls(Pool(1))
pool.submit(0, os.getpid)
print(pool.next().value, flush=True)
pool.submit(1, time.sleep, 600)
time.sleep(600)
"""


def test_a_busy_child_ends_when_its_parent_is_killed() -> None:
    parent = subprocess.Popen([sys.executable, "-c", PARENT], stdout=subprocess.PIPE, text=True)
    assert parent.stdout is not None
    child = int(parent.stdout.readline())
    parent.kill()
    parent.wait()
    parent.stdout.close()
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline and alive(child):
        time.sleep(0.02)
    assert not alive(child)


def alive(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state != "Z"


def test_a_pool_without_any_temporary_file_still_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    def full() -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(worker_pool.tempfile, "TemporaryFile", full)
    with Pool(1) as pool:
        assert pool.submit(abs, -1).result() == 1


def test_a_child_that_cannot_be_started_fails_its_task_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(worker_pool.sys, "executable", "/nonexistent/python")
    with Pool(1) as workers:
        pool = Calls(workers)
        pool.submit("one", abs, -1)
        assert pool.next().failure.startswith("no process can be started for it: [Errno 2]")
