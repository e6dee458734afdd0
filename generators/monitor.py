"""Monitoring of a long draw: progress, a trace of what the optimiser did, checkpoints to go on from."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

CHECKPOINT_SECONDS = 30.0
CHECKPOINT_VARIABLE = "GBNBENCH_CHECKPOINT_SECONDS"


class OptimiserState(Protocol):
    """The state of an optimiser that a trace records."""

    x: FloatArray
    gradients: int
    excess: FloatArray
    largest: FloatArray
    size: FloatArray
    constant: float


@dataclass
class Trace:
    """A record of an optimiser's run, gradient by gradient.

    Attributes
    ----------
    keep_at : sequence of int
        Counts of gradients after which the points themselves are kept, for the evolution of their spectrum
        (Fig. 7).
    rows : list of tuple
        (set, gradient, energy, excess, largest, step).
    kept : mapping
        Count of gradients -> points of the sets in order, each (n, d) on the torus.
    """

    keep_at: Sequence[int] = ()
    rows: list[tuple[int, int, float, float, float, float]] = dataclasses.field(default_factory=list)
    kept: dict[int, list[FloatArray]] = dataclasses.field(default_factory=dict)

    def record(
        self, optimiser: OptimiserState, first: int, inside: Callable[[FloatArray], FloatArray]
    ) -> None:
        """Add a row for each set of a batch.

        Parameters
        ----------
        optimiser : OptimiserState
            The batch, after an evaluation.
        first : int
            Number of the batch's first set.
        inside : callable
            Brings points into their domain.
        """
        for k, (excess, largest, step) in enumerate(
            zip(optimiser.excess, optimiser.largest, optimiser.size, strict=True)
        ):
            energy = float(excess) + optimiser.constant
            self.rows.append(
                (first + k, optimiser.gradients, energy, float(excess), float(largest), float(step))
            )
        if optimiser.gradients in self.keep_at:
            self.kept.setdefault(optimiser.gradients, []).extend(inside(optimiser.x))

    def state(self) -> dict[str, NDArray[Any]]:
        """Give what a checkpoint keeps of it."""
        return {"rows": np.array(self.rows)} | {f"kept_{at}": np.array(x) for at, x in self.kept.items()}

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from a state."""
        self.rows = [(int(r[0]), int(r[1]), *map(float, r[2:])) for r in state["rows"]]  # type: ignore[misc]
        self.kept = {
            int(name.removeprefix("kept_")): list(x) for name, x in state.items() if name.startswith("kept_")
        }

    def points(self, gradients: int) -> FloatArray:
        """Return the points kept after so many gradients, (sets, n, d)."""
        return np.stack(self.kept[gradients])

    def to_frame(self) -> pd.DataFrame:
        """Columns set, gradient, energy and excess (a point), largest (force, spacings), step (its square).

        The energy is the sum over pairs, nan where the kernel is cut off, in the box and with projections.
        """
        import pandas as pd

        return pd.DataFrame(self.rows, columns=["set", "gradient", "energy", "excess", "largest", "step"])


@dataclass
class Monitor:
    """A caller's wishes for a long draw: progress, a trace, checkpoints; by default none.

    Attributes
    ----------
    progress : callable, optional
        Called with (steps done, steps in all, what is being done); the total is an upper bound.
    trace : Trace, optional
        Filled as the draw goes.
    checkpoint : Path, optional
        File to keep the state in. A draw that finds one of its own goes on from it to the same result, bit by
        bit; it is left in place at the end, to be removed once the points are saved.
    seconds : float
        Least time between two checkpoints; by default $GBNBENCH_CHECKPOINT_SECONDS, else 30.
    """

    progress: Callable[[int, int, str], None] | None = None
    trace: Trace | None = None
    checkpoint: Path | None = None
    seconds: float = dataclasses.field(
        default_factory=lambda: float(os.environ.get(CHECKPOINT_VARIABLE, CHECKPOINT_SECONDS))
    )


def refuse_all_but_progress(monitor: Monitor, name: str) -> None:
    """Refuse a trace or a checkpoint that a generator cannot keep.

    Parameters
    ----------
    monitor : Monitor
        What the caller wants.
    name : str
        The generator, for the message.

    Raises
    ------
    InputError
        If one is asked for.
    """
    for what in ("trace", "checkpoint"):
        if getattr(monitor, what) is not None:
            raise InputError(f"{name} has no {what}: gbn and deep have, which optimise in many small steps")


@runtime_checkable
class MonitoredGenerator(Protocol):
    """A generator that draws many sets at once and reports to a monitor."""

    def draw(self, n: int, d: int, rngs: Sequence[np.random.Generator], monitor: Monitor) -> FloatArray:
        """Draw one set from each stream.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rngs : sequence of numpy.random.Generator
            One for each set.
        monitor : Monitor
            What the caller wants to be told and kept.

        Returns
        -------
        (len(rngs), n, d) float64
            Each set bit by bit as if it were drawn alone.
        """
        ...
