"""Variance of integration that the power spectra of points and integrands predict (Durand 2011).

Also Pilleboue, Singh, Coeurjolly, Kazhdan & Ostromoukhov 2015; Ahmed, Ren & Wonka 2022, Section 5.2.
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

# Shares of the energy that may be left out, the smallest that is affordable being taken.
SHARES = (1e-27, 1e-24, 1e-21, 1e-18, 1e-15, 1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1)
MOST_FREQUENCIES = 20_000


@dataclass(frozen=True)
class FourierSeries:
    """Energy of drawn integrands at the frequencies that hold nearly all of it.

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
        """Most energy that the frequencies left out hold; over n, the variance of white noise there."""
        return float(2 * self.energy.sum(axis=1).mean() * self.share / (1 - self.share))


def fourier_series(family: Family, integrands: Sequence[Integrand], d: int) -> FourierSeries | None:
    """Fourier series of drawn integrands, cut after at most 20,000 frequencies.

    Parameters
    ----------
    family : Family
        The family they were drawn from, which knows the frequencies that matter.
    integrands : sequence of Integrand
        The functions, all of d dimensions.
    d : int
        Dimension.

    Returns
    -------
    FourierSeries or None
        None for a family that is not periodic, or whose series is not known or too long to hold nine tenths
        of its energy.
    """
    listed = _frequencies(family, d) if family.periodic else None  # type: ignore[arg-type]  # frozen: hashable
    if listed is None:
        return None
    frequencies, share = listed
    energy = np.empty((len(integrands), len(frequencies)))
    for row, integrand in zip(energy, integrands, strict=True):
        if not isinstance(integrand, Periodic):
            raise TypeError(f"{family.name} is declared periodic and its integrands have no energy")
        row[:] = integrand.energy(frequencies)
    return FourierSeries(frequencies, energy, share)


@lru_cache(maxsize=32)
def _frequencies(family: Family, d: int) -> tuple[NDArray[np.int64], float] | None:
    """List the frequencies that leave out the smallest share of energy within the limit of their number."""
    for share in SHARES:
        try:
            return family.frequencies(d, share, MOST_FREQUENCIES), share
        except RefusalError:
            continue
    return None


def predicted_variance(series: FourierSeries, x: ArrayLike) -> FloatArray:
    """Predict the variance of each estimate over random toroidal shifts of each set from its power spectrum.

    Parameters
    ----------
    series : FourierSeries
        Energies of the integrands.
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus.

    Returns
    -------
    (integrands, realizations) float64
        (1/n) sum over f != 0 of energy(f) P(f), the inner product of the two power spectra. Exact to rounding
        where the integrand's series ends within the list. Otherwise too small by the rest of the sum, at most
        ``series.beyond`` / n if power is 1 there.

    Raises
    ------
    InputError
        If dimensions differ.

    Notes
    -----
    Durand (2011), Eq. (15), and Pilleboue et al. (2015). It holds for each set by itself if the set is
    shifted at random. It holds in the mean over sets if shifts do not change the distribution of the point
    process or that of the family of integrands.
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    if d != series.frequencies.shape[1]:
        raise InputError(f"the series is of d={series.frequencies.shape[1]}, the points of d={d}")
    power = np.array([periodogram(points, frequencies=series.frequencies).power for points in sets])
    predicted: FloatArray = 2 * series.energy @ power.T / n
    return predicted
