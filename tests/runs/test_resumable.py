"""Pieces of work: done in real workers, kept, done again only where missing, failures named."""

from __future__ import annotations

import json
import math
import os
from collections import Counter
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from gbnbench.core.errors import InputError, UnfinishedError
from gbnbench.execution.progress import Progress
from gbnbench.runs.every_task import run_tasks
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.resumable_folder import ResumableFolder
from gbnbench.runs.task import Task
from gbnbench.runs.task_folder import TaskFolder


class Heard(Progress):
    def __init__(self):
        self.lines, self.counts, self.steps = [], [], 0

    def say(self, text):
        self.lines.append(text)

    def start(self, total, done, doing):
        self.counts.append((total, done))

    def advance(self, doing, steps=1):
        self.steps += steps


def roots(count, mark=""):
    """Work: square roots, leaving a line in a file for every time that it is done."""
    if mark:
        with Path(mark).open("a") as file:
            file.write(f"{count} {os.getpid()}\n")
    return {"root": np.sqrt(np.arange(count))}


def fails(reason):
    raise InputError(reason)


def opened(tmp_path, **identity):
    folder = TaskFolder(tmp_path / "kept", {"what": "roots", **identity})
    folder.path.mkdir(exist_ok=True)
    folder.begin()
    return folder


@pytest.mark.slow
def test_only_what_is_missing_is_done_again(tmp_path):
    mark = str(tmp_path / "mark")
    tasks = [Task(f"a/{k}", f"roots {k}", roots, (k, mark)) for k in (3, 4, 5)]
    folder = opened(tmp_path)
    assert run_tasks(tasks, folder, 2, Progress()).reused == 0
    for k in (3, 4, 5):
        assert folder.read(f"a/{k}")["root"].tolist() == [math.sqrt(j) for j in range(k)]
    (folder.path / "pieces/a/4.npz").write_bytes(b"spoilt")
    heard = Heard()
    assert run_tasks(tasks, folder, 2, heard).reused == 2
    assert heard.counts[-1] == (3, 2)
    assert any("2 of 3" in line for line in heard.lines)
    done = [int(line.split()[0]) for line in Path(mark).read_text().splitlines()]
    assert sorted(done) == [3, 4, 4, 5]
    assert str(os.getpid()) not in Path(mark).read_text()  # in workers


def test_a_failure_is_named_and_the_rest_kept(tmp_path):
    tasks = [Task("good", "the good", roots, (4,)), Task("bad", "the bad", fails, ("too odd",))]
    folder = opened(tmp_path)
    with pytest.raises(UnfinishedError, match=r"1 of 2 pieces failed.*the bad: too odd"):
        run_tasks(tasks, folder, 1, Progress())
    assert folder.read("good") is not None
    assert folder.read("bad") is None


def test_other_settings_and_strange_folders_are_refused_and_left_alone(tmp_path):
    opened(tmp_path, seed=1)
    with pytest.raises(InputError, match=r"seed is 1 there, 2 here"):
        TaskFolder(tmp_path / "kept", {"what": "roots", "seed": 2})
    strange = tmp_path / "strange"
    strange.mkdir()
    (strange / "thesis.txt").write_text("mine")
    with pytest.raises(InputError, match="not empty"):
        ResumableFolder(strange, {})
    assert [p.name for p in strange.iterdir()] == ["thesis.txt"]


def test_finished_means_that_the_manifest_is_there(tmp_path):
    folder = opened(tmp_path)
    assert not folder.whole
    folder.finish({"made": "now"})
    assert folder.whole
    assert json.loads((folder.path / "manifest.json").read_text()) == {"made": "now", "format": 1}
    folder.begin()
    assert not folder.whole


class Counted(TaskFolder):
    """A folder that counts how often each result is read."""

    reads: ClassVar[Counter[str]] = Counter()

    def read(self, key):
        found = super().read(key)
        if found is not None:
            self.reads[key] += 1
        return found


def total(results):
    return {"total": np.array(sum(result["root"].sum() for result in results))}


