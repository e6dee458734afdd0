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


def left_out_sums(values: FloatArray, always: FloatArray | None = None) -> Iterator[FloatArray]:
    """Sum over the first axis without each entry in turn.

    Parameters
    ----------
    values : (m, ...) float64
        What is summed.
    always : (...) float64, optional
        Added to each sum.

    Yields
    ------
    (...) float64
        The sum of all others, by additions alone: the total less the entry would lose the others' digits
        where the entry is far larger than they are. Log2 m sums are held at once.
    """
    yield from _others(values, np.zeros(values.shape[1:]) if always is None else always)


def _others(values: FloatArray, outside: FloatArray) -> Iterator[FloatArray]:
    if len(values) == 1:
        yield outside
        return
    half = len(values) // 2
    yield from _others(values[:half], outside + values[half:].sum(axis=0))
    yield from _others(values[half:], outside + values[:half].sum(axis=0))


def jackknife(
    whole: Sequence[float], left_out: Iterable[Sequence[float]], realizations: int, group: int = 1
) -> list[Estimate]:
    """Attach standard errors by the jackknife to measures of the mean spectrum.

    Parameters
    ----------
    whole : sequence of float
        The measures of the mean over all sets.
    left_out : iterable of sequences of float
        The same measures of the mean over all sets but the k-th, or the k-th group, for each k; not touched
        for a single set.
    realizations : int
        M, the number of sets.
    group : int
        m, the number of sets of a group. Sets that are in no whole group are never left out.

    Returns
    -------
    list of (value, standard error)
        The errors are nan for a single set.

    Notes
    -----
    error^2 = (M - m)^2/(m M) times the sample variance of the v_k, v_k being the measure without group k. For
    single sets this is (M - 1)/M times the sum over k of (v_k - mean of v)^2.

    References
    ----------
    Efron, "The jackknife, the bootstrap and other resampling plans", SIAM, 1982. Groups: Shao & Tu, "The
    jackknife and bootstrap", Springer, 1995, Sec. 2.3.
    """
    if realizations < 2:
        return [(float(value), math.nan) for value in whole]
    with np.errstate(invalid="ignore"):  # an infinite value has no spread
        variance = sample_variance(np.array(list(left_out)))
    spread = (realizations - group) / math.sqrt(group * realizations) * np.sqrt(variance)
    return [(float(value), float(error)) for value, error in zip(whole, spread, strict=True)]
