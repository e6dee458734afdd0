"""The comparison itself: makes the sets, measures them, and keeps every finished piece as it comes."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gbnbench import __version__
from gbnbench.core.errors import InputError, UnfinishedError
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress
from gbnbench.execution.worker_pool import Finished, Pool
from gbnbench.execution.worker_tasks import analyse_sets, draw_set, prove_device
from gbnbench.runs import comparison_folder
from gbnbench.runs.baseline import Change, judge
from gbnbench.runs.comparison_result import Run, SourceResult
from gbnbench.runs.provenance import versions
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.runs.sources import Source

if TYPE_CHECKING:
    from gbnbench.analysis.measures import Analysis


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
    """

    run: Run
    folder: Path
    changes: tuple[Change, ...]
    notes: tuple[str, ...]
    reused: int
    pieces: int
    seconds: float

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
        ``draw(run, folder)`` makes the pictures and the report before the run is declared whole.

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
    from gbnbench.opencl import choose

    began = time.monotonic()
    progress = progress or Progress()
    if jobs is not None and jobs < 1:
        raise InputError(f"jobs must be at least 1; got {jobs}")
    if seed < 0:
        raise InputError(f"seed must not be negative; got {seed}")
    earlier = None if baseline is None else comparison_folder.read_run(baseline)
    if earlier is not None:
        _require_common(sources, earlier, baseline)
    device = choose().describe()
    settings: dict[str, Any] = {
        "gbnbench": __version__,
        "seed": seed,
        "device": device,
        "sources": [source.identity() for source in sources],
    }
    keeper = comparison_folder.ComparisonFolder(
        folder or comparison_folder.default_folder(settings), settings
    )
    pieces = sum(_pieces(source) for source in sources)
    with keeper.lock(), explain_interruption(keeper.path):
        if keeper.whole:
            run = comparison_folder.read_run(keeper.path)
            changes, notes = ((), ()) if earlier is None else judge(run, earlier)
            if run.verdicts == _verdicts(changes):
                return ComparisonOutcome(
                    run, keeper.path, changes, notes, pieces, pieces, time.monotonic() - began
                )
        keeper.begin()
        results, reused = _work(keeper, sources, seed, jobs or os.cpu_count() or 1, progress)
        run = Run({}, tuple(results[source.key] for source in sources))
        changes, notes = ((), ()) if earlier is None else judge(run, earlier)
        manifest = {
            "command": command,
            "version": settings["gbnbench"],
            "settings": settings,
            "seed": seed,
            "device": device,
            "versions": versions(),
            "created": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
            "timings": {
                "seconds": round(time.monotonic() - began, 3),
                "resumed": reused > 0,
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
        progress.advance("writing the tables", 0)
        keeper.write_tables(run)
        if draw is not None:
            progress.advance("drawing", 0)
            draw(run, keeper.path)
        keeper.finish(manifest)
    return ComparisonOutcome(run, keeper.path, changes, notes, reused, pieces, time.monotonic() - began)


def _require_common(sources: Sequence[Source], earlier: Run, baseline: Path | None) -> None:
    """Refuse a baseline that no source can be judged against: silence would read as success."""
    rows = {(source.label, source.n, source.d) for source in earlier.sources}
    if not any((source.label, source.n, source.d) in rows for source in sources):
        held = ", ".join(f"{label} (n={n}, d={d})" for label, n, d in sorted(rows))
        raise InputError(f"the baseline {baseline} has none of these sources; it holds {held}")


def _verdicts(changes: Sequence[Change]) -> dict[tuple[str, str], str]:
    return {(change.key, change.measure): change.verdict for change in changes}


def _pieces(source: Source) -> int:
    return 1 + (source.realizations if source.generator is not None else 0)


def _work(
    keeper: comparison_folder.ComparisonFolder,
    sources: Sequence[Source],
    seed: int,
    jobs: int,
    progress: Progress,
) -> tuple[dict[str, SourceResult], int]:
    """Do what the folder does not hold yet; return all results and how many pieces were there."""
    results: dict[str, SourceResult] = {}
    missing: dict[str, list[int]] = {}
    for source in sources:
        kept = keeper.read_source(source.key)
        if kept is not None:
            results[source.key] = kept
        elif source.generator is None:
            missing[source.key] = []
        else:
            missing[source.key] = [
                k for k in range(source.realizations) if keeper.read_realization(source.key, k) is None
            ]
    by_key = {source.key: source for source in sources if source.key in missing}
    steps = sum(len(lacking) + 1 for lacking in missing.values())
    total = sum(_pieces(source) for source in sources)
    if not by_key:
        return results, total
    progress.start(total, total - steps, "checking the device (kernels of a new one are compiled, once)")
    if steps < total:
        progress.say(f"resuming {keeper.path}: {total - steps} of {total} pieces are there")
    failures: list[str] = []
    with Pool(min(jobs, steps)) as pool:
        prove_device(pool)
        progress.start(total, total - steps, "making sets")  # what the check took says nothing of the rest
        for key, lacking in missing.items():
            source = by_key[key]
            if not lacking:
                pool.submit((key, None), analyse_sets, _sets(keeper, source))
            again = source.realizations <= jobs
            for k in lacking:
                pool.submit((key, k), draw_set, source.generator, source.n, source.d, seed, k, again)
        while pool.pending:
            done = pool.next()
            key, k = done.key  # type: ignore[misc]
            source = by_key[key]
            if done.failure:
                failures.append(_describe(source, k, done))
                progress.say(failures[-1])
                progress.advance(f"failed: {source.label}")
            elif k is None:
                results[key] = _result(keeper, source, done.value)
                keeper.write_source(results[key])
                progress.advance(f"measured {source.label}, n={source.n}, d={source.d}")
            else:
                keeper.write_realization(key, k, comparison_folder.Realization(*done.value))
                missing[key].remove(k)
                progress.advance(f"made {source.label}, n={source.n}, d={source.d}")
                if not missing[key]:
                    pool.submit((key, None), analyse_sets, _sets(keeper, source))
    if failures:
        raise UnfinishedError(
            f"{len(failures)} of {steps} pieces failed (what is finished is kept in {keeper.path}; "
            f"the same command tries only the rest); the first: {failures[0]}"
        )
    return results, total - steps


def _describe(source: Source, k: int | None, done: Finished) -> str:
    what = "measuring it" if k is None else f"realization {k}"
    return f"{source.label} (n={source.n}, d={source.d}), {what}: {done.failure}"


def _parts(keeper: comparison_folder.ComparisonFolder, source: Source) -> list[comparison_folder.Realization]:
    parts = [keeper.read_realization(source.key, k) for k in range(source.realizations)]
    return [part for part in parts if part is not None]


def _sets(keeper: comparison_folder.ComparisonFolder, source: Source) -> FloatArray:
    if source.sets is not None:
        return source.sets
    return np.stack([part.x for part in _parts(keeper, source)])


def _result(keeper: comparison_folder.ComparisonFolder, source: Source, analysis: Analysis) -> SourceResult:
    return SourceResult(
        key=source.key,
        label=source.label,
        n=source.n,
        d=source.d,
        realizations=source.realizations,
        points=_sets(keeper, source),
        spectrum=analysis.spectrum,
        radial=analysis.radial,
        anisotropy=analysis.anisotropy,
        rdf=analysis.rdf,
        valence=analysis.valence,
        zone_plate=analysis.zone_plate,
        measures=analysis.measures,
        cpu_seconds=_cpu_seconds(_parts(keeper, source)) if source.sets is None else float("nan"),
        warnings=tuple(analysis.warnings),
    )


def _cpu_seconds(parts: Sequence[comparison_folder.Realization]) -> float:
    """Mean cost of a set, without each worker's first where there are others: set-up is not the method's."""
    warm = [part.cpu_seconds for part in parts if not part.first]
    return float(np.mean(warm or [part.cpu_seconds for part in parts]))
