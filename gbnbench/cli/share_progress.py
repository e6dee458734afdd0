"""Progress of work that tells which share of it is done."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from gbnbench.execution import progress

PATIENCE = 1.0  # seconds before progress is shown


def worth_showing(elapsed: float, share: float) -> bool:
    """Whether work has lasted a while and will last as long again, so that a bar does not just flash.

    Parameters
    ----------
    elapsed : float
        Seconds that it has lasted.
    share : float
        The share done, from 0 to 1.

    Returns
    -------
    bool
    """
    return elapsed > PATIENCE and elapsed * (1 - share) >= PATIENCE * share


@contextmanager
def share_bar(total: int, doing: str, quiet: bool) -> Iterator[Callable[[float], None]]:
    """Show the share done of some work, once it has lasted a while.

    Parameters
    ----------
    total : int
        How many steps are shown for all of it.
    doing : str
        What these are, such as "frequencies".
    quiet : bool
        Show nothing.

    Yields
    ------
    callable
        Takes the share done, from 0 to 1.
    """
    began, shown = time.monotonic(), 0
    with ExitStack() as stack:
        bar: progress.Progress | None = None

        def tell(share: float) -> None:
            nonlocal bar, shown
            done = int(share * total)
            if bar is not None:
                bar.advance(doing, done - shown)
            elif worth_showing(time.monotonic() - began, share):
                bar = stack.enter_context(progress.choose(quiet))
                bar.start(total, done, doing)
            shown = done

        yield tell
