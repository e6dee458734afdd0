"""A CSV table as a store of results: each task has rows in it, which stand in the order of the tasks."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from gbnbench.core.atomic_write import write_whole

Cells = dict[str, str]


class TableStore:
    """A table that is written whole after every task, so that it is the same whoever finishes first.

    Parameters
    ----------
    path : Path
        Of the table; it need not exist.
    columns : sequence of str
        Its header.
    key_of : callable
        Key of the task that a row, as text, belongs to.
    order : sequence of str
        Keys of the tasks, in the order of their rows; rows of others that are there already come last.
    digits : int
        Of floats.
    missing : str
        What stands for nan.
    """

    def __init__(
        self,
        path: Path,
        columns: Sequence[str],
        key_of: Callable[[Mapping[str, str]], str],
        order: Sequence[str],
        digits: int = 4,
        missing: str = "",
    ) -> None:
        self.path, self._columns, self._order = path, columns, order
        self._digits, self._missing = digits, missing
        self._rows: dict[str, list[Cells]] = {}
        if path.exists():
            with path.open(newline="", encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    self._rows.setdefault(key_of(row), []).append(row)

    def read(self, key: str) -> list[Cells] | None:
        """Return the rows of a task; None where it has still to be done."""
        return self._rows.get(key)

    def write(self, key: str, result: Sequence[Mapping[str, Any]]) -> None:
        """Keep the rows of a task.

        Parameters
        ----------
        key : str
            The task's.
        result : sequence of mapping
            Rows, by column.
        """
        self._rows[key] = [{name: self._cell(row[name]) for name in self._columns} for row in result]
        text = io.StringIO()
        writer: csv.DictWriter[str] = csv.DictWriter(text, self._columns, lineterminator="\n")
        writer.writeheader()
        for known in dict.fromkeys([*self._order, *self._rows]):
            writer.writerows(self._rows.get(known, []))
        write_whole(self.path, text.getvalue().encode())

    def _cell(self, value: Any) -> str:
        if isinstance(value, float):
            return self._missing if math.isnan(value) else f"{value:.{self._digits}g}"
        return str(value)
