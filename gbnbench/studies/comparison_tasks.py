"""The work of a comparison as tasks: draw realizations, measure pieces of them, put the pieces together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from gbnbench.analysis.measures import AnalysisArrays, merged_analysis
from gbnbench.analysis.measuring_plan import MeasuringPlan
from gbnbench.analysis.piece_measures import measure_piece
from gbnbench.core.large_arrays import filled
from gbnbench.core.sides import as_sides
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.point_sets import NO_TORUS
from gbnbench.runs.comparison_folder import Realization
from gbnbench.runs.comparison_result import SourceResult
from gbnbench.runs.task import Task
from gbnbench.runs.task_keys import piece_key, realization_key
from gbnbench.studies.timed_draw import draw_realization, mean_cost

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
        For each source one a realization, unless its sets are given; one a piece of them that is measured;
        and one that puts these together. The last two are one where there is one piece.
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
        tasks += [*draws, *_measuring(source, tuple(draw.key for draw in draws), row, done)]
    return tasks


def _measuring(source: Source, draws: tuple[str, ...], row: str, done: str) -> list[Task]:
    """List the tasks that measure a source whose sets are given or drawn."""
    plan = MeasuringPlan(source.n, source.d, source.realizations, sides=as_sides(source.sides, source.d))
    whole = partial(source_result, source)
    measures = []
    for first, count in plan.pieces:
        sets = () if source.sets is None else (source.sets[first : first + count],)
        measures.append(
            Task(
                piece_key(source.key, first),
                f"{row}, measuring {count} of {source.realizations} sets from number {first} on",
                measure_sets if sets else measure_realizations,
                (plan, first, *sets),
                draws[first : first + count],
                done=f"measured {first + count} sets of {done}",
            )
        )
    if len(measures) == 1:
        (only,) = measures
        function = analyse_sets if source.sets is not None else analyse_realizations
        label = f"{row}, measuring it"
        return [
            replace(
                only, key=source.key, label=label, function=function, assemble=whole, done=f"measured {done}"
            )
        ]
    merger = Task(
        source.key,
        f"{row}, putting its pieces together",
        merged_analysis,
        (plan,),
        requires=tuple(task.key for task in measures),
        collects=draws,
        assemble=whole,
        done=f"measured {done}",
        here=True,
    )
    return [*measures, merger]


def measure_realizations(
    plan: MeasuringPlan, first: int, realizations: Sequence[Realization]
) -> dict[str, NDArray[Any]]:
    """Measure a piece of the sets drawn, in a worker; as ``measure_piece``.

    Parameters
    ----------
    plan : MeasuringPlan
        Of the source.
    first : int
        The number of the first set.
    realizations : sequence of Realization
        The sets drawn.

    Returns
    -------
    dict of arrays
    """
    return measure_piece(_points(realizations), plan, first)


def measure_sets(plan: MeasuringPlan, first: int, sets: FloatArray) -> dict[str, NDArray[Any]]:
    """Measure a piece of the sets given, in a worker; as ``measure_piece``.

    Parameters
    ----------
    plan : MeasuringPlan
        Of the source.
    first : int
        The number of the first set.
    sets : (sets, n, d) float64

    Returns
    -------
    dict of arrays
    """
    return measure_piece(sets, plan, first)


def analyse_realizations(
    plan: MeasuringPlan, first: int, realizations: Sequence[Realization]
) -> AnalysisArrays:
    """Measure all sets drawn for a source, which are one piece, in a worker.

    Parameters
    ----------
    plan : MeasuringPlan
        Of the source.
    first : int
        The number of the first set.
    realizations : sequence of Realization
        The sets drawn.

    Returns
    -------
    AnalysisArrays
    """
    return merged_analysis(plan, [measure_realizations(plan, first, realizations)])


def analyse_sets(plan: MeasuringPlan, first: int, sets: FloatArray) -> AnalysisArrays:
    """Measure all sets given for a source, which are one piece, in a worker.

    Parameters
    ----------
    plan : MeasuringPlan
        Of the source.
    first : int
        The number of the first set.
    sets : (sets, n, d) float64

    Returns
    -------
    AnalysisArrays
    """
    return merged_analysis(plan, [measure_sets(plan, first, sets)])


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
        The sets drawn; not looked at where the source brings its own.

    Returns
    -------
    SourceResult
    """
    told = (f"the file {NO_TORUS}",) if source.toroidal is False else ()
    analysis = arrays.analysis()
    drawn = realizations if source.sets is None else ()
    costs = [(one.cpu_seconds, one.first) for one in drawn]
    return SourceResult(
        **{**vars(analysis), "warnings": (*told, *analysis.warnings)},
        key=source.key,
        label=source.label,
        n=source.n,
        d=source.d,
        realizations=source.realizations,
        points=_points(drawn) if source.sets is None else source.sets,
        cpu_seconds=mean_cost([cost for cost, _ in costs], [first for _, first in costs]),
    )


def _points(realizations: Sequence[Realization]) -> FloatArray:
    """Put the points of sets together, which are looked at one after another."""
    return filled((len(realizations), *realizations[0].x.shape), (each.x[None] for each in realizations))
