"""The tasks of a study of integration: each draws a block of sets and estimates every integral with it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.estimator import estimate_errors
from gbnbench.analysis.integration.integrands.protocol import Family, Integrand
from gbnbench.analysis.integration.spectral_variance import FourierSeries, fourier_series, predicted_variance
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import Generator
from gbnbench.runs.sources import Source
from gbnbench.runs.task import Task
from gbnbench.studies.drawn_sets import realizations_of

INSTANCE, SHIFT = 2**31 + 1, 2**31 + 2  # first words of spawn keys, far from any realization's number
BLOCK_POINTS, BLOCK_SETS = 16_384, 32  # of a block; fixed, so that blocks do not depend on the machine


def instances_of(family: Family, d: int, seed: int, count: int) -> list[Integrand]:
    """Draw integrands; the first of many are the same as those of few.

    Parameters
    ----------
    family : Family
        Of integrands.
    d : int
        Dimension.
    seed : int
        Number i is drawn from ``SeedSequence(seed, spawn_key=(2^31 + 1, i))``.
    count : int
        How many.

    Returns
    -------
    list of Integrand
    """
    seeds = (np.random.SeedSequence(seed, spawn_key=(INSTANCE, i)) for i in range(count))
    return [family.draw(d, np.random.default_rng(each)) for each in seeds]


def tasks_of(
    source: Source, families: tuple[Family, ...], instances: int, shifts: int, seed: int
) -> list[Task]:
    """List the tasks of one source, a block of its realizations each.

    Parameters
    ----------
    source : Source
        Whose sets.
    families : tuple of Family
        Of integrands.
    instances : int
        Integrands of each family.
    shifts : int
        Random toroidal shifts of each set; 0 takes the sets as they are.
    seed : int
        Of the sets, integrands and shifts.

    Returns
    -------
    list of Task
    """
    return [
        Task(
            task_key(source, first),
            f"{source.label}, n={source.n}, d={source.d}",
            estimate_block,
            (
                _origin(source, first, count),
                source.n,
                source.d,
                first,
                count,
                families,
                instances,
                shifts,
                seed,
            ),
        )
        for first, count in blocks(source)
    ]


def task_key(source: Source, first: int) -> str:
    """Name the task of a block, ``SOURCE/FIRST``.

    Parameters
    ----------
    source : Source
        Whose block.
    first : int
        The realization that the block begins with.

    Returns
    -------
    str
    """
    return f"{source.key}/{first:06d}"


def blocks(source: Source) -> list[tuple[int, int]]:
    """Split the realizations of a source into blocks, (first, count) each."""
    size = max(1, min(BLOCK_SETS, BLOCK_POINTS // source.n))
    return [(first, min(size, source.realizations - first)) for first in range(0, source.realizations, size)]


def estimate_block(
    origin: Generator | FloatArray,
    n: int,
    d: int,
    first: int,
    count: int,
    families: Sequence[Family],
    instances: int,
    shifts: int,
    seed: int,
) -> dict[str, NDArray[Any]]:
    """Draw a block of sets and estimate every integral with it.

    Parameters
    ----------
    origin : Generator or (count, n, d) float64
        What draws the sets, or the sets.
    n, d : int
        Points a set and dimension.
    first, count : int
        The first realization of the block, and how many it has.
    families : sequence of Family
        Of integrands.
    instances : int
        Integrands of each family.
    shifts : int
        Random toroidal shifts of each set; 0 takes the sets as they are.
    seed : int
        Of the sets, integrands and shifts.

    Returns
    -------
    dict
        For each family by its specification: ``... errors``, (instances, count, shifts or 1) estimates less
        integrals; where its spectrum is known ``... foretold``, (instances, count) variances, and
        ``... beyond``.
    """
    sets = origin if isinstance(origin, np.ndarray) else realizations_of(origin, n, d, first, count, seed)
    found: dict[str, NDArray[Any]] = {}
    for family in families:
        text = specification(family)
        drawn, series = _known(family, d, seed, instances)  # type: ignore[arg-type]  # frozen: hashable
        found[f"{text} errors"] = errors_of(drawn, sets, first, seed, shifts)
        if series is not None:
            found[f"{text} foretold"] = predicted_variance(series, sets)
            found[f"{text} beyond"] = np.asarray(series.beyond / n)
    return found


def errors_of(
    integrands: Sequence[Integrand], sets: FloatArray, first: int, seed: int, shifts: int
) -> FloatArray:
    """Compute the errors of the estimates by every set, shifted or not.

    Parameters
    ----------
    integrands : sequence of Integrand
        What is integrated.
    sets : (sets, n, d) float64
        Points.
    first : int
        Realization number of the first set, which decides its shifts.
    seed : int
        Of the shifts.
    shifts : int
        Random toroidal shifts of each set; 0 takes the sets as they are.

    Returns
    -------
    (integrands, sets, shifts or 1) float64
        Estimates less integrals.
    """
    if shifts == 0:
        return estimate_errors(integrands, sets)[:, :, None]
    errors = np.empty((len(integrands), len(sets), shifts))
    for k, points in enumerate(sets):
        moved = np.empty((shifts, *points.shape))
        for s in range(shifts):
            rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(SHIFT, first + k, s)))
            moved[s] = wrap(points + rng.random(points.shape[1]))
        errors[:, k, :] = estimate_errors(integrands, moved)
    return errors


def _origin(source: Source, first: int, count: int) -> Generator | FloatArray:
    """Give a worker what it has its sets from."""
    if source.sets is not None:
        return source.sets[first : first + count]
    if source.generator is None:
        raise TypeError(f"{source.key} has neither a generator nor sets")
    return source.generator


@lru_cache(maxsize=16)
def _known(
    family: Family, d: int, seed: int, instances: int
) -> tuple[tuple[Integrand, ...], FourierSeries | None]:
    """Integrands and their series, in a worker once for all of its pieces."""
    drawn = tuple(instances_of(family, d, seed, instances))
    return drawn, fourier_series(family, drawn, d)
