"""Standard errors of a measure over the sets of one source: of a mean, or by the jackknife (Efron 1982)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from gbnbench.core.torus import FloatArray

Estimate = tuple[float, float]  # value, standard error


def mean_over_sets(each: FloatArray) -> Estimate:
    """Mean of a measure of each set, (sets,), and its standard error s / sqrt(sets); nan for a single set."""
    error = float(each.std(ddof=1) / math.sqrt(len(each))) if len(each) > 1 else math.nan
    return float(each.mean()), error


def jackknife(
    whole: Sequence[float], left_out: Callable[[int], Sequence[float]], realizations: int
) -> list[Estimate]:
    """Attach standard errors by the jackknife to measures of the mean spectrum.

    Parameters
    ----------
    whole : sequence of float
        The measures of the mean over all sets.
    left_out : callable
        k -> the same measures of the mean over all sets but the k-th.
    realizations : int
        M, the number of sets.

    Returns
    -------
    list of (value, standard error)
        The errors are nan for a single set.

    Notes
    -----
    error^2 = (M - 1)/M times the sum over k of (v_k - mean of v)^2, v_k being the measure without set k.

    References
    ----------
    Efron, "The jackknife, the bootstrap and other resampling plans", SIAM, 1982.
    """
    if realizations < 2:
        return [(float(value), math.nan) for value in whole]
    rest = np.array([left_out(k) for k in range(realizations)])
    with np.errstate(invalid="ignore"):  # an infinite value has no spread
        departure = rest - rest.mean(axis=0)
    spread = np.sqrt((realizations - 1) / realizations * np.sum(departure**2, axis=0))
    return [(float(value), float(error)) for value, error in zip(whole, spread, strict=True)]
