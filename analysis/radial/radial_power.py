"""Radial power: means of a spectrum over exact shells, digit classes or PSA's annuli (Ulichney 1988)."""

from __future__ import annotations

from dataclasses import replace

from numpy.typing import ArrayLike

from gbnbench.analysis.spectrum.box_shells import (
    box_annuli,
    box_shells,
    harmonics_within,
    pooled,
    pooled_spectrum,
)
from gbnbench.analysis.spectrum.shells import Shells, annuli, digit_classes, exact_shells
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import RadialPower, ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import as_sides, sides_text
from gbnbench.core.torus import FloatArray

GROUPINGS = ("shells", "pooled", "digits", "annuli")


def radial(
    spectrum: Spectrum | ShellSpectrum,
    by: str = "shells",
    width: float = 2.0,
    *,
    sides: ArrayLike | None = None,
) -> RadialPower:
    """Mean power over frequencies of equal radius, 0 < |f| <= fmax.

    Parameters
    ----------
    spectrum : Spectrum or ShellSpectrum
        A cube or its half; or exact shells, which hold their means already.
    by : {"shells", "pooled", "digits", "annuli"}
        Exact shells of integer |f|^2; neighbouring shells joined until each has 2^d independent frequencies,
        less noisy where sides are unequal (``gbnbench.analysis.spectrum.box_shells``); classes of sorted
        |digits| (finer, for d > 2; Ahmed, Ren & Wonka 2022, App. C), of a cube alone; or PSA's annuli
        floor(|f| / width), so that numbers can be laid beside PSA's.
    width : float
        Width of an annulus, cycles per unit length.
    sides : (d,) array_like, optional
        Lengths of the sides of the torus that the points lie on, whose ratios count, where the spectrum was
        evaluated without them. |f| is then |k|, k_a = f_a / s_a, the torus having volume 1, and shells are
        as far as the cube holds them, |k| <= fmax / max(s_a).

    Returns
    -------
    RadialPower
        Ascending in frequency; counts are over the whole space.

    Raises
    ------
    InputError
        If the spectrum is neither of the two or holds listed frequencies, by or width is not one of the
        above, or sides do not fit: d lengths, for a whole cube.

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
        if by not in ("shells", "pooled"):
            raise InputError(f'shells give radial power by="shells" or "pooled" alone; got by={by!r}')
        if sides is not None and as_sides(sides, spectrum.d) != spectrum.sides:
            raise InputError("shells are of one torus: give its sides to gbnbench.shells(x, sides=...)")
        return (spectrum if by == "shells" else pooled_spectrum(spectrum)).radial()
    if not isinstance(spectrum, Spectrum):
        raise InputError(
            f"radial takes a spectrum, radial(periodogram(x, fmax)); got {type(spectrum).__name__}"
        )
    if sides is not None:
        spectrum = with_sides(spectrum, sides)
    return mean_over_groups(spectrum.whole().power, _groups(spectrum, by, width), spectrum.spacing)


def with_sides(spectrum: Spectrum, sides: ArrayLike) -> Spectrum:
    """Say of a spectrum which sides the torus of its points has.

    Parameters
    ----------
    spectrum : Spectrum
        Of any kind; of a cube where the sides are unequal.
    sides : (d,) array_like
        Lengths of the sides, whose ratios count.

    Returns
    -------
    Spectrum
        The same power, with the sides.

    Raises
    ------
    InputError
        If sides are not d lengths, or the spectrum was evaluated for others.
    """
    lengths = as_sides(sides, spectrum.d)
    if lengths == spectrum.sides:
        return spectrum
    if spectrum.sides is not None:
        raise InputError(
            f"this spectrum was evaluated for sides {sides_text(spectrum.sides)}; got {sides!r}. Leave sides "
            "out, or evaluate it again"
        )
    return replace(spectrum, sides=lengths)


def whole_radius(spectrum: Spectrum) -> float:
    """Largest |k| within which a cube or box holds every frequency; fmax in a cube of equal sides."""
    if spectrum.sides is None:
        return float(spectrum.fmax)
    if harmonics_within(spectrum.fmax, spectrum.sides) == spectrum.harmonics:
        return float(spectrum.fmax)  # a box, which was evaluated to hold this ball
    return min(f / side for f, side in zip(spectrum.harmonics, spectrum.sides, strict=True))


def shells_of(spectrum: Spectrum) -> Shells:
    """Group the frequencies of a whole cube or box by exact shells."""
    if spectrum.sides is None:
        return exact_shells(spectrum.fmax, spectrum.d)
    return box_shells(spectrum.harmonics, spectrum.sides, whole_radius(spectrum))


def _groups(spectrum: Spectrum, by: str, width: float) -> Shells:
    """Return the groups of frequencies that ``radial`` averages over."""
    if spectrum.frequencies is not None:
        raise InputError("radial power needs a whole cube: periodogram(x, fmax), not listed frequencies")
    if by not in GROUPINGS:
        raise InputError(f"by must be one of {', '.join(GROUPINGS)}; got {by!r}")
    if by == "annuli":
        if not width > 0:
            raise InputError(f"width must be positive; got {width!r}")
        if spectrum.sides is not None:
            radius = whole_radius(spectrum)
            return box_annuli(spectrum.harmonics, spectrum.sides, radius, float(width))
        return annuli(spectrum.fmax, spectrum.d, float(width))
    if by == "digits":
        if spectrum.sides is not None:
            raise InputError('equal digits mean equal |k| only in a cube; take by="shells"')
        return digit_classes(spectrum.fmax, spectrum.d)
    groups = shells_of(spectrum)
    return groups if by == "shells" else pooled(groups, spectrum.d)


def mean_over_groups(power: FloatArray, groups: Shells, spacing: float) -> RadialPower:
    """Average the power of a cube over groups of its frequencies.

    Parameters
    ----------
    power : (2*fmax+1,)*d float64
        Power of the whole cube or box.
    groups : Shells
        Shells, digit classes or annuli of that cube or box.
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
    groups = shells_of(whole)
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
        sides=whole.sides,
    )
