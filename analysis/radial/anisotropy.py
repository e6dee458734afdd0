"""Anisotropy in decibels: relative variance of power about its exact shell's mean (after Ulichney 1988)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.profile_measures import ROUNDING_POWER
from gbnbench.analysis.radial.radial_power import shells_from_cube
from gbnbench.analysis.spectrum.box_shells import pooled_spectrum
from gbnbench.analysis.spectrum.shells import EDGE, Shells, in_band
from gbnbench.core.errors import InputError, RefusalError, ShortSpectrumError
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

ROUNDING_VARIANCE = 1e-20  # relative variance at or below which powers differ by rounding alone
BAND = (0.1, 1.0)  # nu of the shells that the scalar pools


def anisotropy(spectrum: Spectrum | ShellSpectrum) -> pd.DataFrame:
    """Anisotropy of each ring round(|f|) = k, its exact shells pooled.

    Parameters
    ----------
    spectrum : Spectrum or ShellSpectrum
        A cube or its half; or the exact shells of one, as ``gbnbench.shells`` gives them.

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
    Let shell s have m frequencies in one half space, powers p and mean P_s, averaged over M sets. Then

        anisotropy = 10 log10( sum_s (1 + 1/(M m)) sum_f (p(f)/P_s - 1)^2  /  sum_s (m - 1) )  dB,

    s running over the shells of the ring and f over the m frequencies of the shell. Ulichney (1988) takes the
    variance around the mean of an annulus; the mean of the exact shell leaves the slope of the profile out.
    The factor makes the estimate unbiased (``shell_variance``).

    Isotropic noise averaged over M sets reads -10 log10(M) dB at every M, since |F|^2 of one set is
    exponentially distributed. PSA draws its reference at -M dB, right only at M = 10.

    Where the torus has unequal sides the exact shells hold little more than mirror images, which tell nothing
    of direction: they are pooled (``gbnbench.analysis.spectrum.box_shells``), and a ring is round(|k|) = j.

    A ring of which a band holds a part (``gbnbench.shells(x, band=...)``) pools the shells that it holds.

    References
    ----------
    Ulichney, "Dithering with blue noise", Proceedings of the IEEE 76(1), 1988. Schlömer & Deussen, "Accurate
    spectral analysis of two-dimensional point sets", Journal of Graphics, GPU, and Game Tools 15(3), 2011.

    Examples
    --------
    >>> import gbnbench
    >>> table = anisotropy(gbnbench.periodogram(gbnbench.generate("random", n=256, seed=1), fmax=16))
    >>> bool(abs(table.anisotropy_db.iloc[3:].mean()) < 0.5)  # 0 dB for one isotropic set
    True
    """
    import pandas as pd

    return pd.DataFrame(anisotropy_columns(spectrum))


def anisotropy_columns(spectrum: Spectrum | ShellSpectrum) -> dict[str, NDArray[Any]]:
    """Columns of ``anisotropy`` by name, for a process that does not load pandas."""
    if isinstance(spectrum, Spectrum):
        if spectrum.frequencies is not None:
            raise InputError("anisotropy needs a whole cube: periodogram(x, fmax), not listed frequencies")
        shells = shells_from_cube(spectrum)
    else:
        shells = spectrum
    if shells.sides is not None:
        shells = pooled_spectrum(shells)
    m = shells.count / 2
    deviation, freedom = shell_variance(shells.power, shells.deviation, m, shells.realizations)
    rings, ring = np.unique(np.rint(shells.frequency).astype(np.int64), return_inverse=True)

    def pooled(values: FloatArray) -> FloatArray:
        return np.bincount(ring, values, len(rings)).astype(np.float64, copy=False)

    total = pooled(m)
    with np.errstate(divide="ignore", invalid="ignore"):
        ours = 10 * np.log10(pooled(deviation) / pooled(freedom))
        mean = pooled(m * shells.power) / total
        around = pooled(shells.deviation + m * (shells.power - mean[ring]) ** 2)
        psa = 10 * np.log10(around / (total - 1) / mean**2)
    psa[mean <= ROUNDING_POWER] = np.nan
    return {"frequency": rings, "nu": rings * shells.spacing, "anisotropy_db": ours, "psa_db": psa}


def anisotropy_db(power: FloatArray, shells: Shells, realizations: int, spacing: float) -> float:
    """Scalar anisotropy of a cube: the formula of ``anisotropy``, all shells with 0.1 <= nu <= 1 pooled.

    Parameters
    ----------
    power : (2*fmax+1,)*d float64
        Power of the whole cube or box, averaged over the sets.
    shells : Shells
        Exact shells of that cube; pooled ones where the torus has unequal sides.
    realizations : int
        M, the number of sets averaged.
    spacing : float
        n**(-1/d), so that nu = |f| * spacing.

    Returns
    -------
    float
        Decibels; -10 log10(M) in expectation for isotropic noise.

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
        raise ShortSpectrumError(
            f"anisotropy pools shells up to nu = 1; this spectrum ends at nu = {nu[-1]:.3g}"
        )
    band = in_band(nu, *BAND)
    possible = np.maximum(shells.count[band] / 2 - 1, 0).sum()
    if possible == 0:
        raise RefusalError("no shell with 0.1 <= nu <= 1 has two independent frequencies")
    if freedom[band].sum() < possible / 2:
        raise RefusalError(
            "most frequencies with 0.1 <= nu <= 1 hold no power beyond rounding, as a lattice's do"
        )
    variance = float(deviation[band].sum() / freedom[band].sum())
    if variance <= ROUNDING_VARIANCE:
        raise RefusalError("the powers of each shell with 0.1 <= nu <= 1 are equal to rounding")
    return 10 * math.log10(variance)


def shell_variance(
    mean: FloatArray, deviation: FloatArray, m: FloatArray, realizations: int
) -> tuple[FloatArray, FloatArray]:
    """Unbiased relative variance of each shell, as numerator and degrees of freedom.

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
    usable = (m >= 2) & (mean > ROUNDING_POWER)
    relative = np.zeros(len(mean))
    relative[usable] = (1 + 1 / (realizations * m[usable])) * (deviation[usable] / mean[usable] ** 2)
    return relative, np.where(usable, m - 1, 0.0)
