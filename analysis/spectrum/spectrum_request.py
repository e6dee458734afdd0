"""What spectrum is asked for: planned for sets of any size, and found of given ones."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.limits import default_fmax, default_shell_fmax
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import Plan, plan
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.results import ShellSpectrum, Spectrum
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Asked:
    """Frequencies, and how exactly.

    Attributes
    ----------
    fmax : int or None
        Largest harmonic on each axis; None for the end of the band, else the default for shells or cubes.
    half, shells, corners : bool
        Half a cube, or shells instead of one; with their corners.
    band : (float, float) or None
        Of |f|, for shells.
    frequencies : (m, d) int64 or None
        A list instead of a cube.
    precision : {"double", "float"} or None
        As in ``gbnbench.periodogram``.
    floor : float or None
        Smallest power that must be known to 1%.
    sigma : float or None
        Width of a Gaussian, in spacings, with which points are convolved.
    """

    fmax: int | None = None
    half: bool = False
    shells: bool = False
    band: tuple[float, float] | None = None
    corners: bool = False
    frequencies: NDArray[np.int64] | None = None
    precision: str | None = None
    floor: float | None = None
    sigma: float | None = None

    def reach(self, n: int, d: int) -> int:
        """Largest harmonic for sets of n points in d dimensions."""
        if self.frequencies is not None:
            return max(abs(int(self.frequencies.max())), abs(int(self.frequencies.min())))
        if self.fmax is not None:
            return self.fmax
        if self.band is not None:
            return max(1, math.ceil(self.band[1]))
        return default_shell_fmax(n, d) if self.shells else default_fmax(n, d)

    def plan(self, n: int, d: int, realizations: int) -> Plan:
        """Choose the evaluation, before there are any points; raises as ``gbnbench.plan``."""
        return plan(
            n,
            d,
            self.reach(n, d),
            self.precision,
            realizations=realizations,
            frequencies=None if self.frequencies is None else len(self.frequencies),
            half=self.half,
            shells=self.shells,
            band=self.band,
            corners=self.corners,
            floor=self.floor,
        )

    def find(
        self,
        x: FloatArray,
        weights: FloatArray | None = None,
        progress: Callable[[float], None] | None = None,
    ) -> Spectrum | ShellSpectrum:
        """Evaluate it.

        Parameters
        ----------
        x : (realizations, n, d) float64
            Points on the unit torus, averaged over realizations.
        weights : (n,) or (realizations, n) float64, optional
            Of the points.
        progress : callable, optional
            Called now and then with the share done, of shells.

        Returns
        -------
        Spectrum, or ShellSpectrum for shells
        """
        found = self._raw(x, weights, progress)
        return found if self.sigma is None else found.filtered(self.sigma)

    def _raw(
        self, x: FloatArray, weights: FloatArray | None, progress: Callable[[float], None] | None
    ) -> Spectrum | ShellSpectrum:
        """Evaluate it, unfiltered."""
        if self.frequencies is not None:
            return periodogram(
                x,
                precision=self.precision,
                frequencies=self.frequencies,
                weights=weights,
                floor=self.floor,
            )
        fmax = self.reach(*x.shape[1:])
        if self.shells:
            return shells(
                x,
                fmax,
                self.precision,
                band=self.band,
                corners=self.corners,
                weights=weights,
                floor=self.floor,
                progress=progress,
            )
        return periodogram(x, fmax, self.precision, weights=weights, half=self.half, floor=self.floor)
