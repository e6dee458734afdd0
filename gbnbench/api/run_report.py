"""One report of several finished comparisons, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gbnbench.runs.joined_runs import JoinedRuns, join_runs


def report_runs(folders: Sequence[str | Path], path: str | Path) -> JoinedRuns:
    """Write one page that shows finished comparisons side by side.

    Parameters
    ----------
    folders : sequence of path
        Two or more run folders with the same n and d. The first is the baseline of the others.
    path : path
        The page; one that is there is replaced.

    Returns
    -------
    JoinedRuns
        With the verdicts against the first run.

    Raises
    ------
    InputError
        If one is no finished comparison, is given twice, or is of other sizes or dimensions than the first.
    FormatError
        If a file in one is missing or was changed.
    OSError
        If the page cannot be written.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> from gbnbench.api.run_report import report_runs
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for seed in (0, 1):
    ...         done = gbnbench.compare(
    ...             "random", n=16, realizations=2, seed=seed, out=f"{folder}/seed{seed}", jobs=1, quiet=True
    ...         )
    ...     joined = report_runs([f"{folder}/seed0", f"{folder}/seed1"], f"{folder}/both.html")
    >>> joined.names, [source.label for source in joined.run.sources]
    (('seed0', 'seed1'), ['random · seed0', 'random · seed1'])
    """
    from gbnbench.reports.html.page import write_report

    joined = join_runs(folders)
    write_report(joined.run, path, joined=joined)
    return joined
