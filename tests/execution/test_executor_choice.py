"""The executor in force: while it has no worker yet, that is said."""

from __future__ import annotations

import time

import pytest

from gbnbench.execution import executor_choice
from gbnbench.execution.executor_choice import ChosenExecutor
from gbnbench.execution.executors.dask_scheduler import DaskScheduler
from gbnbench.execution.executors.mpi_ranks import MpiRanks


@pytest.mark.parametrize(
    ("executor", "name"), [(DaskScheduler("tcp://head:8786"), "dask:tcp://head:8786"), (MpiRanks(), "mpi")]
)
def test_waiting_is_said_once_it_takes_long(executor, name, monkeypatch):
    monkeypatch.setattr(executor_choice, "PATIENCE", 0.05)
    said = []
    with ChosenExecutor(executor, said.append).waiting():
        deadline = time.monotonic() + 20
        while not said and time.monotonic() < deadline:
            time.sleep(0.01)
    assert said == [f"waiting for the first worker of {name}"]


def test_nothing_is_said_of_workers_that_answer_at_once(monkeypatch):
    monkeypatch.setattr(executor_choice, "PATIENCE", 0.2)
    said = []
    with ChosenExecutor(MpiRanks(), said.append).waiting():
        pass
    time.sleep(0.4)
    assert said == []
