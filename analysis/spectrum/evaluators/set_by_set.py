"""Evaluation of one set after another, for methods that take one at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.core.torus import FloatArray


def set_by_set(
    x: FloatArray,
    weights: FloatArray | None,
    evaluate: Callable[[FloatArray, FloatArray | None], tuple[FloatArray, Errors]],
    *,
    mean: bool,
    together: int = 1,
) -> tuple[FloatArray, Errors]:
    """Evaluate one set after another, for methods that take one at a time.

    Parameters
    ----------
    x : (sets, n, d) float64
        Checked points.
    weights : (sets or 1, n) float64 or None
        Weights of the points.
    evaluate : callable
        From one set and its weights to its power and errors.
    mean : bool
        Average over sets; otherwise the power of each set.
    together : int
        Sets that are evaluated at the same time, each on a thread; they are summed in order all the same.

    Returns
    -------
    power : float64
        What ``evaluate`` returns, averaged, or one row a set.
    errors : Errors
        The largest of all sets.
    """
    total: FloatArray | None = None
    each, rms, bound = [], 0.0, 0.0
    for power, errors in _each(x, weights, evaluate, together):
        rms, bound = max(rms, errors.rms), max(bound, errors.bound)
        if not mean:
            each.append(power)
        elif total is None:
            total = np.array(power)
        else:
            total += power
    if total is None:
        return np.stack(each), Errors(rms, bound)
    return total / len(x), Errors(rms, bound)


def _each(
    x: FloatArray,
    weights: FloatArray | None,
    evaluate: Callable[[FloatArray, FloatArray | None], tuple[FloatArray, Errors]],
    together: int,
) -> Iterator[tuple[FloatArray, Errors]]:
    """Evaluate every set, so many at a time, and give the results in order."""
    dealt = [None] * len(x) if weights is None else np.broadcast_to(weights, (len(x), x.shape[1]))
    if together == 1:
        yield from map(evaluate, x, dealt)
        return
    with ThreadPoolExecutor(together) as pool:
        for first in range(0, len(x), together):
            some = slice(first, first + together)
            yield from pool.map(evaluate, x[some], dealt[some])
