"""Variance of estimates over sets and integrands, and its slope over n, with standard errors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import stdtrit

from gbnbench.analysis.standard_errors import sample_variance
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

MOST_SCATTER = 0.3  # decades; variances that scatter more about their line follow no power law
BAND = 0.975  # quantile at the upper end of a 95% band


@dataclass(frozen=True)
class Variance:
    """Mean squared error of estimates.

    Attributes
    ----------
    value : float
        Mean over all integrands and sets.
    standard_error : float
        Standard error over integrands and sets, both counted as drawn at random. With a single integrand, or
        a single set, it is over the other alone; with both single it is nan.
    low, high : float
        95% band of ln value by Student's t; nan where the standard error is. It covers less if a few
        integrands or sets dominate: docs/integration.md has figures.
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
        Estimate minus integral, of every integrand with every set. Shifts of one set are averaged before the
        spread over sets is taken.

    Returns
    -------
    Variance
        Their mean square, with its standard error.

    Raises
    ------
    InputError
        If the array is empty or has another number of axes.

    Notes
    -----
    Squares e^2 of integrand i and set k are crossed random effects: their mean over I and K of them has
    variance s_I^2 / I + s_K^2 / K - s_R^2 / (I K), s_I^2 and s_K^2 being the variances of the row and column
    means and s_R^2 the residual variance (two-way analysis of variance without repetition). That estimate is
    unbiased; where it falls below s_R^2 / (I K), the value for independent squares, it is raised to it.
    """
    crossed = _crossed(errors)
    mean, bias = crossed_mean((crossed**2).mean(axis=2)), crossed_mean(crossed.mean(axis=2))
    value, error = mean.value, mean.standard_error
    factor = math.nan
    if value > 0 and math.isfinite(error):
        factor = math.exp(min(float(stdtrit(mean.freedom, BAND)) * error / value, 700.0))
    return Variance(value, error, value / factor, value * factor, bias.value, bias.standard_error)


@dataclass(frozen=True)
class Slope:
    """A straight line through variances in log-log scale.

    Attributes
    ----------
    value, standard_error : float
        d ln variance / d ln n, and its standard error over the choice of integrands and sets.
    scatter : float
        Root mean square distance of the variances from the line, in decades. Far above their own errors, the
        variances follow no power law (as the sigmoid of smooth integrands).
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
        Errors at each size, of the same integrands; numbers of sets may differ.

    Returns
    -------
    Slope
        Least-squares line, every size weighing the same; nan if a variance is 0.

    Raises
    ------
    InputError
        If there are fewer than two sizes, or the numbers of integrands differ.

    Notes
    -----
    To first order the slope is the mean of a_n e^2 / V_n over integrands and sets, a_n being the weights of
    the straight line and V_n the variance at n. The terms of one integrand are summed over n before the
    spread over integrands is taken, since an integrand that is hard at every n does not change the slope.
    Sets are independent at each n.
    """
    # ln(n / n_0), from the difference of the integers: that of two logarithms loses digits where n are close.
    sizes = np.array([math.log1p((size - n[0]) / n[0]) for size in n])
    if len(set(n)) < 2:
        raise InputError(f"a slope needs at least two different n; got {list(n)}")
    squares = [(_crossed(e) ** 2).mean(axis=2) for e in errors]
    if len({len(s) for s in squares}) > 1:
        raise InputError(f"a slope needs the same integrands at every n; got {[len(s) for s in squares]}")
    means = np.array([s.mean() for s in squares])
    if not np.all(means > 0):
        return Slope(math.nan, math.nan, math.nan)
    weights = (sizes - sizes.mean()) / np.sum((sizes - sizes.mean()) ** 2)
    heights = np.log(means / means[0])
    value = float(weights @ heights)
    line = heights.mean() + value * (sizes - sizes.mean())
    scatter = math.sqrt(float(np.mean((heights - line) ** 2))) / math.log(10)
    scaled = [a * s / m for a, s, m in zip(weights, squares, means, strict=True)]
    integrands = len(scaled[0])
    parts, least = [], 0.0
    if integrands > 1:
        rows = np.sum([s.mean(axis=1) for s in scaled], axis=0)
        parts.append(float(sample_variance(rows)) / integrands)
    for s in scaled:
        sets = s.shape[1]
        if sets > 1:
            parts.append(float(sample_variance(s.mean(axis=0))) / sets)
            if integrands > 1:  # counted in the rows and in the columns
                parts.append(-_residual(s) / s.size)
                least -= parts[-1]
    error = math.sqrt(max(sum(parts), least)) if parts else math.nan
    return Slope(value, error, scatter)


def _crossed(errors: ArrayLike) -> FloatArray:
    """Bring errors to the shape (integrands, sets, shifts)."""
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
        The mean and its standard error, nan for a single value.
    freedom : float
        Degrees of freedom of the standard error, by Satterthwaite's rule; 0 for a single value.
    """

    value: float
    standard_error: float
    freedom: float


def crossed_mean(values: FloatArray) -> CrossedMean:
    """Mean of values (integrands, sets) with its standard error over both, as ``variance_of`` has it."""
    rows, columns = values.shape
    parts, freedom, least = [], [], 0.0
    away = values - values.mean()  # exact where values are close, whose means would round their differences
    if rows > 1:
        parts.append(float(sample_variance(away.mean(axis=1))) / rows)
        freedom.append(rows - 1)
    if columns > 1:
        parts.append(float(sample_variance(away.mean(axis=0))) / columns)
        freedom.append(columns - 1)
    if rows > 1 and columns > 1:
        least = _residual(away) / values.size  # counted in the rows and in the columns
        parts.append(-least)
        freedom.append((rows - 1) * (columns - 1))
    if not parts:
        return CrossedMean(float(values.mean()), math.nan, 0.0)
    variance = max(sum(parts), least)
    spread = sum(part**2 / count for part, count in zip(parts, freedom, strict=True))
    degrees = min(max(variance**2 / spread, min(freedom)), sum(freedom)) if spread > 0 else sum(freedom)
    return CrossedMean(float(values.mean()), math.sqrt(variance), float(degrees))


def _residual(values: FloatArray) -> float:
    """Residual variance after row and column means are subtracted."""
    rest = values - values.mean(axis=1, keepdims=True) - values.mean(axis=0, keepdims=True) + values.mean()
    rows, columns = values.shape
    return float(np.sum(rest**2) / ((rows - 1) * (columns - 1)))
