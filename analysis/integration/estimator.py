"""Errors of integrals estimated by the mean over points, and the variance that spectra foretell.

Durand 2011; Pilleboue, Singh, Coeurjolly, Kazhdan & Ostromoukhov 2015; Ahmed, Ren & Wonka 2022, Section 5.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.analysis.integration.integrands.protocol import Family, Integrand, Periodic
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, as_realizations

SHARES = (1e-27, 1e-24, 1e-21, 1e-18, 1e-15, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1)
MOST_FREQUENCIES = 20_000
CHUNK = 1 << 20  # points handed to an integrand at once


def estimate_errors(integrands: Sequence[Integrand], x: ArrayLike) -> FloatArray:
    """Mean over the points less the exact integral.

    Parameters
    ----------
    integrands : sequence of Integrand
        Of x's dimension.
    x : (n, d) or (realizations, n, d) float64
        Points in [0, 1)^d.

    Returns
    -------
    (integrands, realizations) float64

    Notes
    -----
    The integral is taken from each value before they are summed, in pairs: errors far below the roundings of
    the mean itself are seen, down to some 1e-16 of a value over sqrt(n).
    """
    sets = as_realizations(x)
    count, n, d = sets.shape
    block = max(1, CHUNK // n)
    errors = np.empty((len(integrands), count))
    for first in range(0, count, block):
        points = sets[first : first + block]
        for i, integrand in enumerate(integrands):
            values = integrand(points.reshape(-1, d)).reshape(points.shape[:2])
            errors[i, first : first + block] = (values - integrand.integral).mean(axis=1)
    return errors


@dataclass(frozen=True)
class FourierSeries:
    """Energy of drawn integrands where it matters.

    Attributes
    ----------
    frequencies : (m, d) int64
        One of each pair f, -f.
    energy : (integrands, m) float64
        |transform|^2 there.
    share : float
        The frequencies left out hold less than this share of the family's energy.
    """

    frequencies: NDArray[np.int64]
    energy: FloatArray
    share: float

    @property
    def beyond(self) -> float:
        """Most energy that the frequencies left out can hold: over n, what white noise there would add."""
        return float(2 * self.energy.sum(axis=1).mean() * self.share / (1 - self.share))


def fourier_series(family: Family, integrands: Sequence[Integrand], d: int) -> FourierSeries | None:
    """Fourier series of drawn integrands, as far as 20,000 frequencies reach.

    Returns
    -------
    FourierSeries or None
        None for a family that is not periodic, or whose series is not known or too long to hold nine tenths
        of its energy.
    """
    found = _frequencies(family, d) if family.periodic else None  # type: ignore[arg-type]  # frozen: hashable
    if found is None:
        return None
    frequencies, share = found
    energy = np.empty((len(integrands), len(frequencies)))
    for row, integrand in zip(energy, integrands, strict=True):
        if not isinstance(integrand, Periodic):
            raise TypeError(f"{family.name} is declared periodic and its integrands have no energy")
        row[:] = integrand.energy(frequencies)
    return FourierSeries(frequencies, energy, share)


@lru_cache(maxsize=32)
def _frequencies(family: Family, d: int) -> tuple[NDArray[np.int64], float] | None:
    """List the frequencies that leave out the least share that is affordable."""
    for share in SHARES:
        try:
            return family.frequencies(d, share, MOST_FREQUENCIES), share
        except RefusalError:
            continue
    return None


def predicted_variance(series: FourierSeries, x: ArrayLike) -> FloatArray:
    """Variance of each estimate over random toroidal shifts of each set.

    Parameters
    ----------
    series : FourierSeries
        Of the integrands.
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus.

    Returns
    -------
    (integrands, realizations) float64
        sum over f != 0 of energy(f) P(f) / n: the inner product of the two power spectra. Exact, to
        rounding, for integrands whose series ends within the list; else short of the truth by the part of the
        sum beyond it, which for white noise there is at most ``series.beyond`` / n.

    Raises
    ------
    InputError
        If dimensions differ.

    Notes
    -----
    Durand (2011), Eq. (15), and Pilleboue et al. (2015). It holds for each set by itself when the set is
    shifted at random, and in the mean over sets for any process whose law is not changed by shifts, or for
    any family whose law is not.
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    if d != series.frequencies.shape[1]:
        raise InputError(f"the series is of d={series.frequencies.shape[1]}, the points of d={d}")
    power = np.array([periodogram(points, frequencies=series.frequencies).power for points in sets])
    foretold: FloatArray = 2 * series.energy @ power.T / n
    return foretold
