"""Evaluation of one set after another, for methods that take one at a time."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.core.torus import FloatArray


def set_by_set(
    x: FloatArray,
    weights: FloatArray | None,
    evaluate: Callable[[FloatArray, FloatArray | None], tuple[FloatArray, Errors]],
    *,
    mean: bool,
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

    Returns
    -------
    power : float64
        What ``evaluate`` returns, averaged, or one row a set.
    errors : Errors
        The largest of all sets.
    """
    total: FloatArray | None = None
    each, rms, bound = [], 0.0, 0.0
    for k, one in enumerate(x):
        w = None if weights is None else weights[k if len(weights) > 1 else 0]
        power, errors = evaluate(one, w)
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
