"""Power of every set at the frequencies of a cube, or of a ball that is listed, with their exact shells."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.radial_power import mean_over_groups, shells_of
from gbnbench.analysis.spectrum.ball_power import half_band
from gbnbench.analysis.spectrum.box_shells import harmonics_within, listed_box_shells, pooled
from gbnbench.analysis.spectrum.limits import (
    LARGEST_NU,
    MOST_FREQUENCIES,
    MOST_KEPT,
    check_fmax,
    check_positive,
    cube_fits,
    default_fmax,
    default_radius,
)
from gbnbench.analysis.spectrum.listed_shells import (
    MOST_COORDINATES,
    MOST_TERMS,
    affordable_square,
    half_ball,
    largest_square,
)
from gbnbench.analysis.spectrum.periodogram import each_listed_power, each_power
from gbnbench.analysis.spectrum.shells import Shells, exact_shells, listed_shells, squared_radius
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import RadialPower, ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import Sides, squared_lengths
from gbnbench.core.torus import FloatArray

SHORTER = 0.9  # factor by which the radius of a ball is lowered until its frequencies are affordable
MOST_CUBE = 1 << 28  # powers of all sets together: 2 GB; beyond it a ball is listed


@dataclass(frozen=True)
class SetPowers:
    """Power of every set, and its mean, at the frequencies of a cube or of one half of a ball.

    Attributes
    ----------
    powers : (realizations, ...) float64
        Of each set: cubes, or (m,) at listed frequencies.
    spectrum : Spectrum
        Mean over the sets.
    shells : Shells
        Exact shells of these frequencies.
    most : float
        Largest |f|^2, or |k|^2 for unequal sides, of which every frequency is there.
    """

    powers: FloatArray
    spectrum: Spectrum
    shells: Shells
    most: float

    @cached_property
    def radial(self) -> RadialPower:
        """Mean power of every shell."""
        return mean_over_groups(self.spectrum.power, self.shells, self.spectrum.spacing)

    @cached_property
    def full_shells(self) -> Shells:
        """Shells with frequencies enough for a mean and a spread: pooled ones where sides are unequal."""
        return self.shells if self.spectrum.sides is None else pooled(self.shells, self.spectrum.d)

    @cached_property
    def profile(self) -> RadialPower:
        """Mean power of every full shell."""
        if self.spectrum.sides is None:
            return self.radial
        return mean_over_groups(self.spectrum.power, self.full_shells, self.spectrum.spacing)

    @property
    def listed(self) -> bool:
        """Whether the frequencies are listed, and of f and -f only one is there."""
        return self.spectrum.frequencies is not None

    @property
    def square(self) -> NDArray[np.int64] | FloatArray:
        """|f|^2 or |k|^2 of every frequency, in the order of a set's flattened powers."""
        f, sides = self.spectrum.frequencies, self.spectrum.sides
        if sides is not None:
            return (
                squared_lengths(self.spectrum.harmonics, sides).ravel()
                if f is None
                else ((f / np.array(sides)) ** 2).sum(axis=1)
            )
        if f is None:
            return squared_radius(self.spectrum.fmax, self.spectrum.d)
        squares: NDArray[np.int64] = (f * f).sum(axis=1)
        return squares

    def shell_spectrum(self) -> ShellSpectrum:
        """Mean and spread of every shell."""
        mean, deviation = self.shells.moments(self.spectrum.power)
        names = (
            "n", "d", "realizations", "fmax", "precision", "method", "device", "error_rms", "error_bound",
            "sides",
        )  # fmt: skip
        return ShellSpectrum(
            frequency=self.shells.radius,
            nu=self.shells.radius * self.spectrum.spacing,
            power=mean,
            count=self.shells.count,
            deviation=deviation,
            **{name: getattr(self.spectrum, name) for name in names},
        )


def cube_powers(points: FloatArray, fmax: int) -> SetPowers:
    """Evaluate the cube of every set.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    fmax : int
        Checked by ``check_fmax``.

    Returns
    -------
    SetPowers
    """
    powers, spectrum = each_power(points, fmax)
    shells = exact_shells(fmax, points.shape[2])
    # Every |f|^2 up to this has all its frequencies within the cube.
    return SetPowers(powers, spectrum, shells, (fmax + 1) ** 2 - 1)


def ball_powers(points: FloatArray, most: int) -> SetPowers:
    """Evaluate one half of the ball |f|^2 <= most of every set, listed frequency by frequency.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    most : int
        Largest |f|^2.

    Returns
    -------
    SetPowers
    """
    square, frequencies = half_ball(points.shape[2], most)
    powers, spectrum = each_listed_power(points, frequencies)
    return SetPowers(powers, spectrum, listed_shells(square), most)


