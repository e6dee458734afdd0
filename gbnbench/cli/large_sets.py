"""Large sets on the command line: what measuring one takes, progress through its stages, and stopping it."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.memory import too_large
from gbnbench.execution import progress

if TYPE_CHECKING:
    from gbnbench.analysis.measuring_cost import MeasuringCost
    from gbnbench.core.sides import Sides

STEPS = 100  # of a bar
STOPPED = "stopped before it was measured"


def cost_of_large(n: int, d: int, fmax: int | None, sides: Sides | None) -> MeasuringCost | None:
    """State what measuring a set takes, where it is so large that this is worth saying.

    Parameters
    ----------
    n, d : int
        Points of the set, and dimension.
    fmax : int or None
        As in ``gbnbench.measures``.
    sides : tuple of d floats or None
        As ``as_sides`` returns them.

    Returns
    -------
    MeasuringCost or None
        None for sets that are measured whole.

    Raises
    ------
    InputError
        If it takes more memory than there is.
    """
    from gbnbench.analysis.measuring_cost import measuring_cost
    from gbnbench.analysis.measuring_plan import MeasuringPlan
    from gbnbench.analysis.spatial.slabs import WHOLE

    if n <= WHOLE:
        return None
    cost = measuring_cost(MeasuringPlan(n, d, 1, fmax, sides, curves=False))
    if (said := too_large(cost.nbytes)) is not None:
        raise InputError(f"the measures of n={n} points in d={d} {said}; ask for a smaller --fmax")
    return cost


class Stopped:
    """Whether the user has asked to stop."""

    def __init__(self) -> None:
        self.asked = False

    def __call__(self, *_: object) -> None:
        """Take a signal; a second one stops at once."""
        self.asked = True
        signal.signal(signal.SIGINT, signal.default_int_handler)


@contextmanager
def stages(
    cost: MeasuringCost | None, label: str, stopped: Stopped, quiet: bool
) -> Iterator[Callable[[str, float], None] | None]:
    """Say what a large set takes, and show how far it is; Ctrl-C leaves out what is not measured yet.

    Parameters
    ----------
    cost : MeasuringCost or None
        Of the set; None for one that is not large, of which nothing is said.
    label : str
        Name of the set.
    stopped : Stopped
        Told where the user stops the work.
    quiet : bool
        Whether to say nothing.

    Yields
    ------
    callable or None
        As ``gbnbench.measures`` takes it.
    """
    if cost is None:
        yield None
        return
    if not quiet:
        left_out = "".join(f"; no {name}: {reason}" for reason, name in _by_reason(cost.left_out).items())
        click.echo(
            f"gbnbench: {label}: about {cost.nbytes / 1e9:.2g} GB of memory at most, spectrum to nu = "
            f"{cost.reach:.3g}{left_out}",
            err=True,
        )
    before, done = {}, 0.0
    for stage in cost.stages:
        before[stage.name] = done, stage.seconds
        done += stage.seconds
    main = threading.current_thread() is threading.main_thread()
    handler = signal.signal(signal.SIGINT, stopped) if main else None
    shown = 0
    try:
        with progress.choose(quiet) as bar:
            bar.start(STEPS, 0, cost.stages[0].name)

            def tell(stage: str, share: float) -> None:
                nonlocal shown
                if stopped.asked:
                    raise KeyboardInterrupt if stage == "spectrum" else RefusalError(STOPPED)
                first, seconds = before.get(stage, (0.0, 0.0))
                steps = int(STEPS * (first + share * seconds) / done)
                bar.advance(stage, max(steps - shown, 0))
                shown = max(shown, steps)

            yield tell
    finally:
        if main:
            signal.signal(signal.SIGINT, handler)


def _by_reason(left_out: dict[str, str]) -> dict[str, str]:
    """Join the measures that one reason leaves out."""
    from gbnbench.analysis.measure_definitions import BY_NAME

    found: dict[str, str] = {}
    for name, reason in left_out.items():
        title = BY_NAME[name].title
        found[reason] = f"{found[reason]}, {title}" if reason in found else title
    return found
