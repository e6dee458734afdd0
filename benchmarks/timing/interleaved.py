"""Times of several methods taken in turn in one process, so that a busy machine slows all of them alike."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from gbnbench.core.torus import FloatArray

LEAST, MOST = 3, 40  # rounds
SHORTEST = 0.005  # seconds that one timing lasts at least: calls are repeated
GREEDY = 0.08  # share of the time above which a method gets the least rounds only
Call = Callable[[], object]


@dataclass(frozen=True)
class Timing:
    """Seconds a call of one method.

    Attributes
    ----------
    cpu, wall : (rounds,) float64
        CPU time over all threads of the process, and time on the clock.
    """

    cpu: FloatArray
    wall: FloatArray

    def over(self, other: Timing) -> FloatArray:
        """Ratio of CPU times to another method's, round by round, over the rounds that both have."""
        rounds = min(len(self.cpu), len(other.cpu))
        return self.cpu[:rounds] / other.cpu[:rounds]


def timed(call: Call, times: int = 1) -> tuple[float, float]:
    """Time a call.

    Parameters
    ----------
    call : callable
        Without arguments.
    times : int
        Number of calls that the time is divided by.

    Returns
    -------
    cpu, wall : float
        Seconds of one call.
    """
    cpu, wall = time.process_time(), time.perf_counter()
    for _ in range(times):
        call()
    return (time.process_time() - cpu) / times, (time.perf_counter() - wall) / times


def interleave(calls: Mapping[str, Call], seconds: float) -> dict[str, Timing]:
    """Time every method once a round, in an order that turns around, after calls that warm up.

    All but the slowest are called once more before each timing, since the method before may have emptied the
    caches: the first call after numpy's arrays of a hundred megabytes took up to a hundred times as long as
    the next one.

    Parameters
    ----------
    calls : mapping of str to callable
        Methods by name.
    seconds : float
        To be spent in all, beyond three rounds.

    Returns
    -------
    dict of str to Timing
    """
    began = time.perf_counter()
    times, greedy = {}, set()
    for name, call in calls.items():
        _, first = timed(call)  # may build kernels
        _, wall = timed(call) if first < GREEDY * seconds else (0.0, first)
        times[name] = max(1, math.ceil(SHORTEST / max(wall, 1e-6)))
        if wall > GREEDY * seconds:
            greedy.add(name)
    spent: dict[str, list[tuple[float, float]]] = {name: [] for name in calls}
    for index in range(MOST):
        if index >= LEAST and time.perf_counter() - began > seconds:
            break
        order = list(calls) if index % 2 == 0 else list(calls)[::-1]
        for name in order:
            if name not in greedy:
                calls[name]()
            if index < LEAST or name not in greedy:
                spent[name].append(timed(calls[name], times[name]))
    return {name: Timing(*np.array(pairs).T) for name, pairs in spent.items()}
