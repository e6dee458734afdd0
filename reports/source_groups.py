"""Groups of the sources of a run: only sources of one size and dimension are compared with each other."""

from __future__ import annotations

from gbnbench.runs.comparison_result import Run, SourceResult

Group = tuple[int, int]


def groups(run: Run) -> list[Group]:
    """List each (n, d) of the run once, in the order of the sources; only sources of one are compared."""
    return list(dict.fromkeys((source.n, source.d) for source in run.sources))


def members(run: Run, group: Group | None) -> list[SourceResult]:
    """Return the sources of one size and dimension.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d) or None
        Size and dimension; None takes all sources.

    Returns
    -------
    list of SourceResult
        Sources in the run's order.
    """
    return [source for source in run.sources if group is None or (source.n, source.d) == group]
