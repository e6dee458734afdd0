"""The work of making a library as tasks: draw realizations, then measure those of a file and write them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from gbnbench.runs.task import Task
from gbnbench.runs.task_keys import realization_key
from gbnbench.studies.set_library.costs import file_cost
from gbnbench.studies.set_library.draws import Draw, MeasuredSets, draw_or_refusal, measured_sets
from gbnbench.studies.set_library.request import RequestedSets

UNKNOWN = 1.0  # CPU seconds that progress takes a step for whose cost nobody knows
Keep = Callable[[RequestedSets, MeasuredSets, Sequence[Draw]], Any]


def library_tasks(requested: Sequence[RequestedSets], seed: int, jobs: int, keep: Keep) -> list[Task]:
    """List the tasks of files, the dearest sets first.

    Parameters
    ----------
    requested : sequence of RequestedSets
        A file each.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``.
    jobs : int
        Worker processes. A generator of no more sets than these is timed by drawing its sets twice.
    keep : callable
        Given a file, its measures and its draws, it writes the sets and returns their entry.

    Returns
    -------
    list of Task
        For each file one a realization, and one that measures and writes them.
    """
    tasks = []
    for sets in sorted(requested, key=lambda sets: -_known(file_cost(sets)[0].seconds)):
        row = f"{sets.text}, n={sets.n}, d={sets.d}"
        draws = [
            Task(
                realization_key(sets.key, k),
                f"{row}, realization {k}",
                draw_or_refusal,
                (sets.generator, sets.n, sets.d, seed, k, sets.realizations <= jobs),
            )
            for k in range(sets.realizations)
        ]
        measuring = Task(
            sets.key,
            f"{row}, measured",
            measured_sets,
            requires=tuple(draw.key for draw in draws),
            assemble=partial(keep, sets),
        )
        tasks += [*draws, measuring]
    return tasks


def step_costs(tasks: Sequence[Task], requested: Sequence[RequestedSets]) -> dict[str, float]:
    """Give the estimated cost of each task by its label.

    Parameters
    ----------
    tasks : sequence of Task
        As ``library_tasks`` lists them.
    requested : sequence of RequestedSets
        Their files.

    Returns
    -------
    dict of float
        CPU seconds.
    """
    costs = {sets.key: file_cost(sets) for sets in requested}
    found = {}
    for task in tasks:
        one, measuring = costs[task.key if task.requires else task.key.rpartition("/")[0]]
        found[task.label] = _known(measuring.seconds if task.requires else one.seconds)
    return found


def _known(seconds: float) -> float:
    return UNKNOWN if math.isnan(seconds) else seconds
