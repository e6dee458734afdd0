"""Progress of a long command: a live bar on a terminal, elsewhere a line now and then."""

from __future__ import annotations

import os
import sys
import time
from types import TracebackType
from typing import Self

QUIET_SECONDS = 10.0  # between plain lines
PLAIN_TERMINALS = ("dumb", "unknown")  # values of TERM: they know neither colours nor moving the cursor


class Progress:
    """Say nothing: the base of the two that speak, and what ``--quiet`` uses.

    A progress is a context; ``start`` comes first, then any number of ``advance``.

    Attributes
    ----------
    percent : bool
        Whether steps are equal parts of all work, not things that can be counted: a share is shown then.
    """

    percent = False

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave nothing on the terminal."""

    def say(self, text: str) -> None:
        """Print one line beside the progress."""

    def start(self, total: int, done: int, doing: str) -> None:
        """Begin counting steps, of which some are done already.

        Parameters
        ----------
        total : int
            Steps in all.
        done : int
            Steps that are finished already.
        doing : str
            What is being done now.
        """

    def advance(self, doing: str, steps: int = 1) -> None:
        """Count steps and name what is being done now.

        Parameters
        ----------
        doing : str
            What is being done now.
        steps : int
            Steps finished since the last call.
        """


class Lines(Progress):
    """Plain lines on standard error, at most one in ten seconds, for logs and pipes."""

    def __init__(self) -> None:
        self._total = self._done = self._before = 0
        self._began = self._spoke = time.monotonic()

    def say(self, text: str) -> None:
        """Print one line."""
        print(text, file=sys.stderr, flush=True)

    def start(self, total: int, done: int, doing: str) -> None:
        """Begin counting and say what is first.

        Parameters
        ----------
        total : int
            Steps in all.
        done : int
            Steps that are finished already.
        doing : str
            What is being done now.
        """
        self._total, self._done, self._before = total, done, done
        self._began = self._spoke = time.monotonic()
        self.say(f"{self._count()} {doing}")

    def advance(self, doing: str, steps: int = 1) -> None:
        """Count, and print when the last line is old enough.

        Parameters
        ----------
        doing : str
            What is being done now.
        steps : int
            Steps finished since the last call.
        """
        self._done += steps
        now = time.monotonic()
        if now - self._spoke < QUIET_SECONDS and (steps == 0 or self._done < self._total):
            return
        self._spoke = now
        elapsed = now - self._began
        fresh, ahead = self._done - self._before, self._total - self._done
        left = f", about {elapsed * ahead / fresh:.0f} s left" if fresh and ahead else ""
        self.say(f"{self._count()} {doing} ({elapsed:.0f} s{left})")

    def _count(self) -> str:
        if self.percent:
            return f"{100 * self._done / max(1, self._total):.0f}%"
        return f"{self._done}/{self._total}"


class Live(Progress):
    """One bar on standard error with what is being done, elapsed and remaining time."""

    def __init__(self) -> None:
        from rich.console import Console
        from rich.progress import Progress as Bar

        from gbnbench.execution.bar_columns import Count, Doing, Times, bar_column

        self._count = Count()
        self._bar: Bar = Bar(
            bar_column(), self._count, Times(), Doing(), console=Console(stderr=True), transient=True
        )
        self._task = self._bar.add_task("starting", total=None)

    def __enter__(self) -> Self:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Take the bar off the terminal."""
        self._bar.stop()

    def say(self, text: str) -> None:
        """Print one line above the bar."""
        self._bar.console.print(text, markup=False, highlight=False)

    def start(self, total: int, done: int, doing: str) -> None:
        """Show the bar with what is done already.

        Parameters
        ----------
        total : int
            Steps in all.
        done : int
            Steps that are finished already.
        doing : str
            What is being done now.
        """
        self._count.percent = self.percent
        self._bar.reset(self._task, total=total, completed=done, description=doing)

    def advance(self, doing: str, steps: int = 1) -> None:
        """Move the bar.

        Parameters
        ----------
        doing : str
            What is being done now.
        steps : int
            Steps finished since the last call.
        """
        self._bar.update(self._task, advance=steps, description=doing)


def choose(quiet: bool) -> Progress:
    """Pick by where standard error goes."""
    if quiet:
        return Progress()
    moving = sys.stderr.isatty() and os.environ.get("TERM") not in PLAIN_TERMINALS
    return Live() if moving else Lines()
