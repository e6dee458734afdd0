"""Settings of a spectrum: its frequencies and its accuracy, for point sets of any size."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.bands import Band, separate_bands
from gbnbench.analysis.spectrum.limits import cube_fits, default_fmax, default_radius
from gbnbench.analysis.spectrum.listed_shells import default_shells
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.analysis.spectrum.spectrum_plan import SpectrumPlan
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class SpectrumSettings:
    """Frequencies and accuracy of a spectrum, which can be planned before there are points.

    Attributes
    ----------
    fmax : int or None
        Largest harmonic on each axis. If None, it is the end of the band, or else the default for shells or
        cubes.
    half, shells, corners : bool
        Evaluate half a cube; shells in place of a cube; shells with the corners of the cube.
    band : (float, float), tuple of such pairs, or None
        Smallest and largest |f|, for shells; of several bands, the shells of each.
    frequencies : (m, d) int64 or None
        Frequencies in place of a cube.
    precision : {"double", "float"}
        As in ``gbnbench.periodogram``.
    floor : float or None
        Smallest power that must be known to 1%.
    sigma : float or None
        Width of a Gaussian, in spacings, with which points are convolved.
    """

    fmax: int | None = None
    half: bool = False
    shells: bool = False
    band: Band | tuple[Band, ...] | None = None
    corners: bool = False
    frequencies: NDArray[np.int64] | None = None
    precision: PrecisionName = "double"
    floor: float | None = None
    sigma: float | None = None

    def affordable(self, n: int, d: int, sides: Sides | None = None) -> SpectrumSettings:
        """Return these settings, or shells where nothing was asked for and the default cube does not fit.

        Parameters
        ----------
        n, d : int
            Points in a set, and dimension.
        sides : tuple of d floats, optional
            As ``as_sides`` returns them; a cube if not given.

        Returns
        -------
        SpectrumSettings
        """
        by_default = self.fmax is None and self.frequencies is None and not (self.half or self.shells)
        fits = not by_default or sides is not None or cube_fits(default_fmax(n, d), d)
        return self if fits else replace(self, shells=True)

    def largest_harmonic(self, n: int, d: int, sides: Sides | None = None) -> int:
        """Return the largest harmonic on each axis, or |k|, for sets of n points in d dimensions.

        Parameters
        ----------
        n, d : int
            Points in a set, and dimension.
        sides : tuple of d floats, optional
            As ``as_sides`` returns them; a cube if not given.

        Returns
        -------
        int
        """
        if self.frequencies is not None:
            return max(abs(int(self.frequencies.max())), abs(int(self.frequencies.min())))
        if self.fmax is not None:
            return self.fmax
        if self.band is not None:
            return max(1, math.ceil(max(one[1] for one in separate_bands(self.band) if one is not None)))
        if sides is not None:
            return default_radius(n, d, 1, sides)
        return default_shells(n, d)[0] if self.shells else default_fmax(n, d)

    def shell_band(self, n: int, d: int, sides: Sides | None = None) -> Band | tuple[Band, ...] | None:
        """Return the band or bands of the shells, which is the default one where no end was given.

        Parameters
        ----------
        n, d : int
            Points in a set, and dimension.
        sides : tuple of d floats, optional
            As ``as_sides`` returns them; a cube if not given.

        Returns
        -------
        (float, float), tuple of such pairs, or None
        """
        by_default = self.shells and self.band is None and self.fmax is None and not self.corners
        return default_shells(n, d)[1] if by_default and sides is None else self.band

    def plans(self, n: int, d: int, realizations: int, sides: Sides | None = None) -> list[SpectrumPlan]:
        """Choose the evaluators, before there are any points.

        Parameters
        ----------
        n, d, realizations : int
            Points in a set, dimension, and number of sets.
        sides : tuple of d floats, optional
            As ``as_sides`` returns them; a cube if not given.

        Returns
        -------
        list of SpectrumPlan
            One, or one for each band.

        Raises
        ------
        InputError
            As ``gbnbench.plan`` does.
        """
        found = []
        for band in separate_bands(self.shell_band(n, d, sides)):
            one = (
                self
                if self.band is None
                else replace(self, band=None if band is None else (band[0], band[1]))
            )
            found.append(
                plan(
                    n,
                    d,
                    one.largest_harmonic(n, d, sides),
                    self.precision,
                    realizations=realizations,
                    frequencies=None if self.frequencies is None else len(self.frequencies),
                    half=self.half,
                    shells=self.shells,
                    band=band,
                    corners=self.corners,
                    floor=self.floor,
                    sides=sides,
                )
            )
        return found

    def evaluate(
        self,
        x: FloatArray,
        weights: FloatArray | None = None,
        progress: Callable[[float], None] | None = None,
        sides: Sides | None = None,
    ) -> Spectrum | ShellSpectrum:
        """Evaluate the spectrum of given points.

        Parameters
        ----------
        x : (realizations, n, d) float64
            Points on the unit torus, averaged over realizations.
        weights : (n,) or (realizations, n) float64, optional
            Weights of the points.
        progress : callable, optional
            Called now and then with the share done, of shells.
        sides : tuple of d floats, optional
            As ``as_sides`` returns them; a cube if not given.

        Returns
        -------
        Spectrum, or ShellSpectrum for shells
        """
        spectrum = self._unfiltered(x, weights, progress, sides)
        return spectrum if self.sigma is None else spectrum.filtered(self.sigma)

    def _unfiltered(
        self,
        x: FloatArray,
        weights: FloatArray | None,
        progress: Callable[[float], None] | None,
        sides: Sides | None,
    ) -> Spectrum | ShellSpectrum:
        """Evaluate the spectrum of the points as they are."""
        if self.frequencies is not None:
            return periodogram(
                x,
                precision=self.precision,
                frequencies=self.frequencies,
                weights=weights,
                floor=self.floor,
                sides=sides,
            )
        _, n, d = x.shape
        fmax = self.largest_harmonic(n, d, sides)
        if self.shells:
            several = len(separate_bands(self.band)) > 1
            return shells(
                x,
                self.fmax if several else fmax,
                self.precision,
                band=self.shell_band(n, d, sides),
                corners=self.corners,
                weights=weights,
                floor=self.floor,
                progress=progress,
                sides=sides,
            )
        return periodogram(
            x, fmax, self.precision, weights=weights, half=self.half, floor=self.floor, sides=sides
        )
