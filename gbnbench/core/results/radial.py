"""The power of point sets averaged over shells of equal |f|."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.results.resolution import gaussian_response, resolvable_power
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray, spacing

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class RadialPower:
    """Mean power on shells, DC excluded.

    Attributes
    ----------
    frequency : (s,) float64
        Radius |f| of each shell (or mean radius of each annulus), ascending, cycles per unit length.
    nu : (s,) float64
        frequency * n**(-1/d).
    power : (s,) float64
        Mean over the shell's frequencies, over the whole space.
    count : (s,) int64
        Frequencies in the shell, over the whole space.
    """

    frequency: FloatArray
    nu: FloatArray
    power: FloatArray
    count: NDArray[np.int64]

    def filtered(self, sigma: float) -> RadialPower:
        """Radial power of the points convolved with a Gaussian of width sigma, in spacings."""
        return replace(self, power=self.power * gaussian_response(self.nu, sigma))

    def to_frame(self) -> pd.DataFrame:
        """Columns frequency, nu, power, count."""
        import pandas as pd

        return pd.DataFrame(
            {"frequency": self.frequency, "nu": self.nu, "power": self.power, "count": self.count}
        )


@dataclass(frozen=True)
class ShellSpectrum:
    """Mean and spread, on exact shells of |f|, of the power averaged over realizations; DC is excluded.

    The result of ``gbnbench.shells``.

    Attributes
    ----------
    frequency : (s,) float64
        Radius |f| of each shell that holds a frequency, ascending, cycles per unit length.
    nu : (s,) float64
        frequency * n**(-1/d).
    power : (s,) float64
        Mean over the shell.
    count : (s,) int64
        Frequencies in the shell, over the whole space.
    deviation : (s,) float64
        Sum of (p - mean)^2 over the count/2 frequencies of one half space.
    n, d, realizations, fmax : int
        Points a set, dimension, sets averaged, largest harmonic on each axis.
    sides : tuple of d floats or None
        Sides of the torus, of volume 1; None for a cube. Radii are then |k|, k_a = f_a / s_a.
    precision, method, device : str
        "double" or "float", the name of the evaluator, and the device it ran on.
    error_rms, error_bound : float
        Typical and worst error of the square root of one frequency's power.
    gaps : bool
        Whether shells between the first and the last are missing, as of several bands.

    Examples
    --------
    >>> import gbnbench
    >>> result = gbnbench.shells(gbnbench.generate("random", n=100, d=3, seed=1), fmax=3)
    >>> result.count[:3].tolist()  # |f|^2 = 1, 2 and 3
    [6, 12, 8]
    >>> list(result.to_frame().columns)
    ['frequency', 'nu', 'power', 'count', 'deviation']
    """

    frequency: FloatArray
    nu: FloatArray
    power: FloatArray
    count: NDArray[np.int64]
    deviation: FloatArray
    n: int
    d: int
    realizations: int
    fmax: int
    precision: str = "double"
    method: str = ""
    device: str = ""
    error_rms: float = math.nan
    error_bound: float = math.nan
    sides: Sides | None = None
    gaps: bool = False

    @property
    def spacing(self) -> float:
        """n**(-1/d), so that nu = |f| * spacing."""
        return spacing(self.n, self.d)

    def filtered(self, sigma: float) -> ShellSpectrum:
        """Shells of the points convolved with a Gaussian of width sigma, in spacings."""
        response = gaussian_response(self.nu, sigma)
        return replace(self, power=self.power * response, deviation=self.deviation * response**2)

    def radial(self) -> RadialPower:
        """Return the means alone, which ``gbnbench.radial`` computes from a whole cube."""
        return RadialPower(self.frequency, self.nu, self.power, self.count)

    def to_frame(self) -> pd.DataFrame:
        """Columns frequency, nu, power, count, deviation."""
        return self.radial().to_frame().assign(deviation=self.deviation)

    @property
    def resolvable(self) -> float:
        """Smallest power of one frequency whose typical relative error is 1%."""
        return resolvable_power(self.error_rms)
