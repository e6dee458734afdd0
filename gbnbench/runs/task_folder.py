"""A resumable folder that keeps the results of tasks, arrays by name, as .npz files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from numpy.typing import NDArray

from gbnbench.core import atomic_write
from gbnbench.core.errors import FormatError
from gbnbench.io import data_files
from gbnbench.runs.resumable_folder import ResumableFolder

FOLDER = "pieces"
Arrays = Mapping[str, NDArray[Any]]


class TaskFolder(ResumableFolder):
    """A folder that keeps the result of a task as ``pieces/KEY.npz``."""

    def write(self, key: str, result: Arrays) -> None:
        """Keep the arrays of a task.

        Parameters
        ----------
        key : str
            The task's.
        result : mapping of str to array
            What it made.
        """
        atomic_write.write_whole(self.path / FOLDER / f"{key}.npz", data_files.to_npz(**result))

    def read(self, key: str) -> dict[str, NDArray[Any]] | None:
        """Return the arrays of a task; None where they are absent, or spoilt and to be made again."""
        try:
            return data_files.read_or_explain(self.path / FOLDER / f"{key}.npz", data_files.read_npz)
        except FormatError:
            return None