def doubled(value, required):
    return {"twice": 2 * value["total"], "of": np.array(len(required))}


def sums(*counts):
    """Roots, and their sum that requires them."""
    roots_of = [Task(f"roots/{k}", f"roots {k}", roots, (k,)) for k in counts]
    return [*roots_of, Task("sum", "their sum", total, (), tuple(t.key for t in roots_of), doubled)]


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [None, 2])
def test_what_a_task_requires_comes_first_and_is_read_once(tmp_path, jobs):
    Counted.reads.clear()
    folder = Counted(tmp_path, {"what": "sums"})
    folder.begin()
    run = TaskRun(sums(3, 4, 5), folder)
    done = [finished.key for finished in run.complete(jobs, Progress())]
    assert sorted(done) == ["roots/3", "roots/4", "roots/5", "sum"]
    assert done[-1] == "sum"
    expected = 2 * sum(np.sqrt(np.arange(k)).sum() for k in (3, 4, 5))
    assert run.results.keys() == {"sum"}  # the others are let go
    assert (run.results["sum"]["twice"], run.results["sum"]["of"]) == (pytest.approx(expected), 3)
    assert not Counted.reads

    again = TaskRun(sums(3, 4, 5), folder)
    assert (again.reused, again.missing, Counted.reads) == (4, [], {"sum": 1})
    (folder.path / "pieces/sum.npz").unlink()
    (folder.path / "pieces/roots/4.npz").unlink()
    Counted.reads.clear()
    part = TaskRun(sums(3, 4, 5), folder)
    assert [task.key for task in part.missing] == ["roots/4", "sum"]
    assert [finished.key for finished in part.complete(jobs, Progress())] == ["roots/4", "sum"]
    assert part.results["sum"]["twice"] == pytest.approx(expected)
    assert Counted.reads == {"roots/3": 1, "roots/5": 1}


@pytest.mark.slow
@pytest.mark.parametrize("jobs", [None, 2])
def test_what_requires_a_failed_task_is_left_out(tmp_path, jobs):
    tasks = [
        Task("good", "the good", roots, (4,)),
        Task("bad", "the bad", fails, ("too odd",)),
        Task("sum", "their sum", total, (), ("good", "bad")),
        Task("other", "another", total, (), ("good",)),
    ]
    run = TaskRun(tasks)
    done = {finished.key: finished.failure for finished in run.complete(jobs, Progress())}
    assert done == {"good": "", "bad": "too odd", "other": ""}
    assert run.failures == {"bad": "too odd"}
    assert run.results["other"]["total"] == pytest.approx(np.sqrt(np.arange(4)).sum())


def test_a_requirement_alone_is_not_made_again(tmp_path):
    folder = opened(tmp_path)
    run_tasks(sums(3, 4), folder, 1, Progress())
    for path in (folder.path / "pieces/roots").iterdir():
        path.unlink()
    assert run_tasks(sums(3, 4), folder, 1, Progress()).reused == 3


def test_results_stand_in_the_order_of_the_tasks_whichever_was_there_first(tmp_path):
    folder = Counted(tmp_path, {"what": "roots"})
    folder.begin()
    tasks = [Task(f"roots/{k}", f"roots {k}", roots, (k,)) for k in (3, 4, 5)]
    list(TaskRun(tasks[1:2], folder).complete(None, Progress()))
    run = TaskRun(tasks, folder)
    assert [finished.key for finished in run.complete(None, Progress())] == ["roots/3", "roots/5"]
    assert list(run.results) == ["roots/3", "roots/4", "roots/5"]


@pytest.mark.slow
def test_something_is_done_while_a_worker_proves_the_device(tmp_path):
    order = []

    class Order(Heard):
        def start(self, total, done, doing):
            order.append(doing)

    tasks = [Task("a/3", "roots 3", roots, (3,))]
    run_tasks(tasks, opened(tmp_path), 1, Order(), "rooting", lambda: order.append("meanwhile"))
    assert order[0].startswith("checking the device")
    assert order[1:] == ["meanwhile", "rooting"]
