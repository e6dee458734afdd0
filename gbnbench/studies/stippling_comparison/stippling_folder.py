"""The folder of a comparison of stipplings: its density, a file a set, its tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from gbnbench.core import atomic_write
from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io import data_files
from gbnbench.runs.resumable_folder import MANIFEST, SETTINGS
from gbnbench.runs.task_folder import Arrays, TaskFolder
from gbnbench.studies.stippling_comparison.flat_patch import FlatPatch
from gbnbench.studies.stippling_comparison.stippling_results import (
    StipplingRun,
    gathered,
    spectra_table,
    wide_table,
)

DENSITY = "density.npz"


class StipplingFolder(TaskFolder):
    """A comparison of stipplings on disk."""

    kind = "comparison of stipplings"

    def write_tables(self, run: StipplingRun) -> None:
        """Write the density, ``table.csv`` (a row a source) and ``spectra.csv`` (a row an annulus)."""
        import pandas as pd

        atomic_write.write_whole(self.path / DENSITY, data_files.to_npz(density=run.density))
        for name, rows in (("table.csv", wide_table(run)), ("spectra.csv", spectra_table(run))):
            atomic_write.write_whole(self.path / name, data_files.to_csv(pd.DataFrame(rows)))


def set_key(source: str, k: int) -> str:
    """Name the task of set k of a source.

    Parameters
    ----------
    source : str
        The source's key.
    k : int
        The set's number.

    Returns
    -------
    str
    """
    return f"{source}/{k:06d}"


def is_stippling_run(folder: str | Path) -> bool:
    """Whether a folder is a comparison of stipplings, finished or not."""
    settings = Path(folder) / SETTINGS
    return settings.is_file() and "density" in data_files.read_json(settings)


def read_stippling_run(folder: str | Path) -> StipplingRun:
    """Read a finished comparison of stipplings.

    Parameters
    ----------
    folder : path
        As ``gbnbench compare --density`` wrote it.

    Returns
    -------
    StipplingRun

    Raises
    ------
    InputError
        If it is none, or an unfinished one.
    FormatError
        If a file in it is missing or is not what was written.
    """
    path = Path(folder)
    if not (path / MANIFEST).is_file():
        state = "an unfinished" if (path / SETTINGS).is_file() else "no"
        raise InputError(f"{path} is {state} comparison of stipplings: it has no {MANIFEST}")
    manifest = data_files.read_json(path / MANIFEST)
    if "density" not in manifest.get("settings", {}):
        raise FormatError(path / MANIFEST, "is not of a comparison of stipplings")
    store = StipplingFolder(path, data_files.read_json(path / SETTINGS))
    density = data_files.read_or_explain(path / DENSITY, data_files.read_npz)["density"]
    sources = manifest["settings"]["sources"]
    found: dict[str, Sequence[Arrays]] = {}
    for source in sources:
        pieces = [store.read(set_key(source["key"], k)) for k in range(source["realizations"])]
        whole = [piece for piece in pieces if piece is not None]
        if len(whole) < len(pieces):
            raise FormatError(path, f"sets of {source['label']} are missing or were changed")
        found[source["key"]] = whole
    return assembled(manifest, density, found)


def assembled(
    manifest: Mapping[str, Any],
    density: FloatArray,
    found: Mapping[str, Sequence[Arrays]],
    failures: Sequence[str] = (),
) -> StipplingRun:
    """Put the results of all sources together.

    Parameters
    ----------
    manifest : mapping
        With the settings.
    density : (rows, columns) float64
        The density.
    found : mapping of str to sequence of mapping
        The sets of each source that is whole, by its key.
    failures : sequence of str
        What went wrong with the others.

    Returns
    -------
    StipplingRun
    """
    settings = manifest["settings"]
    results = [
        gathered(source["key"], source["label"], found[source["key"]])
        for source in settings["sources"]
        if source["key"] in found
    ]
    patch = None if settings["patch"] is None else FlatPatch(**settings["patch"])
    return StipplingRun(manifest, density, patch, tuple(results), tuple(failures))
