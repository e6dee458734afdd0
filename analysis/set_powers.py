"""Power of every set at the frequencies of a cube, or of a ball that is listed, with their exact shells."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.radial_power import mean_over_groups
from gbnbench.analysis.spectrum.limits import check_fmax, check_positive, cube_fits, default_fmax
from gbnbench.analysis.spectrum.listed_shells import (
    MOST_COORDINATES,
    affordable_square,
    half_ball,
    largest_square,
)
from gbnbench.analysis.spectrum.periodogram import each_listed_power, each_power
from gbnbench.analysis.spectrum.shells import Shells, exact_shells, listed_shells, squared_radius
from gbnbench.core.results.radial import RadialPower, ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray

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
    most : int
        Largest |f|^2 of which every frequency is there.
    """

    powers: FloatArray
    spectrum: Spectrum
    shells: Shells
    most: int

    @cached_property
    def radial(self) -> RadialPower:
        """Mean power of every shell."""
        return mean_over_groups(self.spectrum.power, self.shells, self.spectrum.spacing)

    @property
    def listed(self) -> bool:
        """Whether the frequencies are listed, and of f and -f only one is there."""
        return self.spectrum.frequencies is not None

    @property
    def square(self) -> NDArray[np.int64]:
        """|f|^2 of every frequency, in the order of a set's flattened powers."""
        f = self.spectrum.frequencies
        if f is None:
            return squared_radius(self.spectrum.fmax, self.spectrum.d)
        squares: NDArray[np.int64] = (f * f).sum(axis=1)
        return squares

    def shell_spectrum(self) -> ShellSpectrum:
        """Mean and spread of every shell."""
        mean, deviation = self.shells.moments(self.spectrum.power)
        names = (
            "n", "d", "realizations", "fmax", "precision", "method", "device", "error_rms", "error_bound"
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
    """
    square, frequencies = half_ball(points.shape[2], most)
    powers, spectrum = each_listed_power(points, frequencies)
    return SetPowers(powers, spectrum, listed_shells(square), most)


def set_powers(points: FloatArray, fmax: int | None) -> SetPowers:
    """Evaluate the cube of every set where that is affordable, and the shells of a ball where it is not.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    fmax : int or None
        Largest harmonic on each axis, or radius of the ball; None for the default.

    Raises
    ------
    InputError
        If fmax is no positive integer, or neither its cube nor its ball can be held.
    """
    realizations, n, d = points.shape
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


def farther_powers(points: FloatArray, near: SetPowers) -> SetPowers | None:
    """Evaluate the shells of a ball that reaches beyond a default cube; None where none is affordable."""
    realizations, n, d = points.shape
    most = affordable_square(n, d, realizations)
    return ball_powers(points, most) if most > max(near.most, near.spectrum.fmax**2) else None
