"""The making of a library of ready point sets, into a folder or an archive, which the same call resumes."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from gbnbench import __version__
from gbnbench.core.errors import InputError
from gbnbench.core.least_values import require
from gbnbench.execution.progress import Progress
from gbnbench.io.set_library.archive import pack, unpack
from gbnbench.io.set_library.manifest import MANIFEST, Manifest
from gbnbench.io.set_library.places import is_archive, manifest_of, open_place
from gbnbench.runs.device_proof import run_device
from gbnbench.runs.every_task import run_tasks
from gbnbench.runs.resumable_folder import SETTINGS, explain_interruption
from gbnbench.studies.set_library.cost_progress import CostProgress
from gbnbench.studies.set_library.request import LibraryRequest, RequestedSets
from gbnbench.studies.set_library.set_folder import LibraryFolder
from gbnbench.studies.set_library.tasks import library_tasks, step_costs

UNFINISHED = ".unfinished"  # ends the name of the folder in which an archive is made


@dataclass(frozen=True)
class MadeLibrary:
    """What one call came to.

    Attributes
    ----------
    manifest : Manifest
        Of the whole library.
    place : Path
        The folder or the archive.
    made, found : int
        Files made by this call, and those that were there; refused ones count too.
    seconds : float
        Wall time of this call.
    """

    manifest: Manifest
    place: Path
    made: int
    found: int
    seconds: float


def make_library(
    request: LibraryRequest,
    out: Path,
    *,
    seed: int = 0,
    jobs: int | None = None,
    progress: Progress | None = None,
) -> MadeLibrary:
    """Make every set asked for that a library lacks.

    Parameters
    ----------
    request : LibraryRequest
        What it shall hold beside what is there.
    out : Path
        A folder, or an archive by its suffix. An archive is made in the folder ``NAME.unfinished`` beside it.
    seed : int
        Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``, however the work is split.
    jobs : int, optional
        Worker processes, each with one thread; by default one a core.
    progress : Progress, optional
        Told what is being done, in thousandths of the estimated cost.

    Returns
    -------
    MadeLibrary

    Raises
    ------
    InputError
        If there is something else, a library of another seed, device or version, or an archive beside a
        folder ``NAME.unfinished`` that lacks sets of it.
    FormatError
        If an archive that is there is damaged.
    UnfinishedError
        If pieces failed; every other is kept, and the same call tries only the rest.
    OSError
        If the disk is full; what is finished is kept.
    """
    began = time.monotonic()
    progress = progress or Progress()
    require(jobs=(1 if jobs is None else jobs, 1), seed=(seed, 0))
    jobs = jobs or os.cpu_count() or 1
    check_place(out)
    folder = working_folder(out)
    identity: dict[str, Any] = {"gbnbench": __version__, "seed": seed, "device": run_device(jobs)}
    if folder != out and out.exists() and not folder.exists():
        _unpack(out, folder, identity)
    store = LibraryFolder(folder, identity, request.sets)
    with store.lock(), explain_interruption(folder):
        store = LibraryFolder(folder, identity, request.sets)  # as the last holder of the lock left it
        if folder != out and out.exists():
            _check_archive(out, folder, store.manifest)
        store.begin()
        missing = [sets for sets in request.sets if store.finished(sets) is None]
        if missing:
            _make(missing, store, seed, jobs, progress)
        store.record(request.refused)
        store.write_table()
        if folder != out:
            progress.advance("packing", 0)
            pack(folder, store.names(), out)
    if folder != out:
        folder.replace(_temporary(folder))  # at once: half a folder would be taken for a library
        shutil.rmtree(_temporary(folder), ignore_errors=True)
    found = len(request.sets) - len(missing)
    return MadeLibrary(store.manifest, out, len(missing), found, time.monotonic() - began)


def check_place(out: Path) -> None:
    """Refuse, before any work, a place where no library can be made."""
    if is_archive(out):
        if out.is_dir():
            raise InputError(f"{out} is a folder, and its name that of an archive; choose another with --out")
        if not out.parent.is_dir():
            raise InputError(f"{out} cannot be written: there is no folder {out.parent}; make it first")
    elif out.is_file():
        raise InputError(f"{out} is a file; a library is a folder, or a .zip, .tar.gz or .tar archive")


def working_folder(out: Path) -> Path:
    """Return the folder in which a library is made: itself, or that beside an archive."""
    return out.with_name(out.name + UNFINISHED) if is_archive(out) else out


def finished_files(request: LibraryRequest, out: Path) -> list[RequestedSets]:
    """List the files that a library has already, judged by its manifest alone.

    Parameters
    ----------
    request : LibraryRequest
        What is asked for.
    out : Path
        The folder or archive, which need not exist.

    Returns
    -------
    list of RequestedSets
    """
    there = next((path for path in (working_folder(out), out) if path.exists()), None)
    if there is None or not (there.is_file() or (there / MANIFEST).is_file()):
        return []
    with open_place(there) as place:
        manifest = manifest_of(place)
    entries = ((sets, manifest.entry(sets.text, sets.n, sets.d)) for sets in request.sets)
    return [sets for sets, entry in entries if entry is not None and entry.tried >= sets.realizations]


def _temporary(folder: Path) -> Path:
    """Return where the folder of an archive is unpacked to and deleted from."""
    return folder.with_name(f".{folder.name}.tmp")


def _check_archive(archive: Path, folder: Path, manifest: Manifest) -> None:
    """Refuse to replace an archive by a folder that lacks some of its sets: that of another library."""
    with open_place(archive) as place:
        packed = manifest_of(place)
    for sets in packed.files:
        entry = manifest.entry(sets.generator, sets.n, sets.d)
        if packed.seed != manifest.seed or entry is None or entry.tried < sets.tried:
            raise InputError(
                f"{archive} has sets of {sets.file} that {folder} lacks, the folder that a stopped command "
                "left and this one would go on with: rename or delete the one of the two that is not wanted"
            )


def _unpack(archive: Path, folder: Path, identity: dict[str, Any]) -> None:
    temporary = _temporary(folder)  # what a killed process left there is of no use
    shutil.rmtree(temporary, ignore_errors=True)
    try:
        with open_place(archive) as place:
            unpack(place, temporary, [SETTINGS])
        LibraryFolder(temporary, identity, ())
        temporary.replace(folder)
    except InputError as error:
        raise InputError(str(error).replace(str(temporary), str(archive))) from None
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _make(
    missing: Sequence[RequestedSets], store: LibraryFolder, seed: int, jobs: int, progress: Progress
) -> None:
    """Make files, the smallest sets first, so that a library is of use before it is finished.

    The files of one n are made together: their realizations are in memory until they are measured.
    """
    rounds = [list(group) for _, group in groupby(missing, key=lambda sets: sets.n)]
    tasks = [library_tasks(group, seed, jobs, store.keep) for group in rounds]
    every = [task for group in tasks for task in group]
    there = {task.label for task in every if not task.requires and store.piece_is_there(task.key)}
    costs = step_costs(every, missing)
    done = sum(costs[label] for label in there)
    shown = CostProgress(progress, {label: c for label, c in costs.items() if label not in there}, done)
    for group in tasks:
        run_tasks(group, store, jobs, shown)
