"""The tasks of a comparison of stipplings: each draws a set, or takes one that is there, and measures it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.runs.task import Task
from gbnbench.studies.stippling_comparison.flat_patch import FlatPatch
from gbnbench.studies.stippling_comparison.measured_set import measured_set
from gbnbench.studies.stippling_comparison.stippling_folder import set_key
from gbnbench.studies.stippling_comparison.stippling_sources import StipplingSource
from gbnbench.studies.timed_draw import timed_draw


def stippling_tasks(
    sources: Sequence[StipplingSource], density: Density, patch: FlatPatch | None, seed: int, jobs: int
) -> list[Task]:
    """List a task a set: the first of every source first, so that one which fails does so soon.

    Parameters
    ----------
    sources : sequence of StipplingSource
        In any order.
    density : Density
        Theirs.
    patch : FlatPatch or None
        The flattest square.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``.
    jobs : int
        Worker processes. A source of no more sets than these is timed by drawing its sets twice.

    Returns
    -------
    list of Task
    """
    numbered = [(k, source) for source in sources for k in range(source.realizations)]
    tasks = []
    for k, source in sorted(numbered, key=lambda pair: pair[0]):
        function: Callable[..., dict[str, NDArray[Any]]] = given_and_measured
        arguments: tuple[Any, ...] = ()
        if source.generator is not None:
            function = drawn_and_measured
            arguments = (source.generator, source.n, seed, k, source.realizations <= jobs)
        elif source.sets is not None:
            arguments = (source.sets[k], k)
        label = f"{source.label}, n={source.n}, set {k}"
        tasks.append(Task(set_key(source.key, k), label, function, (*arguments, density, patch)))
    return tasks


def drawn_and_measured(
    generator: AdaptiveGenerator,
    n: int,
    seed: int,
    k: int,
    redraw: bool,
    density: Density,
    patch: FlatPatch | None,
) -> dict[str, NDArray[Any]]:
    """Draw a set and measure it: the work of a task.

    Parameters
    ----------
    generator : AdaptiveGenerator
        What draws it.
    n : int
        Points.
    seed, k : int
        Realization k of this seed. The first comes with pictures.
    redraw : bool
        As in ``timed_draw``.
    density : Density
        What it is for.
    patch : FlatPatch or None
        The flattest square.

    Returns
    -------
    dict of arrays
        As ``given_and_measured`` makes them, with ``cpu_seconds`` and ``first``, as ``timed_draw`` tells
        them.
    """
    drawn = timed_draw(
        (generator, n, density.shape),
        lambda: adaptive_points(generator, density, n, seed=seed, realization=k),
        redraw,
    )
    cost = {"cpu_seconds": np.asarray(drawn.cpu_seconds), "first": np.asarray(drawn.first)}
    return {**given_and_measured(drawn.x, k, density, patch), **cost}


def given_and_measured(
    x: FloatArray, k: int, density: Density, patch: FlatPatch | None
) -> dict[str, NDArray[Any]]:
    """Measure a set that is there: the work of a task.

    Parameters
    ----------
    x : (n, 2) float64
        In pixels, rows first.
    k : int
        Its number. The first comes with pictures.
    density, patch
        As ``drawn_and_measured`` takes them.

    Returns
    -------
    dict of arrays
        As ``measured_set`` makes them, with ``points``.
    """
    return {"points": x, **measured_set(x, density, patch, pictures=k == 0)}
