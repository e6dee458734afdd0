"""The power of point sets at single frequencies."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.results.resolution import gaussian_response, resolvable_power
from gbnbench.core.sides import Sides, squared_lengths, wave_numbers
from gbnbench.core.torus import FloatArray, spacing


@dataclass(frozen=True)
class Spectrum:
    """Power at integer frequencies, averaged over realizations: the result of ``gbnbench.periodogram``.

    It may be indexed and computed with as its array ``power``.

    Attributes
    ----------
    power : (2*fmax+1,)*d, (fmax+1, 2*fmax+1, ...) or (m,) float64
        1 in expectation for white noise. The cube has DC at its centre, where it equals n, and axis a is
        coordinate a. A half cube begins at f_0 = 0. For listed frequencies it is (m,), in their order. Where
        the torus has unequal sides it is a box, 2*f_a+1 long on axis a with f_a = floor(fmax s_a).
    n, d, realizations : int
        Points a set, dimension, sets averaged.
    fmax : int
        Largest harmonic on each axis, cycles per unit length; for unequal sides the radius |k| up to which
        the box holds every frequency.
    frequencies : (m, d) int64 or None
        The listed frequencies; None for a cube.
    precision, method, device : str
        "double" or "float", the name of the evaluator, and the device it ran on.
    error_rms, error_bound : float
        Typical and worst error of the square root of a power, at any of these frequencies: a power P is off
        by at most 2 sqrt(P) error_bound + error_bound**2.
    half, weighted : bool
        Whether only f_0 >= 0 is held, and whether points had weights.
    sides : tuple of d floats or None
        Sides of the torus, of volume 1; None for a cube.

    Examples
    --------
    >>> import gbnbench
    >>> spectrum = gbnbench.periodogram(gbnbench.generate("grid", n=16, d=2), fmax=4)
    >>> spectrum.shape, round(float(spectrum[4, 4]), 9), round(float(spectrum[8, 4]), 9)  # DC, and f = (4, 0)
    ((9, 9), 16.0, 16.0)
    """

    power: FloatArray
    n: int
    d: int
    realizations: int
    fmax: int
    frequencies: NDArray[np.int64] | None = None
    precision: str = "double"
    method: str = ""
    device: str = ""
    error_rms: float = math.nan
    error_bound: float = math.nan
    half: bool = False
    weighted: bool = False
    sides: Sides | None = None

    def whole(self) -> Spectrum:
        """Return the spectrum of the whole cube, a half completed by P(-f) = P(f)."""
        if not self.half:
            return self
        first = self.harmonics[0]
        cube = np.empty((2 * first + 1, *self.power.shape[1:]))
        cube[first:] = self.power
        cube[: first + 1] = np.flip(self.power)
        return replace(self, power=cube, half=False)

    def filtered(self, sigma: float) -> Spectrum:
        """Spectrum of the points convolved with a Gaussian of width sigma (Ahmed, Ren & Wonka 2022, Fig. 7b).

        ``sigma`` is in spacings n**(-1/d).

        Raises
        ------
        InputError
            If sigma is not a number of at least 0.
        """
        if self.frequencies is not None:
            radius = wave_numbers(self.frequencies, self.sides)
        else:
            radius = np.sqrt(squared_lengths(self.harmonics, self.sides))
            if self.half:
                radius = radius[self.harmonics[0] :]
        response = gaussian_response(radius * self.spacing, sigma)
        return replace(self, power=self.power * response)

    @property
    def harmonics(self) -> tuple[int, ...]:
        """Largest harmonic on each axis of a cube or box."""
        first, *others = self.power.shape
        return (first - 1 if self.half else first // 2, *(size // 2 for size in others))

    @property
    def resolvable(self) -> float:
        """Smallest power whose typical relative error is 1%: about (200 error_rms)^2."""
        return resolvable_power(self.error_rms)

    @property
    def spacing(self) -> float:
        """n**(-1/d), so that nu = |f| * spacing."""
        return spacing(self.n, self.d)

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of ``power``."""
        return self.power.shape

    def __len__(self) -> int:
        return len(self.power)

    def __getitem__(self, index: Any) -> Any:
        return self.power[index]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self.power, dtype=dtype) if copy else np.asarray(self.power, dtype=dtype)
