"""A report that is written while sources are still being measured, at little cost."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

from gbnbench.core.atomic_write import write_whole
from gbnbench.runs.comparison_folder import REPORT, ComparisonFolder
from gbnbench.runs.comparison_result import Run, SourceResult

FIRST = 60.0  # seconds before the first is written: short runs have the whole report soon enough
SHARE = 0.05  # of the time that may go into writing reports of what is there so far
RELOAD = 30  # seconds after which a page that is not whole reads itself again
START, END = "<!--reloads-->", "<!--/reloads-->"  # around all that makes a page do so


@dataclass(frozen=True)
class Unfinished:
    """What a run still lacks.

    Attributes
    ----------
    measured, total : int
        Sources measured, of how many.
    waiting : tuple of str
        Labels of the others.
    when : str
        Time of day.
    """

    measured: int
    total: int
    waiting: tuple[str, ...]
    when: str


class GrowingReport:
    """The folder of a comparison as the store of its tasks, whose report grows as sources are measured.

    Parameters
    ----------
    folder : ComparisonFolder
        Where results are kept.
    labels : mapping of str
        Labels of all sources by key, in order.
    manifest : mapping
        What is known of the run so far.
    draw : callable
        ``draw(run, folder, unfinished)`` writes the report. Where it fails, the run goes on without.

    Notes
    -----
    Used as a context manager: in the end, also where the run was stopped, the page reloads itself no more.
    """

    def __init__(
        self,
        folder: ComparisonFolder,
        labels: Mapping[str, str],
        manifest: Mapping[str, Any],
        draw: Callable[[Run, Path, Unfinished], None],
    ) -> None:
        self._folder, self._labels, self._manifest, self._draw = folder, labels, manifest, draw
        self._due = time.monotonic() + FIRST

    def __enter__(self) -> GrowingReport:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        stop_reloading(self.path / REPORT)

    @property
    def path(self) -> Path:
        """Where the results are."""
        return self._folder.path

    def read(self, key: str) -> Any | None:
        """Return what is kept under a task's key; None where it has still to be made."""
        return self._folder.read(key)

    def write(self, key: str, result: Any) -> None:
        """Keep the result of a task, and write the report where a source was measured and it is time to.

        Parameters
        ----------
        key : str
            The task's.
        result : object
            What it made.
        """
        self._folder.write(key, result)
        if isinstance(result, SourceResult) and time.monotonic() >= self._due:
            self._grow()

    def _grow(self) -> None:
        found = {key: self._folder.read_source(key) for key in self._labels}
        measured = tuple(source for source in found.values() if source is not None)
        if len(measured) == len(found):
            return  # the whole report is next
        began = time.monotonic()
        waiting = tuple(self._labels[key] for key, source in found.items() if source is None)
        unfinished = Unfinished(len(measured), len(found), waiting, time.strftime("%H:%M:%S"))
        try:
            self._draw(Run(self._manifest, measured), self.path, unfinished)
        except Exception:  # the same fault comes again with the whole report, and is told then
            self._due = float("inf")
            return
        ended = time.monotonic()
        self._due = ended + (ended - began) / SHARE


def stop_reloading(path: Path) -> None:
    """Take from a page all that makes it read itself again; one that does not is left as it is.

    Parameters
    ----------
    path : Path
        The page; it may be missing.
    """
    try:
        text = path.read_text(encoding="utf-8")
        if START in text:
            still = re.sub(f"{START}.*?{END}", "", text, flags=re.DOTALL)
            write_whole(path, still.encode("utf-8"))
    except (OSError, UnicodeDecodeError):  # gone, or no page of ours: what ends the run is told, not this
        return
