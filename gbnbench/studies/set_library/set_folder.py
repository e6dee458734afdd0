"""The folder in which a library is made: finished files, their manifest, realizations of the others."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core import atomic_write
from gbnbench.core.errors import FormatError
from gbnbench.core.results.measures import Measures
from gbnbench.io import data_files
from gbnbench.io.set_library.entries import ReadySets, RefusedSets
from gbnbench.io.set_library.manifest import MANIFEST, TABLE, Manifest
from gbnbench.io.set_library.places import Folder, manifest_of
from gbnbench.io.set_library.set_file import content, encoded
from gbnbench.runs.comparison_folder import Realization
from gbnbench.runs.provenance import versions
from gbnbench.runs.resumable_folder import SETTINGS, ResumableFolder
from gbnbench.runs.task_folder import FOLDER
from gbnbench.studies.set_library.draws import Draw, MeasuredSets, RefusedDraw
from gbnbench.studies.set_library.request import RequestedSets
from gbnbench.studies.timed_draw import mean_cost

Entry = ReadySets | RefusedSets


class LibraryFolder(ResumableFolder):
    """A library on disk, and the store of the tasks that make it.

    Parameters
    ----------
    path : Path
        Need not exist.
    identity : mapping
        Version, seed and device, which decide every number in it. What was asked for is no part of it, so
        that a library can be made in parts.
    requested : sequence of RequestedSets
        The files that are to be made.

    Notes
    -----
    A file is written first, then the manifest that names it, and only then its realizations are deleted, so
    that a file which the manifest names is whole whatever stops the process.
    """

    kind = "library"

    def __init__(self, path: Path, identity: Mapping[str, Any], requested: Sequence[RequestedSets]) -> None:
        super().__init__(path, identity)
        self._requested = {sets.key: sets for sets in requested}
        self.manifest = Manifest(identity["gbnbench"], identity["seed"], identity["device"])
        if (path / MANIFEST).is_file():
            self.manifest = manifest_of(Folder(path))

    def begin(self) -> None:
        """Open it for work, under the lock; the manifest stays, since it names finished files only."""
        self._check()
        atomic_write.remove_leftovers(self.path)
        atomic_write.write_whole(self.path / SETTINGS, data_files.to_json(self.identity))
        self.manifest = replace(self.manifest, versions=versions())

    def finished(self, sets: RequestedSets) -> Entry | None:
        """Return the entry of a file that is there and whole, or was refused; None where it has to be made.

        Parameters
        ----------
        sets : RequestedSets
            Of the file; one of more realizations serves as well.
        """
        entry = self.manifest.entry(sets.text, sets.n, sets.d)
        if entry is None or entry.tried < sets.realizations:
            return None
        if isinstance(entry, ReadySets):
            try:
                content(Folder(self.path), entry)
            except FormatError:  # absent, or spoilt after it was written: made again
                return None
        return entry

    def read(self, key: str) -> Entry | Draw | None:
        """Return what is kept under a task's key; None where it has still to be made."""
        if key in self._requested:
            return self.finished(self._requested[key])
        try:
            arrays = data_files.read_or_explain(self._piece(key), data_files.read_npz)
            if "refusal" in arrays:
                return RefusedDraw(str(arrays["refusal"]))
            return Realization(arrays["points"], float(arrays["cpu_seconds"]), bool(arrays["first"]))
        except (FormatError, KeyError):
            return None

    def piece_is_there(self, key: str) -> bool:
        """Return whether a realization is kept, by its file alone."""
        return self._piece(key).is_file()

    def write(self, key: str, result: Entry | Draw) -> None:
        """Keep the result of a task.

        Parameters
        ----------
        key : str
            The task's.
        result : ReadySets, RefusedSets, Realization or RefusedDraw
            What it made.
        """
        if isinstance(result, (ReadySets, RefusedSets)):
            self.record([result])
            self.drop(f"{FOLDER}/{key}")
            return
        arrays: dict[str, NDArray[Any]]
        if isinstance(result, RefusedDraw):
            arrays = {"refusal": np.asarray(result.reason)}
        else:
            cost = {"cpu_seconds": np.asarray(result.cpu_seconds), "first": np.asarray(result.first)}
            arrays = {"points": result.x, **cost}
        atomic_write.write_whole(self._piece(key), data_files.to_npz(**arrays))

    def keep(self, sets: RequestedSets, measured: MeasuredSets, draws: Sequence[Draw]) -> Entry:
        """Write the sets of a file.

        Parameters
        ----------
        sets : RequestedSets
            Of the file.
        measured : MeasuredSets
            What was measured of them.
        draws : sequence of Realization or RefusedDraw
            One a stream, in their order.

        Returns
        -------
        ReadySets or RefusedSets
            Its entry for the manifest.
        """
        made = {k: draw for k, draw in enumerate(draws) if isinstance(draw, Realization)}
        refused = {str(k): draw.reason for k, draw in enumerate(draws) if isinstance(draw, RefusedDraw)}
        if not made or measured.measures is None:
            return RefusedSets(sets.text, sets.n, sets.d, refused["0"], len(draws))
        data = encoded(np.stack([draw.x for draw in made.values()]))
        atomic_write.write_whole(self.path / sets.file, data)
        costs = [draw.cpu_seconds for draw in made.values()], [draw.first for draw in made.values()]
        return ReadySets(
            file=sets.file,
            generator=sets.text,
            settings=sets.settings,
            n=sets.n,
            d=sets.d,
            realizations=tuple(made),
            refused=refused,
            cpu_seconds=float(f"{mean_cost(*costs):.3g}"),
            measuring_cpu_seconds=float(f"{measured.cpu_seconds:.3g}"),
            measures=_finite(measured.measures),
            standard_errors=_finite(measured.measures.standard_error),
            undefined=dict(measured.measures.reasons),
            sha256=hashlib.sha256(data).hexdigest(),
        )

    def record(self, entries: Iterable[Entry]) -> None:
        """Name files, and what was refused, in the manifest, in place of what it said of the same before."""
        self.manifest = self.manifest.with_entries(entries)
        atomic_write.write_whole(self.path / MANIFEST, data_files.to_json(self.manifest.record()))

    def write_table(self) -> None:
        """Write the manifest as ``manifest.csv``, and drop the folder of realizations where it is empty."""
        atomic_write.write_whole(self.path / TABLE, data_files.to_csv(self.manifest.to_frame()))
        if not any(path.is_file() for path in (self.path / FOLDER).rglob("*")):
            self.drop(FOLDER)

    def names(self) -> list[str]:
        """List the files of the finished library, the manifest first, as an archive has them."""
        return [MANIFEST, TABLE, SETTINGS, *(entry.file for entry in self.manifest.files)]

    def _piece(self, key: str) -> Path:
        return self.path / FOLDER / f"{key}.npz"


def _finite(values: Mapping[str, float] | Measures) -> dict[str, float]:
    return {name: float(value) for name, value in values.items() if math.isfinite(value)}
