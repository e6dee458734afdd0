"""Anisotropy: variance of the power around each exact shell's own mean (after Ulichney 1988), in decibels."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gbnbench.analysis.radial.profile import ROUNDING
from gbnbench.analysis.spectrum.shells import EDGE, Shells, exact_shells, in_band
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.results import ShellSpectrum, Spectrum
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

EQUAL = 1e-20  # relative variance that is rounding
BAND = (0.1, 1.0)  # nu of the shells that the scalar pools


def shell_variance(
    mean: FloatArray, deviation: FloatArray, m: FloatArray, realizations: int
) -> tuple[FloatArray, FloatArray]:
    """Unbiased relative variance of each shell: numerator and degrees of freedom.

    Parameters
    ----------
    mean, deviation : (size,) float64
        Mean power of each exact shell, and the sum of (p - mean)^2 over one half space.
    m : (size,) float64
        Frequencies of that half space.
    realizations : int
        M, the number of sets averaged.

    Returns
    -------
    relative : (size,) float64
        (M m + 1)/(M m) times the sum over the m frequencies of (p / mean - 1)^2.
    freedom : (size,) float64
        m - 1; 0 for shells of a single pair or with no power beyond rounding, which say nothing.
    """
    usable = (m >= 2) & (mean > ROUNDING)
    relative = np.zeros(len(mean))
    relative[usable] = (1 + 1 / (realizations * m[usable])) * (deviation[usable] / mean[usable] ** 2)
    return relative, np.where(usable, m - 1, 0.0)


def anisotropy_db(power: FloatArray, shells: Shells, realizations: int, spacing: float) -> float:
    """Scalar anisotropy of a bare cube: shells with 0.1 <= nu <= 1 pooled, dB.

    Raises
    ------
    RefusalError
        If no shell of that band has two independent frequencies, the spectrum ends within the band,
        most of it holds only rounding, or the powers of each shell are equal to rounding.
    """
    mean, spread = shells.moments(power)
    deviation, freedom = shell_variance(mean, spread, shells.count / 2, realizations)
    nu = shells.radius * spacing
    if nu[-1] < BAND[1] * (1 - EDGE):
        raise RefusalError(f"anisotropy pools shells up to nu = 1; this spectrum ends at nu = {nu[-1]:.3g}")
    band = in_band(nu, *BAND)
    possible = np.maximum(shells.count[band] / 2 - 1, 0).sum()
    if possible == 0:
        raise RefusalError("no shell with 0.1 <= nu <= 1 has two independent frequencies")
    if freedom[band].sum() < possible / 2:
        raise RefusalError(
            "most frequencies with 0.1 <= nu <= 1 hold no power beyond rounding, as a lattice's do"
        )
    variance = float(deviation[band].sum() / freedom[band].sum())
    if variance <= EQUAL:
        raise RefusalError("the powers of each shell with 0.1 <= nu <= 1 are equal to rounding")
    return 10 * math.log10(variance)


def anisotropy(spectrum: Spectrum) -> pd.DataFrame:
    """Anisotropy of each ring round(|f|) = k, its exact shells pooled.

    Parameters
    ----------
    spectrum : Spectrum
        A whole cube.

    Returns
    -------
    DataFrame
        Columns frequency (k), nu, anisotropy_db, and psa_db: PSA's form, the variance over the ring's squared
        mean, which on steep profiles takes the slope within the ring for anisotropy.

    Raises
    ------
    InputError
        If the spectrum holds listed frequencies.

    Notes
    -----
    Isotropic noise averaged over M sets reads -10 log10(M) dB at every M, since |F|^2 of one set is
    exponentially distributed. PSA draws its reference at -M dB, right only at M = 10.
    """
    if spectrum.frequencies is not None:
        raise InputError("anisotropy needs a whole cube: periodogram(x, fmax), not listed frequencies")
    return anisotropy_of_shells(shells_of(spectrum))


def anisotropy_of_shells(shells: ShellSpectrum) -> pd.DataFrame:
    """Table of ``anisotropy`` from the mean and spread of exact shells."""
    import pandas as pd

    m = shells.count / 2
    deviation, freedom = shell_variance(shells.power, shells.deviation, m, shells.realizations)
    rings, ring = np.unique(np.rint(shells.frequency).astype(np.int64), return_inverse=True)

    def pooled(values: FloatArray) -> FloatArray:
        return np.bincount(ring, values, len(rings)).astype(np.float64, copy=False)

    total = pooled(m)
    with np.errstate(divide="ignore", invalid="ignore"):
        ours = 10 * np.log10(pooled(deviation) / pooled(freedom))
        mean = pooled(m * shells.power) / total
        squares = pooled(shells.deviation + m * shells.power**2)
        psa = 10 * np.log10((squares - total * mean**2) / (total - 1) / mean**2)
    psa[mean <= ROUNDING] = np.nan
    return pd.DataFrame(
        {"frequency": rings, "nu": rings * shells.spacing, "anisotropy_db": ours, "psa_db": psa}
    )


def shells_of(spectrum: Spectrum) -> ShellSpectrum:
    """Mean and spread of a whole cube's exact shells; ``gbnbench.shells`` finds them without the cube."""
    whole = spectrum.whole()
    groups = exact_shells(whole.fmax, whole.d)
    mean, deviation = groups.moments(whole.power)
    return ShellSpectrum(
        frequency=groups.radius,
        nu=groups.radius * whole.spacing,
        power=mean,
        count=groups.count,
        deviation=deviation,
        n=whole.n,
        d=whole.d,
        realizations=whole.realizations,
        fmax=whole.fmax,
        precision=whole.precision,
        method=whole.method,
        device=whole.device,
        error_rms=whole.error_rms,
        error_bound=whole.error_bound,
    )
