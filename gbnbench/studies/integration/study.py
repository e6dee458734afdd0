"""The study of integration: variances of means over points against n, beside what spectra predict.

Ahmed, Ren & Wonka 2022, Section 5.2; Pilleboue et al. 2015.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gbnbench import __version__
from gbnbench.analysis.integration.integrands.registry import find as find_family
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.least_values import require
from gbnbench.core.settings import specification
from gbnbench.core.sides import as_sides
from gbnbench.execution.progress import Progress
from gbnbench.runs import comparison_folder
from gbnbench.runs.device_proof import run_device
from gbnbench.runs.every_task import run_tasks
from gbnbench.runs.provenance import versions
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.runs.sources import Source, resolve
from gbnbench.studies.drawing import failure_of
from gbnbench.studies.integration.blocks import tasks_of
from gbnbench.studies.integration.requirements import served
from gbnbench.studies.integration.study_folder import IntegrationStudy, StudyFolder, read_integration
from gbnbench.studies.integration.tables import gather, tables

DEFAULT_SOURCES = ("random", "jittered", "sobol", "gbn")
DEFAULT_INTEGRANDS = ("gaussians", "half-space")
DEFAULT_N = (16, 64, 256, 1024)


@dataclass(frozen=True)
class IntegrationOutcome:
    """What one call of ``integrate`` came to.

    Attributes
    ----------
    study : IntegrationStudy
        Whole.
    folder : Path
        Where it stands.
    reused, pieces : int
        Pieces found finished in the folder, of how many.
    seconds : float
        Wall time of this call.
    undrawn : str
        Why tables or the picture could not be written; empty where they were.
    """

    study: IntegrationStudy
    folder: Path
    reused: int
    pieces: int
    seconds: float
    undrawn: str = ""


def run_integration_study(
    sources: Sequence[str | Source] = DEFAULT_SOURCES,
    folder: str | Path | None = None,
    *,
    n: Sequence[int] = DEFAULT_N,
    d: Sequence[int] = (2,),
    realizations: int = 16,
    integrands: Sequence[str] = DEFAULT_INTEGRANDS,
    instances: int = 100,
    shifts: int = 0,
    seed: int = 0,
    jobs: int | None = None,
    command: str = "",
    skipped: Sequence[str] = (),
    progress: Progress | None = None,
    draw: Callable[[IntegrationStudy, Path], None] | None = None,
) -> IntegrationOutcome:
    """Estimate every integral with every set, in a folder that the same call can resume.

    Parameters
    ----------
    sources : sequence of str or Source
        Generators with settings, files and folders, as in ``gbnbench compare``.
    folder : path, optional
        By default one under ``runs`` named by the settings.
    n, d : sequence of int
        Sizes and dimensions for the generators; what a generator refuses is skipped and said.
    realizations : int
        Sets of each generator.
    integrands : sequence of str
        Families with settings, such as ``gaussians[count=16]``; a dimension where one has no integrands is
        skipped and said.
    instances : int
        Integrands of each family, the same for all sources and n.
    shifts : int
        Random toroidal shifts of each set; 0 takes the sets as they are.
    seed : int
        Realization k draws from stream k of it; integrands and shifts from streams of their own.
    jobs : int, optional
        Worker processes, each with one thread; by default one a core.
    command : str
        What the user typed, for the manifest.
    skipped : sequence of str
        What was refused when the sources were resolved, for the manifest.
    progress : Progress, optional
        Told what is being done.
    draw : callable, optional
        ``draw(study, folder)`` makes the picture before the study is declared whole.

    Returns
    -------
    IntegrationOutcome

    Raises
    ------
    InputError
        If a name or number is wrong, or the folder holds something else.
    RefusalError
        If nothing remains of the sources, no family has integrands in any of the dimensions, or points lie on
        a torus with unequal sides.
    UnfinishedError
        If pieces failed; every other piece is kept.
    """
    began = time.monotonic()
    progress = progress or Progress()
    require(instances=(instances, 1), shifts=(shifts, 0), seed=(seed, 0), jobs=(jobs or 1, 1))
    jobs = jobs or os.cpu_count() or 1
    families = tuple(dict.fromkeys(find_family(text) for text in integrands))
    if not families:
        raise InputError("no integrand given: name one, such as gaussians")
    given = [source for source in sources if isinstance(source, Source)]
    names = [source for source in sources if not isinstance(source, Source)]
    if names:
        found, refused = resolve(names, n, d, realizations)
        given.extend(found)
        skipped = (*skipped, *refused)
    for source in given:
        if as_sides(source.sides, source.d) is not None:
            raise RefusalError(
                f"{source.label} (n={source.n}, d={source.d}): the integrands are functions of a cube, and "
                "its box has unequal sides; gbnbench convert --fractions writes its points as those of a cube"
            )
    families_in = {d: served(families, d) for d in dict.fromkeys(source.d for source in given)}
    without = [sentence for _, refused in families_in.values() for sentence in refused]
    if not any(kept for kept, _ in families_in.values()):
        raise RefusalError("; ".join(without))
    skipped = (*skipped, *without)
    settings: dict[str, Any] = {
        "gbnbench": __version__,
        "seed": seed,
        "device": run_device(jobs) or "numpy",
        "sources": [source.identity() for source in given],
        "integrands": [specification(family) for family in families],
        "instances": instances,
        "shifts": shifts,
    }
    store = StudyFolder(Path(folder or comparison_folder.default_folder(settings, "integrate")), settings)
    largest_first = sorted(given, key=lambda source: -source.n * source.d)
    tasks = [
        task
        for source in largest_first if families_in[source.d][0]
        for task in tasks_of(source, families_in[source.d][0], instances, shifts, seed)
    ]  # fmt: skip
    with store.lock(), explain_interruption(store.path):
        if store.whole:
            study = read_integration(store.path)
            return IntegrationOutcome(study, store.path, len(tasks), len(tasks), time.monotonic() - began)
        store.begin()
        work = run_tasks(tasks, store, jobs, progress)
        errors = {
            (source.key, specification(family)): gather(work.results, source, family)
            for source in given for family in families_in[source.d][0]
        }  # fmt: skip
        manifest = {
            "command": command,
            "version": __version__,
            "settings": settings,
            "seed": seed,
            "device": settings["device"],
            "versions": versions(),
            "created": time.strftime("%Y-%m-%dT%H:%M:%S%z"),
            "seconds": round(time.monotonic() - began, 3),
            "skipped": list(skipped),
        }
        study = IntegrationStudy(manifest, *tables(given, families, instances, shifts, errors))

        def last_steps() -> None:
            store.write_tables(study)
            if draw is not None:
                progress.advance("drawing", 0)
                draw(study, store.path)
            store.finish(manifest)

        undrawn = failure_of(last_steps)
    seconds = time.monotonic() - began
    return IntegrationOutcome(study, store.path, work.reused, len(tasks), seconds, undrawn)
