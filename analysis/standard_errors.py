"""Standard errors of a measure over the sets of one source: of a mean, or by the jackknife (Efron 1982)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from gbnbench.core.torus import FloatArray

Estimate = tuple[float, float]  # value, standard error


def mean_over_sets(each: FloatArray) -> Estimate:
    """Mean of a measure of each set, (sets,), and its standard error s / sqrt(sets); nan for a single set."""
    error = math.sqrt(float(sample_variance(each)) / len(each)) if len(each) > 1 else math.nan
    return float(each.mean()), error


def sample_variance(values: FloatArray) -> FloatArray:
    """Unbiased variance over the first axis, to rounding of itself however large the mean is.

    Parameters
    ----------
    values : (m, ...) float64
        At least two.

    Returns
    -------
    (...) float64
        Sum of squared departures from the mean over m - 1. The mean is rounded; what that leaves in the
        departures is subtracted in its turn (Chan, Golub & LeVeque 1983, "corrected two-pass").
    """
    away = values - values.mean(axis=0)
    away = away - away.mean(axis=0)
    return np.asarray(np.sum(away * away, axis=0) / (len(values) - 1))


def left_out_sums(values: FloatArray) -> Iterator[FloatArray]:
    """Sum over the first axis without each entry in turn.

    Parameters
    ----------
    values : (m, ...) float64
        What is summed.

    Yields
    ------
    (...) float64
        The sum of all others, by additions alone: the total less the entry would lose the others' digits
        where the entry is far larger than they are. Log2 m sums are held at once.
    """
    yield from _others(values, np.zeros(values.shape[1:]))


def _others(values: FloatArray, outside: FloatArray) -> Iterator[FloatArray]:
    if len(values) == 1:
        yield outside
        return
    half = len(values) // 2
    yield from _others(values[:half], outside + values[half:].sum(axis=0))
    yield from _others(values[half:], outside + values[:half].sum(axis=0))


def jackknife(
    whole: Sequence[float], left_out: Iterable[Sequence[float]], realizations: int
) -> list[Estimate]:
    """Attach standard errors by the jackknife to measures of the mean spectrum.

    Parameters
    ----------
    whole : sequence of float
        The measures of the mean over all sets.
    left_out : iterable of sequences of float
        The same measures of the mean over all sets but the k-th, for each k; not touched for a single set.
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
    with np.errstate(invalid="ignore"):  # an infinite value has no spread
        variance = sample_variance(np.array(list(left_out)))
    spread = (realizations - 1) / math.sqrt(realizations) * np.sqrt(variance)
    return [(float(value), float(error)) for value, error in zip(whole, spread, strict=True)]
