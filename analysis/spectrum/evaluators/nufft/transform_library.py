"""A library of non-uniform FFTs: the call of its transform, and what was measured of its time and errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gbnbench.analysis.spectrum.evaluators.optional_library import loads
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

DIMENSIONS = 3  # both libraries have transforms up to this dimension
LOOSEST = 1e-1  # tolerance up to which errors follow it

Transform = Callable[[FloatArray, Any, tuple[int, ...], float, float], Any]
"""From x - rint(x) (n, d), complex strengths (n,), modes on each axis, tolerance and upsampling factor to
complex amplitudes, of which that of the zero mode is at modes // 2 on each axis. It takes one thread, since
several add in no fixed order, so that the last digits would differ from call to call."""


Magnification = tuple[tuple[float, float], ...]
"""Tolerances, and a factor at each, between which the logarithms are interpolated."""


@dataclass(frozen=True)
class TransformCost:
    """Parts of a transform's time on one core in one dimension, in nanoseconds.

    Attributes
    ----------
    call : float
        For each call.
    axis : float
        For each pair of a grid line's point and a kernel's point, which make the Fourier series of the
        kernel.
    point, shift, cell : float
        For each point, for each point whose strength is shifted, and for each grid point that a point
        reaches.
    grid, far : float
        For each grid point and level of the FFT, and the same besides for a grid beyond the cache.
    """

    call: float
    axis: float
    point: float
    shift: float
    cell: float
    grid: float
    far: float


@dataclass(frozen=True)
class Upsampling:
    """A factor by which a library's grid exceeds the modes.

    Attributes
    ----------
    factor : float
        Grid points over modes on each axis.
    reaches : float
        Tightest tolerance at which it is taken.
    together : tuple of (float, float), optional
        ``Rounding.together`` at this factor, where it is another.
    """

    factor: float
    reaches: float = 0.0
    together: Magnification | None = None


@dataclass(frozen=True)
class Rounding:
    """Rounding errors of sqrt(power) in one dimension, in units of 2^-53, as met in measurements.

    Attributes
    ----------
    floor, harmonic : float
        On scattered points: a constant, and a factor of the largest harmonic.
    crowd, power : float
        On scattered points: a factor of the points over the number of modes to this power.
    worst, worst_harmonic : float
        Bound on coincident points, over sqrt(n): a constant and a factor of the largest harmonic.
    together : tuple of (float, float)
        The same: tolerances, and at each a factor of the points that are summed one after another. Loose
        tolerances allow small grids, whose corners magnify what is rounded in their nodes.
    most : float
        Largest number of points that are.
    """

    floor: float
    harmonic: float
    crowd: float
    power: float
    worst: float
    worst_harmonic: float
    together: Magnification
    most: float


@dataclass(frozen=True)
class Library:
    """A library of non-uniform FFTs.

    Attributes
    ----------
    name, package : str
        Its name in sentences, and that by which it is imported and installed.
    tightest : tuple of float
        Smallest tolerance by dimension that it reaches.
    upsampling : tuple of Upsampling
        Factors that it is asked to take, or takes by itself.
    narrowest : int
        Points across its narrowest kernel.
    costs : tuple of TransformCost
        Time by dimension.
    roundings : tuple of Rounding
        Rounding errors by dimension.
    typical : float
        Root mean square error on scattered points over the tolerance.
    coherent : float
        Bound on coincident points, over sqrt(n): a factor of the tolerance.
    transform : callable
        Its type 1 transform.
    """

    name: str
    package: str
    tightest: tuple[float, ...]
    upsampling: tuple[Upsampling, ...]
    narrowest: int
    costs: tuple[TransformCost, ...]
    roundings: tuple[Rounding, ...]
    typical: float
    coherent: float
    transform: Transform

    @property
    def available(self) -> bool:
        """Whether it is installed and loads here."""
        return loads(self.package)

    def check(self, d: int, tolerance: float) -> None:
        """Refuse dimensions and tolerances that it does not serve.

        Parameters
        ----------
        d : int
            Dimension.
        tolerance : float
            Relative error asked for.

        Raises
        ------
        InputError
            If d is above 3 or the tolerance is out of range.
        """
        if d > DIMENSIONS:
            raise InputError(
                f"{self.name} transforms at most {DIMENSIONS} dimensions; got d={d}. Ask for an exact method"
            )
        if not self.tightest[d - 1] <= tolerance <= LOOSEST:
            raise InputError(
                f"a tolerance of {self.name} must lie in {self.tightest[d - 1]:g} .. {LOOSEST:g} "
                f"for d={d}; got {tolerance:g}. Below that ask for an exact method"
            )
