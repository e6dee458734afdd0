"""A worker that others start computes with one thread, whether numpy is loaded before it is told or after."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys

import pytest

from gbnbench.execution.executors.inside_job import carried_out_in_time
from gbnbench.execution.one_thread import ONE_THREAD, one_thread
from gbnbench.execution.remote_call import answered, packed

# What a rank of MPI does, and a job by submitit, which loads numpy first: unpickle a call and carry it out.
WORKER = """
import pickle, sys
{first}
function, arguments = pickle.loads(sys.stdin.buffer.read())
print(function(*arguments))
import numpy, scipy.linalg, threadpoolctl
print(sorted({{pool["num_threads"] for pool in threadpoolctl.threadpool_info()}}))
"""


@pytest.mark.parametrize("first", ["import numpy", "assert 'numpy' not in sys.modules"])
def test_a_worker_has_one_thread(first: str) -> None:
    call = (answered, "another version", b"", packed(len, "abc"))
    assert "install the same version there" in said_by_worker(first, carried_out_in_time, [call])
    said_by_worker(first, one_thread)


def said_by_worker(first: str, function: object, *arguments: object) -> str:
    """What a process says that carries out a call, where the environment asks for four threads."""
    environment = {**os.environ, **dict.fromkeys(ONE_THREAD, ""), "OMP_NUM_THREADS": "4"}
    done = subprocess.run(
        [sys.executable, "-c", WORKER.format(first=first)], input=pickle.dumps((function, arguments)),
        env=environment, capture_output=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr.decode()
    said, threads = done.stdout.decode().splitlines()
    assert threads == "[1]"
    return said
