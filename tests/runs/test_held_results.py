"""Results that tasks need: in memory as far as they fit, else read from their store, the same either way."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import UnfinishedError
from gbnbench.execution.progress import Progress
from gbnbench.runs import held_results
from gbnbench.runs.held_results import HeldResults, bytes_of
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.task import Task
from gbnbench.runs.task_folder import TaskFolder


def squares(count):
    return {"square": np.arange(count) ** 2}


def added(required):
    return {"sum": np.array([each["square"].sum() for each in required])}


def gathered(value, collected):
    return {**value, "last": np.array([each["square"][-1] for each in collected])}


def tasks():
    made = [Task(f"squares/{k}", f"squares {k}", squares, (k,)) for k in range(2, 9)]
    keys = tuple(task.key for task in made)
    return [*made, Task("all", "all", added, (), keys[:4], gathered, collects=keys, here=True)]


@pytest.mark.parametrize("most", [0, 100, 1 << 28])
@pytest.mark.parametrize("jobs", [None, 2])
def test_what_does_not_fit_is_read_back_to_the_same_result(tmp_path, monkeypatch, most, jobs):
    monkeypatch.setattr(held_results, "MOST_BYTES", most)
    folder = TaskFolder(tmp_path, {})
    run = TaskRun(tasks(), folder)
    assert not any(done.failure for done in run.complete(jobs, Progress(), prove_device=False))
    assert run.results.keys() == {"all"}
    assert run.results["all"]["sum"].tolist() == [sum(j * j for j in range(k)) for k in range(2, 6)]
    assert run.results["all"]["last"].tolist() == [(k - 1) ** 2 for k in range(2, 9)]


def test_what_the_store_does_not_keep_stays_in_memory(tmp_path, monkeypatch):
    monkeypatch.setattr(held_results, "MOST_BYTES", 0)

    class Forgetful(TaskFolder):
        def write(self, key, result):
            if key == "all":
                super().write(key, result)

    run = TaskRun(tasks(), Forgetful(tmp_path, {}))
    assert not any(done.failure for done in run.complete(None, Progress()))
    assert len(run.results["all"]["last"]) == 7


def test_a_piece_that_vanished_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr(held_results, "MOST_BYTES", 0)
    folder = TaskFolder(tmp_path, {})
    held = HeldResults(folder)
    folder.write("a", squares(5))
    held["a"] = squares(5)
    assert held["a"]["square"].tolist() == [0, 1, 4, 9, 16]
    (tmp_path / "pieces/a.npz").unlink()
    with pytest.raises(UnfinishedError, match=r"the piece a of .* is no longer there"):
        _ = held["a"]


def test_a_run_that_holds_nothing_has_all_in_its_store(tmp_path):
    folder = TaskFolder(tmp_path, {})
    run = TaskRun(tasks(), folder, hold=False)
    assert not any(done.failure for done in run.complete(None, Progress()))
    assert run.results == {"all": None}
    assert folder.read("all")["last"][-1] == 49


def test_bytes_are_those_of_arrays_wherever_they_are():
    class Held:
        def __init__(self):
            self.x, self.name = np.zeros((3, 2)), "x"

    assert bytes_of(np.zeros(3)) == 24
    assert bytes_of({"a": np.zeros(3), "b": {"c": np.zeros(1)}}) == 32
    assert bytes_of(Held()) == 48
    assert bytes_of("text") == 0
