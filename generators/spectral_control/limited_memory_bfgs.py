"""Limited-memory BFGS (Nocedal 1980; Liu & Nocedal 1989), the same bits on any number of threads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gbnbench.core.torus import FloatArray

MEMORY = 10  # pairs of moves and changes of the gradient
FIRST = 0.1  # longest displacement of the first step, in the units of x
LONGEST = 0.5  # and of any other
HALVINGS = 20
SUFFICIENT = 1e-4  # of the decrease that the gradient promises (Armijo)

Objective = Callable[[FloatArray], tuple[float, FloatArray]]


@dataclass(frozen=True)
class Minimum:
    """Where a minimisation ended.

    Attributes
    ----------
    x : (n, d) float64
        The point.
    value : float
        Of the objective there.
    iterations : int
        Steps taken.
    """

    x: FloatArray
    value: float
    iterations: int


def minimise(
    objective: Objective,
    x: FloatArray,
    iterations: int,
    enough: float,
    progress: Callable[[int, float], None] | None = None,
) -> Minimum:
    """Descend from x until the objective is small enough, no step lowers it, or the steps are used up.

    Parameters
    ----------
    objective : callable
        Gives value and gradient, (n, d), at x.
    x : (n, d) float64
        Start.
    iterations : int
        Most steps.
    enough : float
        Value at which it stops.
    progress : callable, optional
        Called with steps done and the value.

    Returns
    -------
    Minimum

    Examples
    --------
    >>> bowl = lambda x: (float(np.sum(x**2)), 2 * x)
    >>> minimise(bowl, np.ones((1, 2)), 50, 1e-12).value < 1e-12
    True
    """
    value, gradient = objective(x)
    moves: list[FloatArray] = []
    changes: list[FloatArray] = []
    done = 0
    while done < iterations and value > enough:
        direction = _direction(gradient, moves, changes)
        slope = _dot(direction, gradient)
        if slope >= 0:
            direction, moves, changes = -gradient, [], []
            slope = _dot(direction, gradient)
        step = _longest_step(direction, LONGEST if moves else FIRST)
        step = min(step, 1.0) if moves else step
        for _ in range(HALVINGS):
            moved = x + step * direction
            lower, there = objective(moved)
            if lower <= value + SUFFICIENT * step * slope:
                break
            step /= 2
        else:
            if not moves:
                break
            moves, changes = [], []
            continue
        if _dot(moved - x, there - gradient) > 0:
            moves = [*moves[1 - MEMORY :], moved - x]
            changes = [*changes[1 - MEMORY :], there - gradient]
        x, value, gradient = moved, lower, there
        done += 1
        if progress is not None:
            progress(done, value)
    return Minimum(x, value, done)


def _direction(gradient: FloatArray, moves: list[FloatArray], changes: list[FloatArray]) -> FloatArray:
    """Minus the gradient times the inverse Hessian that the moves tell of, by the two loops."""
    out = -gradient
    shares = []
    for move, change in zip(reversed(moves), reversed(changes), strict=True):
        share = _dot(move, out) / _dot(move, change)
        shares.append(share)
        out = out - share * change
    if moves:
        out = out * (_dot(moves[-1], changes[-1]) / _dot(changes[-1], changes[-1]))
    for move, change, share in zip(moves, changes, reversed(shares), strict=True):
        out = out + (share - _dot(change, out) / _dot(move, change)) * move
    return out


def _longest_step(direction: FloatArray, longest: float) -> float:
    """Largest step at which no point moves farther than ``longest``."""
    farthest = float(np.sqrt(np.max(np.sum(direction**2, axis=1))))
    return longest / farthest if farthest > 0 else 0.0


def _dot(a: FloatArray, b: FloatArray) -> float:
    """Sum of products without BLAS, whose order of addition depends on its threads."""
    return float(np.sum(a * b))
