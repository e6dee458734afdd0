"""The work of a comparison as tasks: draw each realization, then measure all sets of a source together."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from gbnbench.analysis.measures import AnalysisArrays, analyse_to_arrays
from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Generator, checked_draw, realization_rng
from gbnbench.generators.third_parties.faults import faults_in_words
from gbnbench.io.points.point_sets import NO_TORUS
from gbnbench.runs.comparison_folder import Realization, realization_key
from gbnbench.runs.comparison_result import SourceResult
from gbnbench.runs.task import Task
from gbnbench.studies.timed_draw import mean_cost, timed_draw

if TYPE_CHECKING:  # a worker loads the generators that it draws from, not all of them
    from gbnbench.runs.sources import Source


def comparison_tasks(sources: Sequence[Source], seed: int, jobs: int) -> list[Task]:
    """List the tasks of a comparison.

    Parameters
    ----------
    sources : sequence of Source
        In the order in which they are worked on.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``.
    jobs : int
        Worker processes. A source of no more sets than these is timed by drawing its sets twice.

    Returns
    -------
    list of Task
        For each source one a realization, unless its sets are given, and one that measures it.
    """
    tasks = []
    for source in sources:
        row = f"{source.label} (n={source.n}, d={source.d})"
        done = f"{source.label}, n={source.n}, d={source.d}"
        redraw = source.realizations <= jobs
        draws = [
            Task(
                realization_key(source.key, k),
                f"{row}, realization {k}",
                draw_realization,
                (source.generator, source.n, source.d, seed, k, redraw),
                done=f"made {done}",
            )
            for k in range(source.realizations if source.generator is not None else 0)
        ]
        measure = Task(
            source.key,
            f"{row}, measuring it",
            analyse_to_arrays if source.generator is None else analyse_realizations,
            (source.sets, None, source.sides) if source.generator is None else (),
            tuple(draw.key for draw in draws),
            partial(source_result, source),
            f"measured {done}",
        )
        tasks += [*draws, measure]
    return tasks


def draw_realization(
    generator: Generator, n: int, d: int, seed: int, k: int, redraw: bool = False
) -> Realization:
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
    Realization
        The points with the CPU seconds of one draw, and whether that was the worker's first of its kind.
    """

    def draw() -> FloatArray:
        with faults_in_words(type(generator), f"drawing n={n}, d={d}"):
            x = generator(n, d, realization_rng(seed, k))
        return checked_draw(generator, x, n, d)

    return timed_draw((generator, n, d), draw, redraw)


def analyse_realizations(realizations: Sequence[Realization]) -> AnalysisArrays:
    """Measure the realizations of one source in a worker."""
    return analyse_to_arrays(_points(realizations))


def source_result(
    source: Source, arrays: AnalysisArrays, realizations: Sequence[Realization]
) -> SourceResult:
    """Put together a source's sets and what was measured of them.

    Parameters
    ----------
    source : Source
        With the sets, unless they were drawn.
    arrays : AnalysisArrays
        What was measured.
    realizations : sequence of Realization
        The sets drawn; empty where the source brings its own.

    Returns
    -------
    SourceResult
    """
    told = (f"the file {NO_TORUS}",) if source.toroidal is False else ()
    analysis = arrays.analysis()
    return SourceResult(
        **{**vars(analysis), "warnings": (*told, *analysis.warnings)},
        key=source.key,
        label=source.label,
        n=source.n,
        d=source.d,
        realizations=source.realizations,
        points=_points(realizations) if source.sets is None else source.sets,
        cpu_seconds=mean_cost([one.cpu_seconds for one in realizations], [one.first for one in realizations]),
    )


def _points(realizations: Sequence[Realization]) -> FloatArray:
    return np.stack([realization.x for realization in realizations])
