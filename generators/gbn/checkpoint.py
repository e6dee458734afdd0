"""The state of a long run in a file, so that a run that was killed goes on to the same result."""

from __future__ import annotations

import io
import time
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError

KEY = "run"  # the array that says whose state it is


class Checkpoint:
    """A file that holds the latest state of one run, whole or absent.

    Parameters
    ----------
    path : Path
        The file, a numpy archive.
    key : str
        Everything that the run's result depends on, as text.
    seconds : float
        Least time between two writings.
    """

    def __init__(self, path: Path, key: str, seconds: float) -> None:
        self._path, self._key, self._seconds = path, key, seconds
        self._written = time.monotonic()

    def load(self) -> dict[str, NDArray[Any]] | None:
        """Return the state last written, None where there is none.

        Raises
        ------
        InputError
            If the file is no checkpoint, or one of another run.
        """
        if not self._path.exists():
            return None
        try:
            with np.load(self._path, allow_pickle=False) as archive:
                state = {name: archive[name] for name in archive.files}
            key = str(state.pop(KEY))
        except (OSError, ValueError, TypeError, KeyError, EOFError, zipfile.BadZipFile):
            raise InputError(
                f"{self._path} is no checkpoint of gbnbench; give another name, or delete it"
            ) from None
        if key != self._key:
            raise InputError(
                f"{self._path} is the checkpoint of another run, {key}; this one is {self._key}. Repeat that "
                "command, give another name, or delete the file"
            )
        return state

    @property
    def due(self) -> bool:
        """True once the last writing is old enough for another."""
        return time.monotonic() - self._written >= self._seconds

    def save(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Write the state."""
        file = io.BytesIO()
        arrays: dict[str, Any] = {KEY: np.array(self._key), **state}
        np.savez(file, **arrays)
        write_whole(self._path, file.getvalue())
        self._written = time.monotonic()
