"""Variance of estimates over sets and integrands, with its standard error, and slopes over n with theirs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import t

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

MOST_SCATTER = 0.3  # decades from the fitted line beyond which a slope is no law
BAND = 0.975  # quantile at the upper end of a 95% band


@dataclass(frozen=True)
class Variance:
    """Mean squared error of estimates.

    Attributes
    ----------
    value : float
        Mean over all integrands and sets.
    standard_error : float
        Over both, each counted as drawn at random; over one of them alone where the other has a single
        member, nan where both have.
    low, high : float
        95% band, of ln value by Student's t; nan where the standard error is. It covers less where few
        integrands or sets decide: docs/integration.md has figures.
    bias, bias_error : float
        Mean error and its standard error.
    """

    value: float
    standard_error: float
    low: float
    high: float
    bias: float
    bias_error: float


def variance_of(errors: ArrayLike) -> Variance:
    """Mean squared error of crossed estimates.

    Parameters
    ----------
    errors : (integrands, sets) or (integrands, sets, shifts) float64
        Estimate less integral: every integrand with every set. Shifts of one set are averaged before anything
        is said of the spread over sets.

    Returns
    -------
    Variance

    Raises
    ------
    InputError
        If the array is empty or has another number of axes.

    Notes
    -----
    Squares e^2 of integrand i and set k are crossed random effects: their mean over I and K of them has
    variance s_I^2 / I + s_K^2 / K - s_R^2 / (I K), s_I^2 and s_K^2 being the variances of the row and column
    means and s_R^2 that of what these leave (two-way analysis of variance without repetition). The estimate
    is unbiased, and raised to s_R^2 / (I K) where it falls below what independence alone would give.
    """
    crossed = _crossed(errors)
    mean, bias = crossed_mean((crossed**2).mean(axis=2)), crossed_mean(crossed.mean(axis=2))
    value, error = mean.value, mean.standard_error
    factor = math.nan
    if value > 0 and math.isfinite(error):
        factor = math.exp(min(t.ppf(BAND, mean.freedom) * error / value, 700.0))
    return Variance(value, error, value / factor, value * factor, bias.value, bias.standard_error)


@dataclass(frozen=True)
class Slope:
    """A straight line through variances in log-log scale.

    Attributes
    ----------
    value, standard_error : float
        d ln variance / d ln n and what the choice of integrands and sets leaves it uncertain by.
    scatter : float
        Root mean square distance of the variances from the line, in decades: where it is far above their own
        errors the line is a summary, not a law (the sigmoid of smooth integrands).
    """

    value: float
    standard_error: float
    scatter: float


def slope_of(n: Sequence[int], errors: Sequence[ArrayLike]) -> Slope:
    """Fit variance ~ n^slope.

    Parameters
    ----------
    n : sequence of int
        At least two different sizes.
    errors : sequence of (integrands, sets) or (integrands, sets, shifts) float64
        At each size, the same integrands at all of them; numbers of sets may differ.

    Returns
    -------
    Slope
        Each size weighs the same. nan where a variance is 0.

    Raises
    ------
    InputError
        If there are fewer than two sizes, or the numbers of integrands differ.

    Notes
    -----
    To first order the slope is the mean of a_n e^2 / V_n over integrands and sets, a_n being the weights of
    the straight line and V_n the variance at n: what an integrand adds is summed over n before its spread is
    taken, so that integrands hard at every n do not pass for uncertainty of the slope. Sets are drawn anew at
    each n.
    """
    sizes = np.log(np.asarray(n, dtype=np.float64))
    if len(set(n)) < 2:
        raise InputError(f"a slope needs at least two different n; got {list(n)}")
    squares = [(_crossed(e) ** 2).mean(axis=2) for e in errors]
    if len({len(s) for s in squares}) > 1:
        raise InputError(f"a slope needs the same integrands at every n; got {[len(s) for s in squares]}")
    means = np.array([s.mean() for s in squares])
    if not np.all(means > 0):
        return Slope(math.nan, math.nan, math.nan)
    weights = (sizes - sizes.mean()) / np.sum((sizes - sizes.mean()) ** 2)
    value = float(weights @ np.log(means))
    line = np.log(means).mean() + value * (sizes - sizes.mean())
    scatter = math.sqrt(float(np.mean((np.log(means) - line) ** 2))) / math.log(10)
    scaled = [a * s / m for a, s, m in zip(weights, squares, means, strict=True)]
    integrands = len(scaled[0])
    parts, least = [], 0.0
    if integrands > 1:
        rows = np.sum([s.mean(axis=1) for s in scaled], axis=0)
        parts.append(rows.var(ddof=1) / integrands)
    for s in scaled:
        sets = s.shape[1]
        if sets > 1:
            parts.append(s.mean(axis=0).var(ddof=1) / sets)
            if integrands > 1:  # counted in the rows and in the columns
                parts.append(-_residual(s) / s.size)
                least -= parts[-1]
    error = math.sqrt(max(sum(parts), least)) if parts else math.nan
    return Slope(value, error, scatter)


def _crossed(errors: ArrayLike) -> FloatArray:
    """As (integrands, sets, shifts)."""
    array = np.asarray(errors, dtype=np.float64)
    if array.ndim == 2:
        array = array[:, :, None]
    if array.ndim != 3 or array.size == 0:
        raise InputError(
            f"errors must be (integrands, sets) or (integrands, sets, shifts), not empty; got {array.shape}"
        )
    return array


@dataclass(frozen=True)
class CrossedMean:
    """Mean of crossed values.

    Attributes
    ----------
    value, standard_error : float
        The latter nan for a single value.
    freedom : float
        Degrees of freedom of the standard error, by Satterthwaite's rule; 0 where there is none.
    """

    value: float
    standard_error: float
    freedom: float


def crossed_mean(values: FloatArray) -> CrossedMean:
    """Average values of every integrand with every set, (integrands, sets); see ``variance_of``."""
    rows, columns = values.shape
    parts, freedom, least = [], [], 0.0
    if rows > 1:
        parts.append(values.mean(axis=1).var(ddof=1) / rows)
        freedom.append(rows - 1)
    if columns > 1:
        parts.append(values.mean(axis=0).var(ddof=1) / columns)
        freedom.append(columns - 1)
    if rows > 1 and columns > 1:
        least = _residual(values) / values.size  # counted in the rows and in the columns
        parts.append(-least)
        freedom.append((rows - 1) * (columns - 1))
    if not parts:
        return CrossedMean(float(values.mean()), math.nan, 0.0)
    variance = max(sum(parts), least)
    spread = sum(part**2 / count for part, count in zip(parts, freedom, strict=True))
    degrees = min(max(variance**2 / spread, min(freedom)), sum(freedom)) if spread > 0 else sum(freedom)
    return CrossedMean(float(values.mean()), math.sqrt(variance), float(degrees))


def _residual(values: FloatArray) -> float:
    """Variance of what row and column means leave."""
    rest = values - values.mean(axis=1, keepdims=True) - values.mean(axis=0, keepdims=True) + values.mean()
    rows, columns = values.shape
    return float(np.sum(rest**2) / ((rows - 1) * (columns - 1)))
