"""What a job of Slurm does when its time runs out, and when it is cancelled."""

from __future__ import annotations

import signal

import pytest

from tests.processes import python

pytestmark = pytest.mark.skipif(not hasattr(signal, "SIGUSR2"), reason="no signal of that kind here")

JOB = """
import os, signal
signal.signal(signal.SIGTERM, lambda *_: None)  # submitit lets a job go on
from gbnbench.execution.executors.inside_job import carried_out_in_time
calls = [(str, 1), (os.kill, os.getpid(), signal.{signal}), (str, 3)]
print(carried_out_in_time(calls[{first}:]))
"""


@pytest.mark.parametrize(("first", "kept"), [(0, "['1', None]"), (1, "[None]")])
def test_a_job_hands_back_what_it_has_when_its_time_runs_out(first: int, kept: str) -> None:
    done = python(JOB.format(signal="SIGUSR2", first=first))
    assert (done.returncode, done.stdout.strip()) == (0, kept), done.stderr


def test_a_job_that_is_cancelled_ends_at_once() -> None:
    done = python(JOB.format(signal="SIGTERM", first=0))
    assert (done.returncode, done.stdout) == (-signal.SIGTERM, ""), done.stderr
