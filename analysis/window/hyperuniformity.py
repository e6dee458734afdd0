"""Whether density fluctuations vanish at large distances: S at k -> 0, its ratio to the peak, its exponent.

H = S(0+) / S(peak) is Torquato's index, below about 1e-4 for what is called effectively hyperuniform; alpha, in
S ~ k^alpha, tells the class (Torquato 2018; Hawat, Gautier, Bardenet & Lachièze-Rey 2023). Powers are
exponential variables, so both are fitted by maximum likelihood as gamma regressions (Klatt, Last & Henze 2022 do
so for S = s + t k^2); Mastrilli, Błaszczyszyn & Lavancier (2024) estimate alpha from tapers of several scales.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

BAND = 0.4  # nu up to which both are fitted
PEAK = (0.5, 2.0)  # nu between which the peak is sought
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
        S extrapolated to k = 0, by s + t k^2 + u k^4 up to nu = 0.4. It may come out below 0 by its error.
    s_peak, nu_peak : Value and float
        Largest mean of three neighbouring bins with 0.5 <= nu <= 2, and where it is. The largest of several
        estimates lies above the true peak by about its error.
    ratio : Value
        H = s_zero / s_peak.
    exponent : Value
        alpha in S = c k^alpha exp(b k^2) up to nu = 0.4, the factor b standing for what follows the power law.
    """

    s_zero: Value
    s_peak: Value
    nu_peak: float
    ratio: Value
    exponent: Value


def hyperuniformity(spectrum: pd.DataFrame) -> Hyperuniformity:
    """Fit the lowest bins of a structure factor.

    Parameters
    ----------
    spectrum : pandas.DataFrame
        As ``radial_structure_factor`` returns it. Bins that are not resolved do not count.

    Returns
    -------
    Hyperuniformity

    Notes
    -----
    An exponent's 95% confidence interval is 1.96 standard errors to either side. Errors are those of Gaussian
    amplitudes; what a formula misses of the true S in the band comes on top.
    """
    known = spectrum[spectrum["resolved"]]
    low = known[known["nu"] <= BAND]
    s_zero, exponent = _fits(low)
    s_peak, nu_peak = _peak(known[known["nu"].between(*PEAK)])
    ratio = Value(math.nan, math.nan, s_zero.reason or s_peak.reason)
    if not ratio.reason:
        h = s_zero.value / s_peak.value
        ratio = Value(h, math.hypot(s_zero.error, h * s_peak.error) / s_peak.value)
    return Hyperuniformity(s_zero, s_peak, nu_peak, ratio, exponent)


def _fits(low: pd.DataFrame) -> tuple[Value, Value]:
    """Fit S at 0 and the exponent to the bins of the low band."""
    bins = len(low)
    if bins < 3 or low["fit_degrees"].sum() < 12:
        reason = f"the window resolves {bins} bins of S up to nu = {BAND:g}, too few for a fit: more points are needed"
        return Value(math.nan, math.nan, reason), Value(math.nan, math.nan, reason)
    k, s, degrees = (low[name].to_numpy() for name in ("k", "S", "fit_degrees"))
    u = (k / k[-1]) ** 2
    powers = np.stack([np.ones(bins), u, u**2][: min(3, bins - 1)], axis=1)
    start = np.zeros(powers.shape[1])
    start[0] = np.average(s, weights=degrees)
    fitted, covariance = gamma_regression(powers, s, degrees, start, log=False)
    s_zero = Value(float(fitted[0]), math.sqrt(float(covariance[0, 0])))
    logs = np.stack([np.ones(bins), np.log(k / k[-1]), u][: min(3, bins - 1)], axis=1)
    start = np.zeros(logs.shape[1])
    start[0] = math.log(float(np.average(s, weights=degrees)))
    fitted, covariance = gamma_regression(logs, s, degrees, start, log=True)
    return s_zero, Value(float(fitted[1]), math.sqrt(float(covariance[1, 1])))


def gamma_regression(
    design: FloatArray, s: FloatArray, degrees: FloatArray, start: FloatArray, *, log: bool
) -> tuple[FloatArray, FloatArray]:
    """Fit means of exponential variables by maximum likelihood.

    Parameters
    ----------
    design : (bins, q) float64
        Columns of the model.
    s, degrees : (bins,) float64
        Means, above 0, and of how many independent variables each.
    start : (q,) float64
        Coefficients to begin with, whose means are above 0.
    log : bool
        The mean is exp(design @ coefficients); otherwise design @ coefficients.

    Returns
    -------
    coefficients : (q,) float64
    covariance : (q, q) float64
        Inverse of the Fisher information.

    Notes
    -----
    Fisher's scoring of sum over bins of degrees (log mean + s / mean), a step halved until it does not rise.
    """

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
    return at, np.linalg.pinv(slopes.T @ (slopes * degrees[:, None]), hermitian=True)


def _peak(band: pd.DataFrame) -> tuple[Value, float]:
    """Find the largest weighted mean of three neighbouring bins."""
    if len(band) < 3:
        return Value(
            math.nan, math.nan, f"S has {len(band)} bins with {PEAK[0]:g} <= nu <= {PEAK[1]:g}"
        ), math.nan
    s, nu, degrees = (band[name].to_numpy() for name in ("S", "nu", "fit_degrees"))
    three = np.ones(3)
    weight = np.convolve(degrees, three, "valid")
    mean = np.convolve(degrees * s, three, "valid") / weight
    top = int(mean.argmax())
    value = Value(float(mean[top]), float(mean[top] / math.sqrt(weight[top])))
    return value, float(np.average(nu[top : top + 3], weights=degrees[top : top + 3]))
