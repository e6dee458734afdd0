"""Depth against order of deep sets over c and the edge, from starts of several lengths, with GBN beside them.

python -m gbnbench.benchmarks.experiments.depth_order benchmarks/results/deep/depth_order.csv
"""

from __future__ import annotations

import csv
import json
import math
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Self

from gbnbench.benchmarks.experiments.depth_order_row import COLUMNS, KEY, chi, row
from gbnbench.benchmarks.timing.machine import Rows, describe
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import GbnbenchError
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress
from gbnbench.generators.gauss_newton.solver import solve_for_amplitudes
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.spectral_control.target_profiles import Exponential
from gbnbench.runs.resumable import Task, TaskRun


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


MAPS = (
    Map(
        1024, 2, (4, 6, 8, 10, 12, 16), (0.55, 0.6, 0.65, 0.7, 0.72, 0.74, 0.76, 0.78), (25, 50, 100, 200),
        (100, 320, 1000), 3, 0.72,
    ),
    Map(1000, 3, (4, 8, 12), (0.72, 0.76, 0.8, 0.835, 0.86, 0.88), (15, 60, 240), (60, 320, 1000), 2, 0.8),
    # Few points and starts from none on: where sets fail.
    Map(64, 2, (8, 12), (0.72, 0.76, 0.78), (0, 25, 100), (), 8, 0.72),
    Map(256, 2, (8, 12), (0.72, 0.76, 0.78), (0, 25, 100), (), 4, 0.72),
)  # fmt: skip


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
    key = " ".join(text(arguments[0]))
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


def text(key: tuple[Any, ...]) -> tuple[str, ...]:
    """Return a key as the file has it."""
    return tuple(f"{cell:.6g}" if isinstance(cell, float) else str(cell) for cell in key)


class RowStore:
    """The table of a map as a store of results: a line a set. Starts are not kept.

    Parameters
    ----------
    path : Path
        Of the table; it need not exist.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        earlier: list[dict[str, str]] = []
        if path.exists():
            with path.open(newline="", encoding="utf-8") as file:
                earlier = list(csv.DictReader(file))
        self._earlier = {" ".join(line[name] for name in KEY): line for line in earlier}

    def __enter__(self) -> Self:
        """Open the table and write what it held before."""
        self._rows = Rows(self.path, COLUMNS).__enter__()
        for line in self._earlier.values():
            self._rows.add(line)
        return self

    def __exit__(self, *exception: object) -> None:
        """Close the table; the rows are there already."""
        self._rows.__exit__(None, None, None)

    def read(self, key: str) -> Mapping[str, Any] | None:
        """Return the row that an earlier run left."""
        return self._earlier.get(key)

    def write(self, key: str, result: Mapping[str, Any] | Start) -> None:  # noqa: ARG002 - the row holds it
        """Write a row.

        Parameters
        ----------
        key : str
            The row's, which it holds itself.
        result : mapping or Start
            The row; a start is not kept.
        """
        if not isinstance(result, Start):
            self._rows.add(result)


def main(arguments: list[str], maps: tuple[Map, ...] = MAPS) -> None:
    """Fill the table in the file named, from where it was left.

    Parameters
    ----------
    arguments : list of one str
        The file.
    maps : tuple of Map
        What is drawn.

    Raises
    ------
    GbnbenchError
        If a set cannot be made or measured.
    """
    path = Path(arguments[0])
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path.with_name("machine.json"), (json.dumps(describe(), indent=1) + "\n").encode())
    with RowStore(path) as store:
        for done in TaskRun([task for plan in maps for task in tasks_of(plan)], store).complete(
            None, Progress()
        ):
            if done.failure:
                raise GbnbenchError(f"{done.key} failed: {done.failure}")
            if not isinstance(done.value, Start):
                shown = tuple(done.value[name] for name in (*KEY, "converged", "noise_floor"))
                print(*text(shown), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
