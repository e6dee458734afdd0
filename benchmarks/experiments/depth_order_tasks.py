"""Tasks of depth against order: starts of Gaussian Blue Noise, deep sets made from them, a row for each."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from gbnbench.benchmarks.experiments.depth_order_row import COLUMNS, KEY, chi, key_text, row
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.solver import solve_for_amplitudes
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.spectral_control.target_profiles import Exponential
from gbnbench.runs.task import Task


@dataclass(frozen=True)
class Map:
    """What is drawn at one n and d.

    Attributes
    ----------
    n, d : int
        Points and dimension.
    c : tuple of float
        Steepnesses, in pi**2.
    edges : tuple of float
        In nu.
    starts : tuple of int
        Gradients of the starts.
    gbn : tuple of int
        Gradients of the Gaussian Blue Noise beside them.
    seeds : int
        Sets a point of the map.
    edge : float
        Where the band beyond the edge of Gaussian Blue Noise, which has none, is taken to begin.
    """

    n: int
    d: int
    c: tuple[float, ...]
    edges: tuple[float, ...]
    starts: tuple[int, ...]
    gbn: tuple[int, ...]
    seeds: int
    edge: float


@dataclass(frozen=True)
class Start:
    """A set of Gaussian Blue Noise that deep sets start from.

    Attributes
    ----------
    x : (n, d) float64
        The points.
    seconds : float
        CPU seconds that they cost.
    """

    x: FloatArray
    seconds: float


def tasks_of(plan: Map) -> list[Task]:
    """List the tasks of a map: a start a seed and number of gradients, and a row for each of its sets."""
    tasks = []
    for seed in range(plan.seeds):
        for gradients in sorted({*plan.starts, *plan.gbn}):
            targets = [(c, edge) for c in plan.c for edge in plan.edges] if gradients in plan.starts else []
            start = f"start {plan.n} {plan.d} {gradients} {seed}"
            beside = ("gbn", plan.n, plan.d, math.nan, math.nan, gradients, seed)
            tasks.append(Task(start, start, draw_start, (plan.n, plan.d, gradients, seed)))
            tasks.append(_row_task(gbn_row, (beside, plan.edge), start))
            for c, edge in targets:
                tasks.append(
                    _row_task(deep_row, (("deep", plan.n, plan.d, c, edge, gradients, seed),), start)
                )
    return tasks


def _row_task(function: Callable[..., dict[str, Any]], arguments: tuple[Any, ...], start: str) -> Task:
    key = " ".join(key_text(arguments[0]))
    return Task(key, key, function, arguments, (start,))


def draw_start(n: int, d: int, gradients: int, seed: int) -> Start:
    """Draw a start of so many gradients.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    gradients : int
        Gradients of its optimisation.
    seed : int
        Of its first realization.

    Returns
    -------
    Start
    """
    _build_kernels(n, d)
    before = time.process_time()
    x = GaussianBlueNoise(gradients=gradients)(n, d, realization_rng(seed, 0))
    return Start(x, time.process_time() - before)


@cache
def _build_kernels(n: int, d: int) -> None:
    """Build the kernels before anything is timed."""
    GaussianBlueNoise(gradients=2)(n, d, realization_rng(0, 0))


def gbn_row(key: tuple[Any, ...], edge: float, starts: Sequence[Start]) -> dict[str, Any]:
    """Measure a start itself.

    Parameters
    ----------
    key : tuple
        As ``KEY`` says.
    edge : float
        Where the band beyond the edge is taken to begin, in nu.
    starts : sequence of one Start
        The set.

    Returns
    -------
    dict
        By ``COLUMNS``.
    """
    (start,) = starts
    return row(key, start.x, edge, chi=math.nan, converged=True, steps=0, products=0, cpu_s=start.seconds)


def deep_row(key: tuple[Any, ...], starts: Sequence[Start]) -> dict[str, Any]:
    """Bring one start to one profile and measure it; a set that does not converge has no measures.

    Parameters
    ----------
    key : tuple
        As ``KEY`` says.
    starts : sequence of one Start
        The set to start from.

    Returns
    -------
    dict
        By ``COLUMNS``.
    """
    (start,) = starts
    _, _, d, c, edge, _, _ = key
    before = time.process_time()
    outcome = solve_for_amplitudes(start.x, Exponential(c * math.pi**2, edge), edge)
    told: dict[str, Any] = {
        "chi": chi(d, edge), "converged": outcome.converged, "steps": outcome.steps,
        "products": outcome.products, "cpu_s": start.seconds + time.process_time() - before,
    }  # fmt: skip
    if outcome.converged:
        return row(key, outcome.x, edge, **told)
    return {**dict.fromkeys(COLUMNS, math.nan), **dict(zip(KEY, key, strict=True)), **told}
