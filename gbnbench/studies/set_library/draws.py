"""The calls that workers carry out for a library: draw a realization, and measure those of a file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gbnbench.analysis.measures import measures
from gbnbench.core.cpu_time import cpu_seconds
from gbnbench.core.errors import RefusalError
from gbnbench.core.results.measures import Measures
from gbnbench.generators.protocol import Generator
from gbnbench.runs.comparison_folder import Realization
from gbnbench.studies.timed_draw import draw_realization


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
