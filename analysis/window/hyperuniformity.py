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

from gbnbench.analysis.window.gamma_regression import NORMAL_95, errors, gamma_regression, profile_interval
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

BAND = 0.5  # nu up to which both are fitted
PEAK = (0.5, 2.0)  # nu between which the peak is sought
LEAST_BINS = 3  # of a fit
FOURTH_CUMULANTS = 0.54  # largest negative relative covariance of thinned patterns, over t / n


@dataclass(frozen=True)
class Value:
    """A number with its standard error and 95% interval; all nan where ``reason`` says why there is none."""

    value: float
    error: float
    reason: str = ""
    interval: tuple[float, float] = (math.nan, math.nan)

    @classmethod
    def normal(cls, value: float, error: float) -> Value:
        """Make one whose interval is 1.96 standard errors to either side.

        Parameters
        ----------
        value, error : float
            The number and its standard error.

        Returns
        -------
        Value
        """
        return cls(value, error, interval=(value - NORMAL_95 * error, value + NORMAL_95 * error))


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


def hyperuniformity(
    spectrum: pd.DataFrame, covariance: FloatArray, beyond_gauss: float = 0.0
) -> Hyperuniformity:
    """Fit the lowest bins of a structure factor.

    Parameters
    ----------
    spectrum : pandas.DataFrame
        As ``radial_structure_factor`` returns it. Bins that are not resolved do not count.
    covariance : (bins, bins) float64
        Relative covariance of its S, for Gaussian amplitudes.
    beyond_gauss : float
        Most that this may be off, either way, since amplitudes are not quite Gaussian; ``beyond_gauss``
        gives it.

    Returns
    -------
    Hyperuniformity

    Notes
    -----
    The 95% interval of ``s_zero`` is that of its profile likelihood and wider above than below, since small
    powers vary less; the others are 1.96 standard errors to either side. What a
    formula misses of the true S in the band comes on top.
    """
    nu, resolved = spectrum["nu"].to_numpy(), spectrum["resolved"].to_numpy()
    low, nearby = _chosen(spectrum, covariance, resolved & (nu <= BAND))
    if len(low) >= LEAST_BINS:
        s_zero, exponent = _fits(low, nearby, beyond_gauss)
    else:
        s_zero = exponent = Value(math.nan, math.nan, _no_fit(spectrum[spectrum["nu"] <= BAND]))
    s_peak, nu_peak = _peak(*_chosen(spectrum, covariance, resolved & (nu >= PEAK[0]) & (nu <= PEAK[1])))
    return Hyperuniformity(s_zero, s_peak, nu_peak, _ratio(s_zero, s_peak), exponent)


def beyond_gauss(n: int, d: int) -> float:
    """Bound what fourth cumulants add to the relative covariance of powers, or take from it.

    Parameters
    ----------
    n : int
        Points.
    d : int
        Dimensions.

    Returns
    -------
    float
        0.54 (3/2)^d / n.

    Notes
    -----
    Keep each point of a hyperuniform pattern with probability p = 1 - q. At small k the amplitudes are then
    sums of independent variables, q or -p. Their fourth cumulants, and the division by the number of points,
    give any two powers the relative covariance ((1 - 6 p q) / q - 2 (1 - 2 p) + q) t / n, where t = |W| times
    the integral of h^4 is at most (3/2)^d for sine tapers. It is 0 for p -> 0 (Poisson points) and least,
    -0.54 t / n, at p = 0.42. Beyond p = 0.7 it is above 0 and grows: there S is that of the q n / p points
    which are missing, and their number sets its error.
    """
    return float(FOURTH_CUMULANTS * 1.5**d / n)


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


def _fits(low: pd.DataFrame, covariance: FloatArray, beyond_gauss: float) -> tuple[Value, Value]:
    """Fit S at 0 and the exponent to the bins of the low band."""
    k, s, degrees = low["k"].to_numpy(), low["S"].to_numpy(), 1 / np.diag(covariance)
    u, mean = (k / k[-1]) ** 2, float(np.average(s, weights=degrees))
    powers = np.stack([np.ones(len(low)), u, u**2], axis=1)
    fit = gamma_regression(powers, s, degrees, np.array([mean, 0.0, 0.0]))
    counted, _ = errors(powers / fit.means[:, None], covariance, beyond_gauss)
    interval = profile_interval(powers, s, covariance, fit, beyond_gauss)
    s_zero = Value(float(fit.coefficients[0]), math.sqrt(float(counted[0, 0])), interval=interval)
    logs = np.stack([np.ones(len(low)), np.log(k / k[-1]), u], axis=1)
    fit = gamma_regression(logs, s, degrees, np.array([math.log(mean), 0.0, 0.0]), log=True)
    counted, _ = errors(logs, covariance, beyond_gauss)
    return s_zero, Value.normal(float(fit.coefficients[1]), math.sqrt(float(counted[1, 1])))


def _ratio(s_zero: Value, s_peak: Value) -> Value:
    """Divide, the errors of both being independent."""
    if s_zero.reason or s_peak.reason:
        return Value(math.nan, math.nan, s_zero.reason or s_peak.reason)
    h = s_zero.value / s_peak.value
    of_peak = abs(h) * s_peak.error / s_peak.value
    # Each arm as if both were normal (Zou & Donner 2008).
    below, above = (
        math.hypot((end - s_zero.value) / s_peak.value, NORMAL_95 * of_peak) for end in s_zero.interval
    )
    return Value(h, math.hypot(s_zero.error / s_peak.value, of_peak), interval=(h - below, h + above))


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
    return Value.normal(float(part.sum()), error), float(weight @ nu[top])
