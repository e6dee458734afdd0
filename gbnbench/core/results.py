"""Results of the analysis, frozen, each with the settings that made it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, spacing

if TYPE_CHECKING:
    import pandas as pd

RESOLVED = 0.01  # relative error up to which a power counts as known


@dataclass(frozen=True)
class Spectrum:
    """Power at integer frequencies, averaged over realizations: the result of ``gbnbench.periodogram``.

    It may be indexed and computed with as its array ``power``.

    Attributes
    ----------
    power : (2*fmax+1,)*d, (fmax+1, 2*fmax+1, ...) or (m,) float64
        1 in expectation for white noise. The cube has DC at its centre, where it equals n, and axis a is
        coordinate a. A half cube begins at f_0 = 0. For listed frequencies it is (m,), in their order.
    n, d, realizations : int
        Points a set, dimension, sets averaged.
    fmax : int
        Largest harmonic on each axis, cycles per unit length.
    frequencies : (m, d) int64 or None
        The listed frequencies; None for a cube.
    precision, method, device : str
        "double" or "float", the name of the evaluator, and the device it ran on.
    error_rms, error_bound : float
        Typical and worst error of the square root of a power, at any of these frequencies: a power P is off
        by at most 2 sqrt(P) error_bound + error_bound**2.
    half, weighted : bool
        Whether only f_0 >= 0 is held, and whether points had weights.

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

    def whole(self) -> Spectrum:
        """Return the spectrum of the whole cube, a half completed by P(-f) = P(f)."""
        if not self.half:
            return self
        cube = np.empty((2 * self.fmax + 1,) * self.d)
        cube[self.fmax :] = self.power
        cube[: self.fmax + 1] = np.flip(self.power)
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
            square = (self.frequencies.astype(np.float64) ** 2).sum(axis=1)
        else:
            first = self.fmax if self.half else 0
            axis = np.arange(-self.fmax, self.fmax + 1, dtype=np.float64) ** 2
            square = sum(
                (axis[first:] if a == 0 else axis).reshape([-1 if b == a else 1 for b in range(self.d)])
                for a in range(self.d)
            )
        response = gaussian_response(np.sqrt(square) * self.spacing, sigma)
        return replace(self, power=self.power * response)

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


def gaussian_response(nu: FloatArray, sigma: float) -> FloatArray:
    """Power response of a Gaussian of unit mass: exp(-(2 pi sigma nu)^2).

    Parameters
    ----------
    nu : (...) float64
        Frequencies |f| n**(-1/d).
    sigma : float
        Width of the Gaussian in spacings, >= 0.

    Returns
    -------
    (...) float64
        Factor of the power at each frequency.

    Raises
    ------
    InputError
        If sigma is not a number of at least 0.
    """
    if not (isinstance(sigma, (int, float, np.number)) and 0 <= sigma < math.inf):
        raise InputError(f"sigma must be a width of at least 0, in spacings; got {sigma!r}")
    response: FloatArray = np.exp(-((2 * math.pi * sigma * nu) ** 2))
    return response


def resolvable_power(rms: float) -> float:
    """Smallest power that is known to 1% if its square root is off by rms: about (200 rms)^2."""
    return (rms * (1 + math.sqrt(1 + RESOLVED)) / RESOLVED) ** 2


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
    precision, method, device : str
        "double" or "float", the name of the evaluator, and the device it ran on.
    error_rms, error_bound : float
        Typical and worst error of the square root of one frequency's power.

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


@dataclass(frozen=True)
class Measures(Mapping[str, float]):
    """Scalar measures by name; nan where undefined, and then ``reasons`` says why.

    Attributes
    ----------
    measured : dict
        Name -> value, for every name of ``gbnbench.analysis.measure_definitions``.
    standard_error : dict
        Standard error over realizations; nan for a single one or where the measure is undefined.
    reasons : dict
        Name -> sentence, only for measures that are undefined here.
    """

    measured: Mapping[str, float]
    standard_error: Mapping[str, float] = field(default_factory=dict)
    reasons: Mapping[str, str] = field(default_factory=dict)

    def __getitem__(self, name: str) -> float:
        return self.measured[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.measured)

    def __len__(self) -> int:
        return len(self.measured)

    def to_frame(self) -> pd.DataFrame:
        """One row a measure: columns measure, value, standard_error, reason."""
        import pandas as pd

        return pd.DataFrame(
            {
                "measure": list(self),
                "value": [self[m] for m in self],
                "standard_error": [self.standard_error.get(m, math.nan) for m in self],
                "reason": [self.reasons.get(m, "") for m in self],
            }
        )
