"""How a long draw is watched: progress, a trace of what the optimiser did, and checkpoints to go on from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np

from gbnbench.torus import FloatArray, wrap

if TYPE_CHECKING:
    import pandas as pd

CHECKPOINT_SECONDS = 30.0


class Watched(Protocol):
    """What a trace reads of an optimiser."""

    x: FloatArray
    gradients: int
    excess: FloatArray
    largest: FloatArray
    size: FloatArray


@dataclass
class Trace:
    """What an optimiser did, gradient by gradient.

    Attributes
    ----------
    keep_at : sequence of int
        Counts of gradients after which the points themselves are kept, for the evolution of their spectrum (Fig. 7).
    rows : list of tuple
        (set, gradient, excess, largest, step).
    kept : mapping
        Count of gradients -> points of the sets in order, each (n, d) on the torus.
    """

    keep_at: Sequence[int] = ()
    rows: list[tuple[int, int, float, float, float]] = field(default_factory=list)
    kept: dict[int, list[FloatArray]] = field(default_factory=dict)

    def record(self, optimiser: Watched, first: int) -> None:
        """Add a row for each set of a batch, whose first set has this number."""
        for k, (excess, largest, step) in enumerate(
            zip(optimiser.excess, optimiser.largest, optimiser.size, strict=True)
        ):
            self.rows.append((first + k, optimiser.gradients, float(excess), float(largest), float(step)))
        if optimiser.gradients in self.keep_at:
            self.kept.setdefault(optimiser.gradients, []).extend(wrap(optimiser.x))

    def points(self, gradients: int) -> FloatArray:
        """Return the points kept after so many gradients, (sets, n, d)."""
        return np.stack(self.kept[gradients])

    def to_frame(self) -> pd.DataFrame:
        """Columns set, gradient, excess (energy a point), largest (force, in spacings), step (squared spacings)."""
        import pandas as pd

        return pd.DataFrame(self.rows, columns=["set", "gradient", "excess", "largest", "step"])


@dataclass
class Watch:
    """What a caller wants of a long draw; by default nothing.

    Attributes
    ----------
    progress : callable, optional
        Called with (steps done, steps in all, what is being done); the total is an upper bound.
    trace : Trace, optional
        Filled as the draw goes.
    checkpoint : Path, optional
        File to keep the state in. A draw that finds one of its own goes on from it to the same result, bit by bit;
        it is left in place at the end, to be removed once the points are saved.
    seconds : float
        Least time between two checkpoints.
    """

    progress: Callable[[int, int, str], None] | None = None
    trace: Trace | None = None
    checkpoint: Path | None = None
    seconds: float = CHECKPOINT_SECONDS


@runtime_checkable
class Watchable(Protocol):
    """A generator that draws many sets at once and can be watched."""

    def draw(self, n: int, d: int, rngs: Sequence[np.random.Generator], watch: Watch) -> FloatArray:
        """Draw one set from each stream: (len(rngs), n, d), each bitwise the same as drawn alone."""
        ...
