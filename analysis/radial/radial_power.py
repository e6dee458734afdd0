"""Radial power: means of a spectrum over exact shells, digit classes or PSA's annuli (Ulichney 1988)."""

from __future__ import annotations

from gbnbench.analysis.spectrum.shells import Shells, annuli, digit_classes, exact_shells
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import RadialPower, ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray

GROUPINGS = ("shells", "digits", "annuli")


def radial(spectrum: Spectrum | ShellSpectrum, by: str = "shells", width: float = 2.0) -> RadialPower:
    """Mean power over frequencies of equal radius, 0 < |f| <= fmax.

    Parameters
    ----------
    spectrum : Spectrum or ShellSpectrum
        A cube or its half; or exact shells, which hold their means already.
    by : {"shells", "digits", "annuli"}
        Exact shells of integer |f|^2; classes of sorted |digits| (finer, for d > 2; Ahmed, Ren & Wonka 2022,
        App. C); or PSA's annuli floor(|f| / width), so that numbers can be laid beside PSA's.
    width : float
        Width of an annulus, cycles per unit length.

    Returns
    -------
    RadialPower
        Ascending in frequency; counts are over the whole space.

    Raises
    ------
    InputError
        If the spectrum is neither of the two or holds listed frequencies, or by or width is not one of the
        above.

    Notes
    -----
    P(r) = (1 / N_r) * sum of P(f) over the N_r frequencies of the shell |f| = r.

    Examples
    --------
    >>> import numpy as np
    >>> from gbnbench.core.results.spectrum import Spectrum
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
    return mean_over_groups(spectrum.whole().power, _groups(spectrum, by, width), spectrum.spacing)


def _groups(spectrum: Spectrum, by: str, width: float) -> Shells:
    """Return the groups of frequencies that ``radial`` averages over."""
    if spectrum.frequencies is not None:
        raise InputError("radial power needs a whole cube: periodogram(x, fmax), not listed frequencies")
    if by not in GROUPINGS:
        raise InputError(f"by must be one of {', '.join(GROUPINGS)}; got {by!r}")
    if by == "annuli":
        if not width > 0:
            raise InputError(f"width must be positive; got {width!r}")
        return annuli(spectrum.fmax, spectrum.d, float(width))
    return (digit_classes if by == "digits" else exact_shells)(spectrum.fmax, spectrum.d)


def mean_over_groups(power: FloatArray, groups: Shells, spacing: float) -> RadialPower:
    """Average the power of a cube over groups of its frequencies.

    Parameters
    ----------
    power : (2*fmax+1,)*d float64
        Power of the whole cube.
    groups : Shells
        Shells, digit classes or annuli of that cube.
    spacing : float
        n**(-1/d), so that nu = |f| * spacing.

    Returns
    -------
    RadialPower
        One row a group.
    """
    return RadialPower(groups.radius, groups.radius * spacing, groups.mean(power), groups.count)


def shells_from_cube(spectrum: Spectrum) -> ShellSpectrum:
    """Mean and spread of a cube's exact shells; ``gbnbench.shells`` computes them without the cube."""
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
