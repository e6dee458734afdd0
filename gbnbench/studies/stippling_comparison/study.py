"""The comparison of stipplings: sets for one density, drawn and measured in a folder to be resumed."""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from gbnbench import __version__
from gbnbench.core.least_values import require
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress
from gbnbench.generators.adaptive.density import Density
from gbnbench.runs.comparison_folder import default_folder
from gbnbench.runs.device_proof import needed_device
from gbnbench.runs.provenance import versions
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.studies.drawing import failure_of
from gbnbench.studies.stippling_comparison.flat_patch import flattest_patch
from gbnbench.studies.stippling_comparison.stippling_folder import (
    StipplingFolder,
    assembled,
    read_stippling_run,
    set_key,
)
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun
from gbnbench.studies.stippling_comparison.stippling_sources import StipplingSource
from gbnbench.studies.stippling_comparison.stippling_tasks import stippling_tasks


@dataclass(frozen=True)
class StipplingOutcome:
    """What one call of the comparison came to.

    Attributes
    ----------
    run : StipplingRun
        All that was measured; ``run.failures`` says what could not be.
    folder : Path
        Where it stands.
    reused, pieces : int
        Sets found finished in the folder, of how many.
    seconds : float
        Wall time of this call.
    undrawn : str
        Why tables, pictures or the report could not be written; empty where they were.
    """

    run: StipplingRun
    folder: Path
    reused: int
    pieces: int
    seconds: float
    undrawn: str = ""


def run_stippling_comparison(
    sources: Sequence[StipplingSource],
    density: Density,
    name: str,
    n: int,
    folder: str | Path | None = None,
    *,
    seed: int = 0,
    jobs: int | None = None,
    command: str = "",
    skipped: Sequence[str] = (),
    unread: Sequence[str] = (),
    progress: Progress | None = None,
    draw: Callable[[StipplingRun, Path], None] | None = None,
    meanwhile: Callable[[], None] | None = None,
) -> StipplingOutcome:
    """Draw and measure every set, in a folder that the same call can resume.

    Parameters
    ----------
    sources : sequence of StipplingSource
        From ``stippling_sources``.
    density : Density
        Of an image, of two axes and bounded.
    name : str
        What it is called.
    n : int
        Points that decide which square is looked at closely.
    folder : path, optional
        By default one under ``runs`` named by the settings.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``, however the work is split.
    jobs : int, optional
        Worker processes, each with one thread; by default one a core.
    command : str
        What the user typed, for the manifest.
    skipped : sequence of str
        What was refused, for the manifest.
    unread : sequence of str
        What could not be read: failures of the run, as sources are that fail at work.
    progress : Progress, optional
        Told what is being done.
    draw : callable, optional
        ``draw(run, folder)`` makes the pictures and the report.
    meanwhile : callable, optional
        What to do while the first worker starts.

    Returns
    -------
    StipplingOutcome
        A source of which a set failed is left out of the results and named in ``run.failures``; the folder
        is then not whole, and the same call tries it again.

    Raises
    ------
    InputError
        If a number is out of range, or the folder holds something else.
    DeviceError
        If no OpenCL device can be used.
    OSError
        If the disk is full; what is finished is kept.
    """
    began = time.monotonic()
    progress = progress or Progress()
    require(jobs=(1 if jobs is None else jobs, 1), seed=(seed, 0))
    jobs = jobs or os.cpu_count() or 1
    patch = flattest_patch(density.values, n)
    settings: dict[str, Any] = {
        "gbnbench": __version__,
        "seed": seed,
        "device": needed_device(jobs),
        "density": {
            "name": name,
            "shape": list(density.shape),
            "sha256": hashlib.sha256(density.values.tobytes()).hexdigest(),
        },
        "patch": None if patch is None else asdict(patch),
        "sources": [source.identity() for source in sources],
    }
    store = StipplingFolder(Path(folder or default_folder(settings, "stipplings")), settings)
    tasks = stippling_tasks(sources, density, patch, seed, jobs)
    with store.lock(), explain_interruption(store.path):
        if store.whole:
            run = replace(read_stippling_run(store.path), failures=tuple(unread))
            return StipplingOutcome(run, store.path, len(tasks), len(tasks), time.monotonic() - began)
        store.begin()
        for line in unread:
            progress.say(f"failed: {line}")
        work = TaskRun(tasks, store)
        if work.missing:
            if work.reused:
                progress.say(f"resuming {store.path}: {work.reused} of {len(tasks)} sets are there")
            for done in work.complete(jobs, progress, doing="drawing sets", meanwhile=meanwhile):
                if done.failure:
                    progress.say(f"failed: {done.key}: {done.failure}")
        manifest = {
            "command": command,
            "version": __version__,
            "settings": settings,
            "seed": seed,
            "device": settings["device"],
            "versions": versions(),
            "created": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
            "timings": {"seconds": round(time.monotonic() - began, 3), "resumed": work.reused > 0},
            "skipped": list(skipped),
        }
        run = _run(sources, density.values, manifest, work, unread)

        def last_steps() -> None:
            progress.advance("writing the tables", 0)
            store.write_tables(run)
            if draw is not None:
                progress.advance("drawing", 0)
                draw(run, store.path)
            if not run.failures:
                store.finish(manifest)

        undrawn = failure_of(last_steps) if run.sources else ""
    return StipplingOutcome(run, store.path, work.reused, len(tasks), time.monotonic() - began, undrawn)


def _run(
    sources: Sequence[StipplingSource], density: FloatArray, manifest: dict[str, Any], work: TaskRun,
    unread: Sequence[str],
) -> StipplingRun:  # fmt: skip
    found, failures = {}, list(unread)
    for source in sources:
        keys = [set_key(source.key, k) for k in range(source.realizations)]
        faults = [work.failures[key] for key in keys if key in work.failures]
        if faults:
            failures.append(f"{source.label}: {faults[0]}")
        else:
            found[source.key] = [work.results[key] for key in keys]
    return assembled(manifest, density, found, failures)
