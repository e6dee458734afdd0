"""The record of a folder of stipplings: which file was drawn from what, so that none is drawn twice."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from gbnbench.core import atomic_write
from gbnbench.core.errors import FormatError
from gbnbench.io import data_files
from gbnbench.io.folder_lock import FolderLock
from gbnbench.runs.file_sets import checksum

FOLDER, RECORD = ".gbnbench", "stippled.json"


@dataclass(frozen=True)
class StippledFile:
    """A file that a worker drew.

    Attributes
    ----------
    data : bytes
        Its content.
    said : str
        What it shows, in a line.
    remarks : tuple of str
        What was done to read the image that might surprise.
    """

    data: bytes
    said: str
    remarks: tuple[str, ...] = ()


class StippledFolder:
    """A folder of stipplings as a store of results by the names of its files.

    Parameters
    ----------
    path : Path
        Must exist. The record is ``.gbnbench/stippled.json`` in it.

    Attributes
    ----------
    written : set of str
        Files that this process wrote.

    Notes
    -----
    Used as a context manager, which keeps other processes off.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.written: set[str] = set()
        self._wanted: dict[str, str] = {}
        (path / FOLDER).mkdir(exist_ok=True)
        self._lock = FolderLock(path / FOLDER)
        self._record: dict[str, dict[str, str]] = {}

    def __enter__(self) -> Self:
        """Lock the folder and read its record; one that is damaged is none."""
        self._lock.__enter__()
        try:
            self._record = dict(data_files.read_json(self.path / FOLDER / RECORD)["files"])
        except (FormatError, KeyError, TypeError):
            self._record = {}
        return self

    def __exit__(self, *exception: object) -> None:
        """Give the lock back."""
        self._lock.__exit__(*exception)

    def expect(self, key: str, request: str) -> None:
        """Tell what decides the content of a file.

        Parameters
        ----------
        key : str
            Name of the file.
        request : str
            A sum of the image and of all options.
        """
        self._wanted[key] = request

    def said(self, key: str) -> str | None:
        """Say what a file of this request shows; None where it is not there."""
        held = self._record.get(key, {})
        return held.get("said") if held.get("request") == self._wanted.get(key, "") else None

    def read(self, key: str) -> StippledFile | None:
        """Return a file that was drawn from the same; None where it is absent or was changed."""
        held, file = self._record.get(key, {}), self.path / key
        if held.get("request") != self._wanted[key] or not file.is_file():
            return None
        return StippledFile(b"", held.get("said", "")) if held.get("sha256") == checksum(file) else None

    def write(self, key: str, result: StippledFile) -> None:
        """Write a file, and then its line of the record.

        Parameters
        ----------
        key : str
            Name of the file.
        result : StippledFile
            Its content.
        """
        atomic_write.write_whole(self.path / key, result.data)
        self._record[key] = {
            "request": self._wanted[key],
            "sha256": hashlib.sha256(result.data).hexdigest(),
            "said": result.said,
        }
        record = {"files": dict(sorted(self._record.items()))}
        atomic_write.write_whole(self.path / FOLDER / RECORD, data_files.to_json(record))
        self.written.add(key)
