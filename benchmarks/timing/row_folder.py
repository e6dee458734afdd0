"""A resumable folder that keeps rows of a table, those of each task in a file of their own."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from gbnbench.benchmarks.timing.machine import Row
from gbnbench.core import atomic_write
from gbnbench.core.errors import FormatError
from gbnbench.io import data_files
from gbnbench.runs.resumable_folder import ResumableFolder

FOLDER = "rows"
Measured = Mapping[str, Any]  # "rows", a list of Row, and "machine", as ``describe`` returns it


class RowFolder(ResumableFolder):
    """A folder that keeps what a task measured as ``rows/KEY.json``."""

    kind = "folder of measured rows"

    def read(self, key: str) -> Measured | None:
        """Return what a task measured; None where it is absent, or spoilt and to be measured again."""
        try:
            kept = data_files.read_json(self.path / FOLDER / f"{key}.json")
            return {"machine": kept["machine"], "rows": [_numbers(row) for row in kept["rows"]]}
        except (FormatError, KeyError):
            return None

    def write(self, key: str, result: Measured) -> None:
        """Keep what a task measured.

        Parameters
        ----------
        key : str
            The task's.
        result : mapping
            Its rows and its machine.
        """
        content = {"machine": result["machine"], "rows": _cells(result["rows"])}
        atomic_write.write_whole(self.path / FOLDER / f"{key}.json", data_files.to_json(content))


def _cells(rows: Sequence[Row]) -> list[Row]:
    """Write what is no number as JSON can: null."""
    return [
        {name: None if isinstance(cell, float) and math.isnan(cell) else cell for name, cell in row.items()}
        for row in rows
    ]


def _numbers(row: Row) -> Row:
    return {name: math.nan if cell is None else cell for name, cell in row.items()}
