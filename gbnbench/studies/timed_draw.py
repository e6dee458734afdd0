"""Sets drawn in a worker process, and their cost, free of what the first of its kind pays once."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence

import numpy as np

from gbnbench.core.cpu_time import cpu_seconds
from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Generator, checked_draw, realization_rng
from gbnbench.generators.third_parties.faults import faults_in_words
from gbnbench.runs.comparison_folder import Realization

REDRAW_SECONDS = 5.0

_drawn_before: set[Hashable] = set()  # in a worker process


def timed_draw(kind: Hashable, draw: Callable[[], FloatArray], redraw: bool) -> Realization:
    """Draw a set and tell what it cost.

    Parameters
    ----------
    kind : hashable
        The generator and all else that what is built once depends on.
    draw : callable
        Draws the same set at each call.
    redraw : bool
        Draw it twice where the worker has not drawn this kind before and the first draw took under five
        seconds, so that the cost of the second is free of imports and kernel builds. This is for sources of
        which no worker draws two sets.

    Returns
    -------
    Realization
        The points with the CPU seconds of one draw, and whether that was the worker's first of its kind.
    """
    first = kind not in _drawn_before
    _drawn_before.add(kind)
    began = cpu_seconds()
    x = draw()
    cost = cpu_seconds() - began
    if first and redraw and cost < REDRAW_SECONDS:
        began = cpu_seconds()
        draw()
        return Realization(x, cpu_seconds() - began, False)
    return Realization(x, cost, first)


def draw_realization(
    generator: Generator, n: int, d: int, seed: int, k: int, redraw: bool = False
) -> Realization:
    """Draw realization k of a generator in a worker, timed.

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
    Realization
        The points with the CPU seconds of one draw, and whether that was the worker's first of its kind.
    """

    def draw() -> FloatArray:
        with faults_in_words(type(generator), f"drawing n={n}, d={d}"):
            x = generator(n, d, realization_rng(seed, k))
        return checked_draw(generator, x, n, d)

    return timed_draw((generator, n, d), draw, redraw)


def mean_cost(costs: Sequence[float], firsts: Sequence[bool]) -> float:
    """Mean cost of a set, without each worker's first where there are others: set-up is not the method's.

    Parameters
    ----------
    costs : sequence of float
        CPU seconds of each set.
    firsts : sequence of bool
        Whether each was its worker's first of its kind.

    Returns
    -------
    float
        nan where there are none.
    """
    warm = [cost for cost, first in zip(costs, firsts, strict=True) if not first]
    return float(np.mean(warm or costs)) if costs else float("nan")
