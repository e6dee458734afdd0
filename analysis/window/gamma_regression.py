"""Gamma regression of mean powers, which are means of exponential variables, by maximum likelihood.

Bins of a spectrum overlap, so that the likelihood of independent ones is too sure of itself. Errors are
therefore those of the sandwich formula (White 1982), and the intervals come from the profile likelihood,
scaled so that its curvature agrees with them (Rotnitzky & Jewell 1990; Chandler & Bate 2007).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from gbnbench.core.torus import FloatArray

NORMAL_95 = 1.959964  # standard errors to either side of a 95% interval
STEPS = 100  # of Fisher's scoring
HALVINGS = 40  # of one of its steps
WIDENINGS = 60  # doublings of a step away from the best fit, until a bound lies behind it


@dataclass(frozen=True)
class GammaFit:
    """Best fit of a model to mean powers.

    Attributes
    ----------
    coefficients : (q,) float64
        Of the model's columns.
    means : (bins,) float64
        What the model expects of each bin.
    deviance : float
        Twice the negative logarithm of the likelihood, up to a constant.
    """

    coefficients: FloatArray
    means: FloatArray
    deviance: float


def gamma_regression(
    design: FloatArray,
    s: FloatArray,
    degrees: FloatArray,
    start: FloatArray,
    *,
    log: bool = False,
    offset: FloatArray | float = 0.0,
) -> GammaFit:
    """Fit means of exponential variables by maximum likelihood.

    Parameters
    ----------
    design : (bins, q) float64
        Columns of the model.
    s : (bins,) float64
        Means, above 0.
    degrees : (bins,) float64
        Number of independent variables that each mean is worth.
    start : (q,) float64
        Coefficients to begin with, whose means are above 0.
    log : bool
        The mean is exp(offset + design @ coefficients); otherwise offset + design @ coefficients.
    offset : float or (bins,) float64
        Known part of the model.

    Returns
    -------
    GammaFit

    Notes
    -----
    Fisher's scoring of the sum over bins of 2 degrees (log mean + s / mean), a step halved until it does not
    rise.
    """

    def means(coefficients: FloatArray) -> FloatArray:
        linear: FloatArray = offset + design @ coefficients
        return np.exp(linear) if log else linear

    def deviance(mean: FloatArray) -> float:
        return 2 * float(degrees @ (np.log(mean) + s / mean)) if (mean > 0).all() else math.inf

    at, mean = start, means(start)
    lowest = deviance(mean)
    for _ in range(STEPS):
        slopes = design if log else design / mean[:, None]  # of log mean
        information = slopes.T @ (slopes * degrees[:, None])
        step = np.linalg.lstsq(information, slopes.T @ (degrees * (s / mean - 1)), rcond=None)[0]
        for _ in range(HALVINGS):
            trial = means(at + step)
            with np.errstate(over="ignore", invalid="ignore"):
                reached = deviance(trial)
            if reached <= lowest:
                break
            step = step / 2
        else:
            break
        gained, at, mean, lowest = lowest - reached, at + step, trial, reached
        if gained <= 2e-12 * float(degrees.sum()):
            break
    return GammaFit(at, mean, lowest)


def errors(
    slopes: FloatArray, covariance: FloatArray, beyond_gauss: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Give the covariance of fitted coefficients.

    Parameters
    ----------
    slopes : (bins, q) float64
        Derivatives of each bin's log mean by the coefficients: the design for a model of the logarithm, the
        design over the means for one of the means.
    covariance : (bins, bins) float64
        Of the mean powers, over the product of their expectations.
    beyond_gauss : float
        Most that any two bins' relative covariance may be off, either way: see ``profile_interval``.

    Returns
    -------
    counted, independent : (q, q) float64
        With the covariance between bins counted (the sandwich formula) and the most that may be missing of
        it, and as if there were none.
    """
    scores = slopes / np.diag(covariance)[:, None]
    independent = np.linalg.pinv(slopes.T @ scores, hermitian=True).astype(np.float64)
    weights = independent @ scores.T
    most = np.abs(weights).sum(axis=1)
    return weights @ covariance @ weights.T + beyond_gauss * np.outer(most, most), independent


def profile_interval(
    design: FloatArray, s: FloatArray, covariance: FloatArray, fit: GammaFit, beyond_gauss: float = 0.0
) -> tuple[float, float]:
    """Give the 95% interval of the first coefficient of a linear model whose first column is 1.

    Parameters
    ----------
    design : (bins, q) float64
        Columns of the model; the first is 1, the others are above 0.
    s : (bins,) float64
        Mean powers.
    covariance : (bins, bins) float64
        Of the mean powers, over the product of their expectations.
    fit : GammaFit
        The best fit.
    beyond_gauss : float
        Most that any two bins' relative covariance may be off, since amplitudes are not quite Gaussian.

    Returns
    -------
    low, high : float
        Where the profile deviance, scaled by the ratio of the variances without and with the covariance
        between bins, exceeds the least one by 1.96^2. Small means have small errors, so an estimate that
        falls low has the longer arm above it, as it must; 1.96 standard errors would be too few there.
    """
    degrees, others = 1 / np.diag(covariance), design[:, 1:]

    def excess(value: float) -> float:
        """Scaled profile deviance at a value of the coefficient, less that of the bounds."""
        start = np.zeros(others.shape[1])
        start[0] = max(float(s.mean()) - value, 1e-9 * float(s.mean()))
        if value <= 0:
            start[0] = (float(s.mean()) - value) / float(others[:, 0].min())
        held = gamma_regression(others, s, degrees, start, offset=value)
        counted, independent = errors(design / held.means[:, None], covariance, beyond_gauss)
        scale = float(independent[0, 0] / counted[0, 0])
        return max(held.deviance - fit.deviance, 0.0) * scale - NORMAL_95**2

    best = float(fit.coefficients[0])
    counted, _ = errors(design / fit.means[:, None], covariance, beyond_gauss)
    error = math.sqrt(float(counted[0, 0]))
    return _crossing(excess, best, -error), _crossing(excess, best, error)


def _crossing(excess: Callable[[float], float], best: float, step: float) -> float:
    """Find where a function that is below 0 at the best fit becomes 0, in the direction of the step."""
    inside = best
    for _ in range(WIDENINGS):
        outside = inside + step
        if excess(outside) >= 0:
            return float(brentq(excess, inside, outside, xtol=1e-6 * abs(step), rtol=1e-6))
        inside, step = outside, 2 * step
    return math.copysign(math.inf, step)
