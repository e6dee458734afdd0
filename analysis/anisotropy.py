"""Anisotropy: variance of the power around each exact shell's own mean (after Ulichney 1988), in decibels."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gbnbench.analysis.profile import ROUNDING
from gbnbench.analysis.shells import EDGE, Shells, exact_shells, in_band, ring_of
from gbnbench.errors import InputError, RefusalError
from gbnbench.results import Spectrum
from gbnbench.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

EQUAL = 1e-20  # relative variance that is rounding
BAND = (0.1, 1.0)  # nu of the shells that the scalar pools


def shell_variance(power: FloatArray, shells: Shells, realizations: int) -> tuple[FloatArray, FloatArray]:
    """Unbiased relative variance of each shell: numerator and degrees of freedom.

    Parameters
    ----------
    power : (2*fmax+1,)*d float64
        Power averaged over realizations.
    shells : Shells
        Its exact shells.
    realizations : int
        M, the number of sets averaged.

    Returns
    -------
    deviation : (size,) float64
        (M m + 1)/(M m) times the sum over the m frequencies of one half space of (p / mean - 1)^2.
    freedom : (size,) float64
        m - 1; 0 for shells of a single pair or with no power beyond rounding, which say nothing.
    """
    mean = shells.mean(power)
    m = shells.count / 2
    usable = (m >= 2) & (mean > ROUNDING)
    scale = np.zeros(shells.size + 1)
    scale[:-1][usable] = 1 / mean[usable]
    relative = (power.ravel() * scale[shells.label] - 1) ** 2
    squares = shells.sum(relative) / 2  # each pair f, -f stands twice in the cube
    deviation = np.where(usable, (1 + 1 / (realizations * m)) * squares, 0.0)
    return deviation, np.where(usable, m - 1, 0.0)


def anisotropy_db(power: FloatArray, shells: Shells, realizations: int, spacing: float) -> float:
    """Scalar anisotropy of a bare cube: shells with 0.1 <= nu <= 1 pooled, dB.

    Raises
    ------
    RefusalError
        If no shell of that band has two independent frequencies, the spectrum ends within the band,
        most of it holds only rounding, or the powers of each shell are equal to rounding.
    """
    deviation, freedom = shell_variance(power, shells, realizations)
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
    import pandas as pd

    if spectrum.frequencies is not None:
        raise InputError("anisotropy needs a whole cube: periodogram(x, fmax), not listed frequencies")
    shells = exact_shells(spectrum.fmax, spectrum.d)
    deviation, freedom = shell_variance(spectrum.power, shells, spectrum.realizations)
    ring = ring_of(shells)
    rings = np.arange(1, ring.max() + 1)
    total_deviation, total_freedom = (np.bincount(ring, w, len(rings) + 1)[1:] for w in (deviation, freedom))
    m = np.bincount(ring, shells.count, len(rings) + 1)[1:] / 2
    first = np.bincount(ring, shells.sum(spectrum.power), len(rings) + 1)[1:] / 2
    second = np.bincount(ring, shells.sum(spectrum.power**2), len(rings) + 1)[1:] / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        ours = 10 * np.log10(total_deviation / total_freedom)
        mean = first / m
        psa = 10 * np.log10((second - m * mean**2) / (m - 1) / mean**2)
    psa[mean <= ROUNDING] = np.nan
    return pd.DataFrame(
        {"frequency": rings, "nu": rings * spectrum.spacing, "anisotropy_db": ours, "psa_db": psa}
    )
