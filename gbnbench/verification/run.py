"""All published figures measured in worker processes, the sets of a generator in one of them."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from itertools import groupby
from operator import attrgetter

from gbnbench.core.errors import InputError
from gbnbench.execution.progress import Progress
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.task import Task
from gbnbench.verification.published_figure import PublishedFigure
from gbnbench.verification.verify import Verified, verify


def verify_all(
    figures: Sequence[PublishedFigure], *, jobs: int | None = None, progress: Progress | None = None
) -> tuple[Verified, ...]:
    """Measure ours of all figures.

    Parameters
    ----------
    figures : sequence of PublishedFigure
        Those of the same sets next to one another: they are drawn once.
    jobs : int, optional
        Worker processes of one thread each; by default one a core.
    progress : Progress, optional
        Told which generator is done.

    Returns
    -------
    tuple of Verified
        In the order of the figures; what could not be measured is nan and says why.

    Raises
    ------
    InputError
        If jobs is below 1.
    """
    if jobs is not None and jobs < 1:
        raise InputError(f"jobs must be at least 1; got {jobs}")
    groups = {str(k): tuple(group) for k, (_, group) in enumerate(groupby(figures, attrgetter("same_sets")))}
    tasks = [
        Task(key, f"drawing {_title(group[0])}", measured, (group,), done=f"measured {_title(group[0])}")
        for key, group in groups.items()
    ]
    run = TaskRun(tasks)
    found: dict[str, tuple[Verified, ...]] = {}
    for done in run.complete(jobs or os.cpu_count() or 1, progress or Progress(), prove_device=False):
        key = str(done.key)
        group = groups[key]
        found[key] = (
            tuple(Verified(figure, math.nan, done.failure) for figure in group)
            if done.failure
            else tuple(Verified(figure, ours) for figure, ours in zip(group, done.value, strict=True))
        )
    return tuple(one for key in groups for one in found[key])


def measured(figures: Sequence[PublishedFigure]) -> list[float]:
    """Measure ours of figures of the same sets, in a worker."""
    return [one.ours for one in verify(figures)]


def _title(figure: PublishedFigure) -> str:
    return f"{figure.generator}, n={figure.n}, d={figure.d}"
