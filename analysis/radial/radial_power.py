"""Radial power: means of a spectrum over exact shells, digit classes or PSA's annuli (Ulichney 1988)."""

from __future__ import annotations

from gbnbench.analysis.spectrum.shells import Shells, annuli, digit_classes, exact_shells
from gbnbench.core.errors import InputError
from gbnbench.core.results import RadialPower, ShellSpectrum, Spectrum
from gbnbench.core.torus import FloatArray

GROUPINGS = ("shells", "digits", "annuli")


def radial(spectrum: Spectrum | ShellSpectrum, by: str = "shells", width: float = 2.0) -> RadialPower:
    """Mean power over frequencies of equal radius, 0 < |f| <= fmax.

    Parameters
    ----------
    spectrum : Spectrum or ShellSpectrum
        A cube or its half; or shells, which are exact ones already.
    by : {"shells", "digits", "annuli"}
        Exact shells of integer |f|^2; classes of sorted |digits| (finer, for d > 2; Ahmed, Ren & Wonka 2022,
        App. C); or PSA's annuli floor(|f| / width), so that numbers can be laid beside PSA's.
    width : float
        Of an annulus, cycles per unit length.

    Returns
    -------
    RadialPower
        Ascending in frequency; counts are over the whole space.

    Raises
    ------
    InputError
        If the spectrum is none or holds listed frequencies, or by or width is not one of the above.

    Examples
    --------
    >>> import numpy as np
    >>> from gbnbench.core.results import Spectrum
    >>> flat = Spectrum(np.ones((5, 5)), n=9, d=2, realizations=1, fmax=2)
    >>> radial(flat).count.tolist()
    [4, 4, 4]
    """
    if isinstance(spectrum, ShellSpectrum):
        if by != "shells":
            raise InputError(f'shells give radial power by="shells" alone; got by={by!r}')
        return spectrum.radial()
    if not isinstance(spectrum, Spectrum):
        raise InputError(
            f"radial takes a spectrum, radial(periodogram(x, fmax)); got {type(spectrum).__name__}"
        )
    return radial_power(spectrum.whole().power, groups_of(spectrum, by, width), spectrum.spacing)


def groups_of(spectrum: Spectrum, by: str = "shells", width: float = 2.0) -> Shells:
    """Return the grouping that ``radial`` averages over; raises as it does."""
    if spectrum.frequencies is not None:
        raise InputError("radial power needs a whole cube: periodogram(x, fmax), not listed frequencies")
    if by not in GROUPINGS:
        raise InputError(f"by must be one of {', '.join(GROUPINGS)}; got {by!r}")
    if by == "annuli":
        if not width > 0:
            raise InputError(f"width must be positive; got {width!r}")
        return annuli(spectrum.fmax, spectrum.d, float(width))
    return (digit_classes if by == "digits" else exact_shells)(spectrum.fmax, spectrum.d)


def radial_power(power: FloatArray, shells: Shells, spacing: float) -> RadialPower:
    """Radial power of a bare cube over a given grouping."""
    return RadialPower(shells.radius, shells.radius * spacing, shells.mean(power), shells.count)
