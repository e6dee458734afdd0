"""Power of every set at the frequencies of a cube, or of a ball that is listed, with their exact shells."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.radial_power import mean_over_groups, shells_of
from gbnbench.analysis.spectrum.ball_power import half_band
from gbnbench.analysis.spectrum.box_shells import listed_box_shells, pooled
from gbnbench.analysis.spectrum.listed_shells import (
    half_ball,
)
from gbnbench.analysis.spectrum.periodogram import each_listed_power, each_power
from gbnbench.analysis.spectrum.shells import Shells, exact_shells, listed_shells, squared_radius
from gbnbench.core.results.radial import RadialPower, ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import Sides, squared_lengths
from gbnbench.core.torus import FloatArray


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
