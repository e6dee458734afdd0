"""The folder of a comparison: its realizations, the results of its sources, and its tables."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench.analysis.outcomes import Arrays
from gbnbench.core import atomic_write
from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io import data_files
from gbnbench.runs import source_files
from gbnbench.runs.comparison_result import Run, SourceResult
from gbnbench.runs.comparison_tables import long_table, wide_table
from gbnbench.runs.file_sets import checksum
from gbnbench.runs.resumable_folder import FORMAT, MANIFEST, SETTINGS, ResumableFolder
from gbnbench.runs.task_keys import PIECE, realization_key

REPORT = "report.html"  # in the folder


@dataclass(frozen=True)
class Realization:
    """One generated realization.

    Attributes
    ----------
    x : (n, d) float64
        The points.
    cpu_seconds : float
        What they cost, one thread.
    first : bool
        Whether it was its worker's first with that generator, n and d, so that its cost may hold set-up.
    """

    x: FloatArray
    cpu_seconds: float
    first: bool


class ComparisonFolder(ResumableFolder):
    """One comparison on disk, and the store of its tasks.

    Notes
    -----
    A task whose key is a source's, such as ``gbn_n64_d2``, results in a SourceResult; one whose key is that
    of a realization, such as ``gbn_n64_d2/000003``, in a Realization; one whose key is that of a piece, such
    as ``gbn_n64_d2/measured-000016``, in arrays.
    """

    kind = "run"

    def read(self, key: str) -> SourceResult | Realization | Arrays | None:
        """Return what is kept under a task's key; None where it has still to be made."""
        source, _, number = key.partition("/")
        if number.startswith(PIECE):
            try:
                return data_files.read_or_explain(self._part(key), data_files.read_npz)
            except FormatError:  # absent, or spoilt after it was written: measured again
                return None
        return self.read_realization(source, int(number)) if number else self.read_source(source)

    def write(self, key: str, result: SourceResult | Realization | Arrays) -> None:
        """Keep the result of a task.

        Parameters
        ----------
        key : str
            The task's.
        result : SourceResult, Realization or mapping of arrays
            What it made.
        """
        if isinstance(result, SourceResult):
            self.write_source(result)
        elif isinstance(result, Realization):
            source, _, number = key.partition("/")
            self.write_realization(source, int(number), result)
        else:
            atomic_write.write_whole(self._part(key), data_files.to_npz(**result))

    def write_realization(self, source: str, k: int, realization: Realization) -> None:
        """Keep a realization.

        Parameters
        ----------
        source : str
            The key of its source.
        k : int
            Its number.
        realization : Realization
            The points and what they cost.
        """
        cost = {"cpu_seconds": np.asarray(realization.cpu_seconds), "first": np.asarray(realization.first)}
        content = data_files.to_npz(points=realization.x, **cost)
        atomic_write.write_whole(self._realization(source, k), content)

    def read_realization(self, source: str, k: int) -> Realization | None:
        """Return realization k of a source; None where it has still to be made.

        Parameters
        ----------
        source : str
            The key of the source.
        k : int
            The number of the realization.

        Returns
        -------
        Realization or None
        """
        try:
            arrays = data_files.read_or_explain(self._realization(source, k), data_files.read_npz)
            return Realization(arrays["points"], float(arrays["cpu_seconds"]), bool(arrays["first"]))
        except (FormatError, KeyError):  # absent, or spoilt after it was written: made again
            return None

    def write_source(self, result: SourceResult) -> None:
        """Keep everything of one source; the files of its realizations are then no longer needed."""
        atomic_write.write_folder_whole(self.path / "sources" / result.key, source_files.encode(result))
        shutil.rmtree(self.path / "parts" / result.key, ignore_errors=True)

    def read_source(self, key: str) -> SourceResult | None:
        """Return everything of one source; None where it has still to be measured."""
        try:
            return source_files.decode(self.path / "sources" / key)
        except FormatError:
            return None

    def write_tables(self, run: Run, *, missing: bool = False) -> None:
        """Write ``measures.csv`` (a row a source and measure) and ``table.csv`` (a row a source).

        Parameters
        ----------
        run : Run
            Whose tables they are.
        missing : bool
            Write only a table that is not there: one that the user has edited stays as it is.
        """
        import pandas as pd

        for name, rows in (("measures.csv", long_table), ("table.csv", wide_table)):
            if not (missing and (self.path / name).is_file()):
                content = data_files.to_csv(pd.DataFrame(rows(run)))
                atomic_write.write_whole(self.path / name, content)

    def finish(self, manifest: Mapping[str, Any]) -> None:
        """Declare it whole: checksums of the data, and the manifest as the very last file."""
        self.drop("parts")
        data = sorted((self.path / "sources").rglob("*.*"))
        sums = {p.relative_to(self.path).as_posix(): checksum(p) for p in data if p.is_file()}
        super().finish({**manifest, "sha256": sums})

    def _realization(self, source: str, k: int) -> Path:
        return self._part(realization_key(source, k))

    def _part(self, key: str) -> Path:
        return self.path / "parts" / f"{key}.npz"


def default_folder(identity: Mapping[str, Any], command: str = "") -> Path:
    """Name a folder by its settings, so that the same command finds the same one.

    Parameters
    ----------
    identity : mapping
        The settings, with ``sources`` among them.
    command : str
        A word that the name begins with.

    Returns
    -------
    Path
    """
    sources = identity["sources"]
    labels = dict.fromkeys(source["label"].lower() for source in sources)
    words = "-".join(re.sub(r"[^a-z0-9]+", "-", label).strip("-") for label in labels)
    sizes = "-".join(dict.fromkeys(f"n{s['n']}" for s in sources))
    stamp = hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()[:8]
    first = f"{command}_" if command else ""
    return Path("runs") / f"{first}{words[:48].strip('-')}_{sizes[:24].strip('-')}_{stamp}"


def read_run(folder: str | Path) -> Run:
    """Read a finished run.

    Parameters
    ----------
    folder : path
        As written by ``gbnbench compare``.

    Raises
    ------
    InputError
        If it is no run or an unfinished one.
    FormatError
        If a file in it is missing or was changed.
    """
    path = Path(folder)
    if not (path / MANIFEST).is_file():
        if (path / SETTINGS).is_file():
            raise InputError(f"{path} is an unfinished run; the same gbnbench compare command finishes it")
        lack = f"it has no {MANIFEST}" if path.is_dir() else "there is no such folder"
        raise InputError(f"{path} is not a run of gbnbench: {lack}")
    manifest = data_files.read_json(path / MANIFEST)
    if manifest.get("format") != FORMAT:
        found = manifest.get("format")
        raise FormatError(path / MANIFEST, f"has format {found!r}; this version reads {FORMAT}")
    try:
        sums = dict(manifest.pop("sha256"))
        del manifest["format"]  # both speak of the files, not of the run
        keys = [str(source["key"]) for source in manifest["settings"]["sources"]]
        verdicts = {(v["source"], v["measure"]): v["verdict"] for v in manifest["verdicts"]}
    except (KeyError, TypeError, ValueError) as error:
        raise FormatError(path / MANIFEST, f"is not what gbnbench wrote ({error!r})") from None
    way_out = f"put it back as it was, or delete the folder {path} and make the run again"
    for name, expected in sums.items():
        if not (path / name).is_file():
            raise FormatError(path / name, f"is missing from the run: {way_out}")
        if checksum(path / name) != expected:
            raise FormatError(path / name, f"was changed after the run was written: {way_out}")
    return Run(manifest, tuple(source_files.decode(path / "sources" / key) for key in keys), verdicts)
