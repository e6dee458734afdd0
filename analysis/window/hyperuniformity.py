"""Density fluctuations at large distances: S at k -> 0, its ratio to the peak, and its exponent.

H = S(0+) / S(peak) is Torquato's index, below about 1e-4 for what is called effectively hyperuniform; alpha,
in S ~ k^alpha, tells the class (Torquato 2018; Hawat, Gautier, Bardenet & Lachièze-Rey 2023). Powers are
exponential variables, so both are fitted by maximum likelihood as gamma regressions (Klatt, Last & Henze 2022
do so for S = s + t k^2); Mastrilli, Błaszczyszyn & Lavancier (2024) estimate alpha from tapers of several
scales.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

BAND = 0.5  # nu up to which both are fitted
PEAK = (0.5, 2.0)  # nu between which the peak is sought
LEAST_BINS = 3  # of a fit
STEPS = 100


@dataclass(frozen=True)
class Value:
    """A number with its standard error; both nan where ``reason`` says why there is none."""

    value: float
    error: float
    reason: str = ""


@dataclass(frozen=True)
class Hyperuniformity:
    """Structure factor at small wave numbers.

    Attributes
    ----------
    s_zero : Value
        S extrapolated to k = 0, by s + t k^2 + u k^4 up to nu = 0.5. It may come out below 0 by its error.
    s_peak, nu_peak : Value and float
        Largest mean of three neighbouring bins with 0.5 <= nu <= 2, and where it is. The largest of several
        estimates lies above the true peak by about its error.
    ratio : Value
        H = s_zero / s_peak.
    exponent : Value
        alpha in S = c k^alpha exp(b k^2) up to nu = 0.5, the factor b standing for what follows the power
        law.
    """

    s_zero: Value
    s_peak: Value
    nu_peak: float
    ratio: Value
    exponent: Value


def hyperuniformity(spectrum: pd.DataFrame, covariance: FloatArray) -> Hyperuniformity:
    """Fit the lowest bins of a structure factor.

    Parameters
    ----------
    spectrum : pandas.DataFrame
        As ``radial_structure_factor`` returns it. Bins that are not resolved do not count.
    covariance : (bins, bins) float64
        Relative covariance of its S.

    Returns
    -------
    Hyperuniformity

    Notes
    -----
    An exponent's 95% confidence interval is 1.96 standard errors to either side. Errors are those of Gaussian
    amplitudes; what a formula misses of the true S in the band comes on top.
    """
    nu, resolved = spectrum["nu"].to_numpy(), spectrum["resolved"].to_numpy()
    low, nearby = _chosen(spectrum, covariance, resolved & (nu <= BAND))
    if len(low) >= LEAST_BINS:
        s_zero, exponent = _fits(low, nearby)
    else:
        s_zero = exponent = Value(math.nan, math.nan, _no_fit(spectrum[spectrum["nu"] <= BAND]))
    s_peak, nu_peak = _peak(*_chosen(spectrum, covariance, resolved & (nu >= PEAK[0]) & (nu <= PEAK[1])))
    ratio = Value(math.nan, math.nan, s_zero.reason or s_peak.reason)
    if not ratio.reason:
        h = s_zero.value / s_peak.value
        ratio = Value(h, math.hypot(s_zero.error, h * s_peak.error) / s_peak.value)
    return Hyperuniformity(s_zero, s_peak, nu_peak, ratio, exponent)


def _chosen(
    spectrum: pd.DataFrame, covariance: FloatArray, which: NDArray[np.bool_]
) -> tuple[pd.DataFrame, FloatArray]:
    return spectrum[which], covariance[np.ix_(which, which)]


def _no_fit(low: pd.DataFrame) -> str:
    """Say why there is no fit: too few bins, or less power than side lobes bring."""
    hidden = low[low["S"] <= 2 * low["leakage"]]
    if len(low) >= LEAST_BINS and len(hidden):
        return (
            f"up to nu = {BAND:g} S is no more than what side lobes of the tapers bring, from "
            f"{hidden['leakage'].min():.1g} on: it lies below, and only a larger window can tell how far"
        )
    count = int(low["resolved"].sum())
    return (
        f"the window resolves {count} bin{'s' * (count != 1)} of S up to nu = {BAND:g}, where a fit needs "
        f"{LEAST_BINS}: more points are needed"
    )


def _fits(low: pd.DataFrame, covariance: FloatArray) -> tuple[Value, Value]:
    """Fit S at 0 and the exponent to the bins of the low band."""
    bins = len(low)
    k, s = low["k"].to_numpy(), low["S"].to_numpy()
    u = (k / k[-1]) ** 2
    powers = np.stack([np.ones(bins), u, u**2], axis=1)
    start = np.zeros(powers.shape[1])
    start[0] = np.average(s, weights=1 / np.diag(covariance))
    fitted, errors = gamma_regression(powers, s, covariance, start, log=False)
    s_zero = Value(float(fitted[0]), math.sqrt(float(errors[0, 0])))
    logs = np.stack([np.ones(bins), np.log(k / k[-1]), u], axis=1)
    start = np.zeros(logs.shape[1])
    start[0] = math.log(float(np.average(s, weights=1 / np.diag(covariance))))
    fitted, errors = gamma_regression(logs, s, covariance, start, log=True)
    return s_zero, Value(float(fitted[1]), math.sqrt(float(errors[1, 1])))


def gamma_regression(
    design: FloatArray, s: FloatArray, covariance: FloatArray, start: FloatArray, *, log: bool
) -> tuple[FloatArray, FloatArray]:
    """Fit means of exponential variables by maximum likelihood.

    Parameters
    ----------
    design : (bins, q) float64
        Columns of the model.
    s : (bins,) float64
        Means, above 0.
    covariance : (bins, bins) float64
        Of the means, over the product of their expectations: each is worth 1 / its diagonal variables.
    start : (q,) float64
        Coefficients to begin with, whose means are above 0.
    log : bool
        The mean is exp(design @ coefficients); otherwise design @ coefficients.

    Returns
    -------
    coefficients : (q,) float64
    errors : (q, q) float64
        Covariance of the coefficients, in which that between bins is counted (the sandwich formula).

    Notes
    -----
    Fisher's scoring of sum over bins of (log mean + s / mean) / variance, a step halved until it does not
    rise.
    """
    degrees = 1 / np.diag(covariance)

    def means(coefficients: FloatArray) -> FloatArray:
        linear: FloatArray = design @ coefficients
        return np.exp(linear) if log else linear

    def deviance(mean: FloatArray) -> float:
        return float(degrees @ (np.log(mean) + s / mean)) if (mean > 0).all() else math.inf

    at, mean = start, means(start)
    lowest = deviance(mean)
    for _ in range(STEPS):
        slopes = design if log else design / mean[:, None]  # of log mean
        information = slopes.T @ (slopes * degrees[:, None])
        step = np.linalg.lstsq(information, slopes.T @ (degrees * (s / mean - 1)), rcond=None)[0]
        for _ in range(40):
            trial = means(at + step)
            with np.errstate(over="ignore", invalid="ignore"):
                reached = deviance(trial)
            if reached <= lowest:
                break
            step = step / 2
        else:
            break
        gained, at, mean, lowest = lowest - reached, at + step, trial, reached
        if gained <= 1e-12 * float(degrees.sum()):
            break
    slopes = design if log else design / mean[:, None]
    scores = slopes * degrees[:, None]
    inverse = np.linalg.pinv(slopes.T @ scores, hermitian=True)
    return at, inverse @ scores.T @ covariance @ scores @ inverse


def _peak(band: pd.DataFrame, covariance: FloatArray) -> tuple[Value, float]:
    """Find the largest weighted mean of three neighbouring bins."""
    if len(band) < 3:
        reason = f"S is known in {len(band)} bins with {PEAK[0]:g} <= nu <= {PEAK[1]:g}, where a peak needs 3"
        return Value(math.nan, math.nan, reason), math.nan
    s, nu, degrees = band["S"].to_numpy(), band["nu"].to_numpy(), 1 / np.diag(covariance)
    three = np.ones(3)
    mean = np.convolve(degrees * s, three, "valid") / np.convolve(degrees, three, "valid")
    top = slice(int(mean.argmax()), int(mean.argmax()) + 3)
    weight = degrees[top] / degrees[top].sum()
    part = weight * s[top]
    error = math.sqrt(float(part @ covariance[top, top] @ part))
    return Value(float(part.sum()), error), float(weight @ nu[top])
