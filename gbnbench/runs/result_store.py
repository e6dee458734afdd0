"""The protocol of places that keep the results of tasks, such as a folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol


class ResultStore(Protocol):
    """A place that keeps the results of tasks by their keys."""

    @property
    def path(self) -> Path:
        """Where it is, for messages."""
        ...

    def read(self, key: str) -> Any | None:
        """Return the result of a task; None where it is absent, or was spoilt and has to be made again."""

    def write(self, key: str, result: Any) -> None:
        """Keep the result of a task.

        Parameters
        ----------
        key : str
            The task's.
        result : object
            What it made.
        """
