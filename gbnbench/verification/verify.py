"""Drawing the sets of published figures, and measuring them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter

import numpy as np

from gbnbench.analysis.measures import measures
from gbnbench.core.torus import FloatArray
from gbnbench.generators.registry import generate
from gbnbench.verification.published_figure import PublishedFigure


@dataclass(frozen=True)
class Verified:
    """A published figure beside ours.

    Attributes
    ----------
    figure : PublishedFigure
        What was published.
    ours : float
        What was measured; nan where the measure is undefined or the sets could not be drawn.
    failure : str
        Why they could not be drawn; empty where they were.
    """

    figure: PublishedFigure
    ours: float
    failure: str = ""

    @property
    def agrees(self) -> bool:
        """Whether ours lies within the tolerance."""
        return self.figure.low <= self.ours <= self.figure.high


def verify(
    figures: Iterable[PublishedFigure], progress: Callable[[str], None] | None = None
) -> Iterator[Verified]:
    """Measure ours, one figure after another; sets that several figures share are drawn once.

    Parameters
    ----------
    figures : iterable of PublishedFigure
        In the order in which they are to come; those of the same sets next to one another.
    progress : callable, optional
        Called with the generator before its sets are drawn.

    Yields
    ------
    Verified

    Raises
    ------
    InputError, RefusalError
        If a generator is unknown or cannot make the sets.
    """
    for (generator, n, d, sets, seed), group in groupby(figures, attrgetter("same_sets")):
        if progress is not None:
            progress(generator)
        x = np.reshape(generate(generator, n=n, d=d, seed=seed, realizations=sets), (sets, n, d))
        yield from _measured(x, list(group))


def _measured(x: FloatArray, figures: list[PublishedFigure]) -> Iterator[Verified]:
    scalars = measures(x) if any(isinstance(figure.measure, str) for figure in figures) else {}
    for figure in figures:
        if isinstance(figure.measure, str):
            yield Verified(figure, scalars[figure.measure])
        else:
            yield Verified(figure, float(np.mean([figure.measure(one) for one in x])))