def box_powers(points: FloatArray, radius: int, sides: Sides) -> SetPowers:
    """Evaluate the box of every set that holds the ball |k| <= radius, the torus having unequal sides.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    radius : int
        Largest |k|.
    sides : tuple of d floats
        As ``as_sides`` returns them.

    Returns
    -------
    SetPowers
    """
    powers, spectrum = each_power(points, radius, sides=sides)
    return SetPowers(powers, spectrum, shells_of(spectrum), float(radius) ** 2)


def box_ball_powers(points: FloatArray, radius: float, sides: Sides) -> SetPowers:
    """Evaluate one half of the ball |k| <= radius of every set, listed frequency by frequency.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    radius : float
        Largest |k|.
    sides : tuple of d floats
        As ``as_sides`` returns them.

    Returns
    -------
    SetPowers

    Raises
    ------
    InputError
        If no frequency lies within the ball, or too many.
    """
    frequencies, square = half_band((0.0, radius), sides)
    powers, spectrum = each_listed_power(points, frequencies, sides=sides)
    return SetPowers(powers, spectrum, listed_box_shells(square), radius**2)


def set_powers(points: FloatArray, fmax: int | None, sides: Sides | None = None) -> SetPowers:
    """Evaluate the cube of every set where that is affordable, and the shells of a ball where it is not.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    fmax : int or None
        Largest harmonic on each axis, or radius of the ball; None for the default.
    sides : tuple of d floats, optional
        As ``as_sides`` returns them; a cube if not given.

    Returns
    -------
    SetPowers

    Raises
    ------
    InputError
        If fmax is no positive integer, or neither its cube nor its ball can be held.
    """
    realizations, n, d = points.shape
    if sides is not None:
        return _box_or_ball(points, fmax, sides)
    if fmax is None:
        cube = default_fmax(n, d, realizations)
        if realizations * (2 * cube + 1) ** d <= MOST_CUBE and cube_fits(cube, d):
            return cube_powers(points, cube)
        return ball_powers(points, affordable_square(n, d, realizations))
    f = check_positive(fmax)
    if cube_fits(f, d):
        return cube_powers(points, f)
    if largest_square(d, 2 * MOST_COORDINATES // d, f * f) < f * f:
        check_fmax(f, d)  # says what would fit
    return ball_powers(points, f * f)


def _box_or_ball(points: FloatArray, fmax: int | None, sides: Sides) -> SetPowers:
    """Evaluate the box round the ball |k| <= fmax, or the ball alone where that reaches farther."""
    realizations, n, d = points.shape
    if fmax is not None:
        radius = check_positive(fmax)
        if realizations * _box_size(radius, sides) <= MOST_CUBE:
            return box_powers(points, radius, sides)
        return box_ball_powers(points, float(radius), sides)
    radius = default_radius(n, d, realizations, sides)
    boxed = realizations * _box_size(radius, sides) <= MOST_CUBE and radius > math.pow(n, 1 / d)
    if boxed and _box_size(radius, sides) <= MOST_FREQUENCIES:
        return box_powers(points, radius, sides)
    lowest = 1 / max(sides)
    most = min(MOST_COORDINATES / d, MOST_TERMS / (n * d), MOST_KEPT / realizations)
    reach = LARGEST_NU * math.pow(n, 1 / d) + 1
    while reach > lowest and not _affordable(reach, sides, most):
        reach *= SHORTER
    return box_ball_powers(points, max(reach, lowest), sides)


def _box_size(radius: float, sides: Sides) -> int:
    return math.prod(2 * f + 1 for f in harmonics_within(radius, sides))


def _affordable(radius: float, sides: Sides, most: float) -> bool:
    try:
        return len(half_band((0.0, radius), sides, int(most))[1]) <= most
    except InputError:  # more than are listed
        return False


def farther_powers(points: FloatArray, near: SetPowers) -> SetPowers | None:
    """Evaluate the shells of a ball that reaches beyond a default cube.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    near : SetPowers
        Of the cube.

    Returns
    -------
    SetPowers or None
        None where no farther shell is affordable, and where sides are unequal.
    """
    if near.spectrum.sides is not None:
        return None
    realizations, n, d = points.shape
    most = affordable_square(n, d, realizations)
    return ball_powers(points, most) if most > max(near.most, near.spectrum.fmax**2) else None
