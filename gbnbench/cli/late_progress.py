"""Progress of one long draw, which begins to show when a second has passed and another is to come."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator

PATIENCE = 1.0  # seconds that have passed and are to come where progress is shown


@contextlib.contextmanager
def late_progress(quiet: bool) -> Iterator[Callable[[int, int, str], None]]:
    """Give a function that is told of steps.

    Parameters
    ----------
    quiet : bool
        Show nothing.

    Yields
    ------
    callable
        Takes (steps done, steps in all, what is being done).
    """
    from gbnbench.execution import progress

    began = time.monotonic()
    with contextlib.ExitStack() as stack:
        shown: progress.Progress | None = None
        counted = 0

        def tell(done: int, total: int, doing: str) -> None:
            nonlocal shown, counted
            if shown is not None:
                shown.advance(doing, done - counted)
            elif (spent := time.monotonic() - began) >= PATIENCE and spent * (
                total - done
            ) >= PATIENCE * done:
                shown = stack.enter_context(progress.choose(quiet))
                shown.start(total, done, doing)
            counted = done

        yield tell


@contextlib.contextmanager
def stages(quiet: bool) -> Iterator[Callable[[int, int, str], None]]:
    """Give a function that is told of the steps of several works, one after the other, each in its own count.

    Parameters
    ----------
    quiet : bool
        Show nothing.

    Yields
    ------
    callable
        Takes (steps done, steps in all, what is being done), as ``late_progress`` does; another total, or
        steps that begin anew, are another work.
    """
    with contextlib.ExitStack() as stack:
        tell: Callable[[int, int, str], None] | None = None
        last = (0, 0)

        def told(done: int, total: int, doing: str) -> None:
            nonlocal tell, last
            if tell is None or total != last[1] or done < last[0]:
                stack.close()
                tell = stack.enter_context(late_progress(quiet))
            tell(done, total, doing)
            last = done, total

        yield told
