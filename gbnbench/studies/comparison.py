"""The comparison of sources: their sets are made and measured in a folder that the same call can resume."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench import __version__
from gbnbench.core.errors import InputError
from gbnbench.core.least_values import require
from gbnbench.execution.progress import Progress
from gbnbench.runs import comparison_folder
from gbnbench.runs.baseline import Change, judge
from gbnbench.runs.comparison_result import Run
from gbnbench.runs.device_proof import needed_device
from gbnbench.runs.every_task import run_tasks
from gbnbench.runs.provenance import versions
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.runs.sources import Source
from gbnbench.studies.comparison_tasks import comparison_tasks
from gbnbench.studies.drawing import failure_of
from gbnbench.studies.growing_report import GrowingReport, Unfinished


@dataclass(frozen=True)
class ComparisonOutcome:
    """What one call of ``compare`` came to.

    Attributes
    ----------
    run : Run
        The whole comparison.
    folder : Path
        Where it stands.
    changes : tuple of Change
        Measures that became better or worse than the baseline.
    notes : tuple of str
        Rows that could not be compared with it.
    reused, pieces : int
        Pieces (sets made and sources measured) found finished in the folder, of how many.
    seconds : float
        Wall time of this call.
    undrawn : str
        Why tables, pictures or the report could not be written; empty where they were.
    """

    run: Run
    folder: Path
    changes: tuple[Change, ...]
    notes: tuple[str, ...]
    reused: int
    pieces: int
    seconds: float
    undrawn: str = ""

    @property
    def worse(self) -> bool:
        """Whether anything is worse than the baseline."""
        return any(change.verdict == "worse" for change in self.changes)


def run_comparison(
    sources: Sequence[Source],
    folder: Path | None = None,
    *,
    seed: int = 0,
    jobs: int | None = None,
    baseline: Path | None = None,
    command: str = "",
    skipped: Sequence[str] = (),
    progress: Progress | None = None,
    draw: Callable[[Run, Path], None] | None = None,
    grow: Callable[[Run, Path, Unfinished], None] | None = None,
    meanwhile: Callable[[], None] | None = None,
) -> ComparisonOutcome:
    """Make and measure every source, in a run folder that the same call can resume.

    Parameters
    ----------
    sources : sequence of Source
        From ``gbnbench.runs.sources.resolve``.
    folder : Path, optional
        The run folder; by default one under ``runs`` named by the settings.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``, however the work is split.
    jobs : int, optional
        Worker processes, each with one thread; by default one a core.
    baseline : Path, optional
        A finished run to judge this one against.
    command : str
        What the user typed, for the manifest.
    skipped : sequence of str
        What ``resolve`` refused, for the manifest.
    progress : Progress, optional
        Told what is being done.
    draw : callable, optional
        ``draw(run, folder)`` makes the pictures and the report before the run is declared whole. Where it
        fails, the results are kept, and the same call tries it again.
    grow : callable, optional
        ``grow(run, folder, unfinished)`` writes the report of what is measured so far; called now and then.
    meanwhile : callable, optional
        What to do while the first worker starts, such as imports for the pictures.

    Returns
    -------
    ComparisonOutcome
        With the run as it was written.

    Raises
    ------
    InputError
        If the folder holds something else, or the baseline is no finished run.
    UnfinishedError
        If pieces failed, named; every other piece is kept and the same call tries only the rest.
    OSError
        If the disk is full; what is finished is kept.
    """
    began = time.monotonic()
    progress = progress or Progress()
    require(jobs=(1 if jobs is None else jobs, 1), seed=(seed, 0))
    earlier = None if baseline is None else comparison_folder.read_run(baseline)
    if earlier is not None:
        _require_common(sources, earlier, baseline)
    jobs = jobs or os.cpu_count() or 1
    device = needed_device(jobs)
    settings: dict[str, Any] = {
        "gbnbench": __version__,
        "seed": seed,
        "device": device,
        "sources": [source.identity() for source in sources],
    }
    store = comparison_folder.ComparisonFolder(folder or comparison_folder.default_folder(settings), settings)
    tasks = comparison_tasks(sources, seed, jobs)
    with store.lock(), explain_interruption(store.path):
        if store.whole:
            run = comparison_folder.read_run(store.path)
            changes, notes = ((), ()) if earlier is None else judge(run, earlier)
            if run.verdicts == _verdicts(changes):
                store.write_tables(run, missing=True)
                return ComparisonOutcome(
                    run, store.path, changes, notes, len(tasks), len(tasks), time.monotonic() - began
                )
        store.begin()
        if draw is None:  # a page of what was there when such a run was stopped
            (store.path / comparison_folder.REPORT).unlink(missing_ok=True)
        known = {"command": command, "version": __version__, "seed": seed, "device": device}
        labels = {source.key: source.label for source in sources}
        with nullcontext(store) if grow is None else GrowingReport(store, labels, known, grow) as results:
            work = run_tasks(tasks, results, jobs, progress, "making sets", meanwhile)
        run = Run({}, tuple(work.results[source.key] for source in sources))
        changes, notes = ((), ()) if earlier is None else judge(run, earlier)
        manifest = {
            **known,
            "settings": settings,
            "versions": versions(),
            "created": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
            "timings": {
                "seconds": round(time.monotonic() - began, 3),
                "resumed": work.reused > 0,
                "cpu_seconds_a_set": {
                    result.key: result.cpu_seconds
                    for result in run.sources
                    if np.isfinite(result.cpu_seconds)
                },
            },
            "skipped": list(skipped),
            "baseline": None if baseline is None else str(baseline),
            "verdicts": [{"source": c.key, "measure": c.measure, "verdict": c.verdict} for c in changes],
        }
        run = replace(run, manifest=manifest, verdicts=_verdicts(changes))

        def last_steps() -> None:
            progress.advance("writing the tables", 0)
            store.write_tables(run)
            if draw is not None:
                progress.advance("drawing", 0)
                draw(run, store.path)
            store.finish(manifest)

        undrawn = failure_of(last_steps)
    seconds = time.monotonic() - began
    return ComparisonOutcome(run, store.path, changes, notes, work.reused, len(tasks), seconds, undrawn)


def _require_common(sources: Sequence[Source], earlier: Run, baseline: Path | None) -> None:
    """Refuse a baseline that no source can be judged against: silence would read as success."""
    rows = {(source.label, source.n, source.d) for source in earlier.sources}
    if not any((source.label, source.n, source.d) in rows for source in sources):
        held = ", ".join(f"{label} (n={n}, d={d})" for label, n, d in sorted(rows))
        raise InputError(f"the baseline {baseline} has none of these sources; it holds {held}")


def _verdicts(changes: Sequence[Change]) -> dict[tuple[str, str], str]:
    return {(change.key, change.measure): change.verdict for change in changes}
