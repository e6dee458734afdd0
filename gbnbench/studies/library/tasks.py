"""The work of making a library as tasks: draw realizations, then measure those of a file and write them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gbnbench.analysis.measures import measures
from gbnbench.core.cpu_time import cpu_seconds
from gbnbench.core.errors import RefusalError
from gbnbench.core.results.measures import Measures
from gbnbench.generators.protocol import Generator
from gbnbench.runs.comparison_folder import Realization
from gbnbench.runs.task import Task
from gbnbench.runs.task_keys import realization_key
from gbnbench.studies.comparison_tasks import draw_realization
from gbnbench.studies.library.costs import file_cost

if TYPE_CHECKING:  # a worker loads the generators that it draws from, not all of them
    from gbnbench.studies.library.request import RequestedSets

UNKNOWN = 1.0  # CPU seconds that progress takes a step for whose cost nobody knows


@dataclass(frozen=True)
class RefusedDraw:
    """A realization that its generator could not make.

    Attributes
    ----------
    reason : str
        In its words.
    """

    reason: str


Draw = Realization | RefusedDraw


@dataclass(frozen=True)
class MeasuredSets:
    """The measures of the sets of a file.

    Attributes
    ----------
    measures : Measures or None
        None where there are no sets.
    cpu_seconds : float
        What they cost, one thread.
    """

    measures: Measures | None
    cpu_seconds: float


def library_tasks(
    requested: Sequence[RequestedSets],
    seed: int,
    jobs: int,
    keep: Callable[[RequestedSets, MeasuredSets, Sequence[Draw]], Any],
) -> list[Task]:
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
            assemble=_keeping(sets, keep),
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


def draw_or_refusal(generator: Generator, n: int, d: int, seed: int, k: int, redraw: bool) -> Draw:
    """Draw realization k in a worker.

    Parameters
    ----------
    generator : Generator
        What draws it.
    n, d : int
        Points and dimension.
    seed, k : int
        It draws from ``SeedSequence(seed, spawn_key=(k,))``.
    redraw : bool
        As in ``timed_draw``.

    Returns
    -------
    Realization or RefusedDraw
        The second where the generator found no set, which is a result too: it would not find one again.
    """
    try:
        return draw_realization(generator, n, d, seed, k, redraw)
    except RefusalError as refusal:
        return RefusedDraw(str(refusal))


def measured_sets(draws: Sequence[Draw]) -> MeasuredSets:
    """Measure the sets that were made, together, in a worker.

    Parameters
    ----------
    draws : sequence of Realization or RefusedDraw
        All of a file.

    Returns
    -------
    MeasuredSets
    """
    points = [draw.x for draw in draws if isinstance(draw, Realization)]
    if not points:
        return MeasuredSets(None, 0.0)
    began = cpu_seconds()
    found = measures(np.stack(points))
    return MeasuredSets(found, cpu_seconds() - began)


def _keeping(
    sets: RequestedSets, keep: Callable[[RequestedSets, MeasuredSets, Sequence[Draw]], Any]
) -> Callable[[Any, list[Any]], Any]:
    return lambda measured, draws: keep(sets, measured, draws)


def _known(seconds: float) -> float:
    return UNKNOWN if math.isnan(seconds) else seconds
