"""A run of the optimiser over many sets, in batches that share the device, with progress and checkpoints."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gbn.checkpoint import Checkpoint
from gbnbench.generators.monitor import Monitor, OptimiserState

BATCH = 1 << 16  # points optimised together, so that even small sets fill every core


class Optimiser(OptimiserState, Protocol):
    """An optimiser; see ``optimiser.Descent``."""

    finished: NDArray[np.bool_]

    def advance(self) -> None:
        """Evaluate once and move."""
        ...

    def state(self) -> dict[str, NDArray[Any]]:
        """Everything that the next steps depend on."""
        ...

    def restore(self, state: dict[str, NDArray[Any]]) -> None:
        """Go on from a state."""
        ...


def optimise_in_batches(
    starts: FloatArray,
    method: Callable[[FloatArray], Optimiser],
    gradients: int,
    monitor: Monitor,
    name: str,
    inside: Callable[[FloatArray], FloatArray] = wrap,
) -> FloatArray:
    """Move every set from its start.

    Parameters
    ----------
    starts : (sets, n, d) float64
        In box sides.
    method : callable
        Makes the optimiser of a batch of starts.
    gradients : int
        Evaluations a set at most.
    monitor : Monitor
        Progress, trace and checkpoint.
    name : str
        Name of the run, for progress and for its checkpoint.
    inside : callable
        Brings points into their domain for the trace.

    Returns
    -------
    (sets, n, d) float64
        In box sides, not wrapped; bitwise the same for a set whatever the others are.

    Raises
    ------
    InputError
        If the checkpoint is of another run.
    """
    sets, n, _ = starts.shape
    size = max(1, BATCH // n)
    ends = starts.copy()
    kept, first, state = _checkpoint(starts, gradients, monitor, name), 0, None
    if kept is not None and (found := kept.load()) is not None:
        first = int(found.pop("first"))
        ends[:first] = found.pop("done")
        if monitor.trace is not None and "rows" in found:
            monitor.trace.restore(found)
        state = found if "x" in found else None
    batches = [slice(k, min(k + size, sets)) for k in range(first, sets, size)]
    total = gradients * -(-sets // size)
    for batch in batches:
        optimiser = method(starts[batch])
        if state is not None:
            optimiser.restore(state)
            state = None
        before = batch.start // size * gradients
        latest: dict[str, NDArray[Any]] | None = None
        while optimiser.gradients < gradients and not optimiser.finished.all():
            try:
                optimiser.advance()
            except KeyboardInterrupt:
                if kept is not None and latest is not None:
                    kept.save(_state(ends[: batch.start], monitor) | latest)
                raise
            if monitor.trace is not None:
                monitor.trace.record(optimiser, batch.start, inside)
            if monitor.progress is not None:
                excess = float(np.nanmax(optimiser.excess))
                monitor.progress(before + optimiser.gradients, total, f"{name}, excess {excess:.1e}")
            if kept is not None:
                latest = optimiser.state()
                if kept.due:
                    kept.save(_state(ends[: batch.start], monitor) | latest)
        ends[batch] = optimiser.x
        if kept is not None and batch.stop < sets:
            kept.save(_state(ends[: batch.stop], monitor))
    if kept is not None:
        kept.save(_state(ends, monitor))
    return ends


def _state(done: FloatArray, monitor: Monitor) -> dict[str, NDArray[Any]]:
    traced = {} if monitor.trace is None else monitor.trace.state()
    return {"first": np.array(len(done)), "done": done, **traced}


def _checkpoint(starts: FloatArray, gradients: int, monitor: Monitor, name: str) -> Checkpoint | None:
    if monitor.checkpoint is None:
        return None
    sets, n, d = starts.shape
    digest = hashlib.sha256(starts.tobytes()).hexdigest()[:16]
    key = f"{name} to {gradients} gradients of {sets} x {n} points, d={d}, start {digest}"
    return Checkpoint(monitor.checkpoint, key, monitor.seconds)
