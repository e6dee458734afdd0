"""What the workers of a study of integration do: draw a block of sets and estimate every integral with it."""

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
from gbnbench.generators.monitor import Watch, Watchable
from gbnbench.generators.protocol import Generator, realization_rng
from gbnbench.runs.resumable import Task
from gbnbench.runs.sources import Source

INSTANCE, SHIFT = 2**31 + 1, 2**31 + 2  # first words of spawn keys, far from any realization's number
BLOCK_POINTS, BLOCK_SETS = 16_384, 32  # of a piece; fixed, so that pieces do not depend on the machine


def instances_of(family: Family, d: int, seed: int, count: int) -> list[Integrand]:
    """Draw integrands: number i from ``SeedSequence(seed, spawn_key=(2^31 + 1, i))`` whatever the count."""
    seeds = (np.random.SeedSequence(seed, spawn_key=(INSTANCE, i)) for i in range(count))
    return [family.draw(d, np.random.default_rng(each)) for each in seeds]


def tasks_of(
    source: Source, families: tuple[Family, ...], instances: int, shifts: int, seed: int
) -> list[Task]:
    """Part the work on one source in pieces, whose keys are ``SOURCE/FIRST``."""
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
    """Name the piece of a source that begins with this realization."""
    return f"{source.key}/{first:06d}"


def blocks(source: Source) -> list[tuple[int, int]]:
    """Part a source's realizations in (first, count)."""
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

    Returns
    -------
    dict
        For each family by its specification: ``... errors``, (instances, count, shifts or 1) estimates less
        integrals; where its spectrum is known ``... foretold``, (instances, count) variances, and
        ``... beyond``.
    """
    if isinstance(origin, np.ndarray):
        sets = origin
    else:
        rngs = [realization_rng(seed, first + k) for k in range(count)]
        if isinstance(origin, Watchable):
            sets = origin.draw(n, d, rngs, Watch())
        else:
            sets = np.stack([origin(n, d, rng) for rng in rngs])
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
    """Estimates less integrals: (integrands, sets, shifts or 1)."""
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
