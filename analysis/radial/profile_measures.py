"""Scalar measures of the radial profile: noise floor, power at 1, two fits, evacuated energy and peak.

Ahmed, Ren & Wonka 2022: Sec. 3 (exponential and power-law families), Sec. 4.3 (evacuated energy), Fig. 1(g).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.limits import FLOOR_NU
from gbnbench.analysis.spectrum.shells import EDGE, in_band, squared_radius
from gbnbench.core.errors import RefusalError, ShortSpectrumError
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.sides import Sides, squared_lengths
from gbnbench.core.torus import FloatArray

TIE = 1e-9  # relative difference at or below which two powers count as equal
FIT_BAND = (0.05, 0.6)
FIT_SHELLS = 3  # fewest shells of a fit
PEAK_BAND = (0.5, 2.0)
ROUNDING_POWER = 1e-26  # power at or below which only rounding is left, as off a lattice's harmonics
DECIBELS = 10 / math.log(10)  # one unit of the natural logarithm in dB


def reach(radial: RadialPower) -> float:
    """Return the nu of the last whole shell, |f| = fmax."""
    return float(radial.nu[-1])


def require(radial: RadialPower, nu: float, what: str) -> None:
    """Refuse a measure whose band goes beyond the end of the spectrum.

    Parameters
    ----------
    radial : RadialPower
        Power of exact shells.
    nu : float
        Upper end of the measure's band.
    what : str
        Name of the measure, for the message.

    Raises
    ------
    RefusalError
        If the last whole shell lies below nu.
    """
    if reach(radial) < nu * (1 - EDGE):
        needed = math.ceil(nu * float(radial.frequency[0] / radial.nu[0]) * (1 - EDGE))
        raise ShortSpectrumError(
            f"{what} needs every shell up to nu = {nu:g}, fmax >= {needed}; this spectrum ends at "
            f"nu = {reach(radial):.3g}"
        )


def noise_floor(radial: RadialPower) -> float:
    """Mean power over the frequencies with 0 < nu <= 0.25; over the lowest shell where there are none.

    The mean is over frequencies, not over shells (Ahmed, Ren & Wonka 2022, Sec. 3).

    Raises
    ------
    RefusalError
        If the spectrum ends within that band.
    """
    band = in_band(radial.nu, 0, FLOOR_NU)
    if not band.any():
        return float(radial.power[0])
    if not (radial.nu > FLOOR_NU * (1 + EDGE)).any():
        require(radial, FLOOR_NU, "the noise floor")
    return float(np.average(radial.power[band], weights=radial.count[band]))


def power_at_1(radial: RadialPower) -> float:
    """Mean power at |f| = 1, the lowest shell of any cube (Ahmed, Ren & Wonka 2022, Fig. 1(g))."""
    return float(radial.power[0])


@dataclass(frozen=True)
class Fit:
    """A straight line through ln P of exact shells.

    Attributes
    ----------
    intercept, slope : float
        ln P = intercept + slope * abscissa.
    residual_db : float
        Root mean square departure of ln P from the line, in dB.
    """

    intercept: float
    slope: float
    residual_db: float


def _fit(radial: RadialPower, *, logarithmic: bool) -> Fit:
    require(radial, FIT_BAND[1], "a profile fit")
    band = in_band(radial.nu, *FIT_BAND)
    shells = int(band.sum())
    if shells < FIT_SHELLS:
        raise RefusalError(
            f"a profile fit needs three shells with 0.05 <= nu <= 0.6; this spectrum has {shells}"
        )
    power = radial.power[band]
    if not (power > ROUNDING_POWER).all():
        raise RefusalError("a profile fit needs power beyond rounding on every shell with 0.05 <= nu <= 0.6")
    abscissa = np.log(radial.nu[band]) if logarithmic else radial.nu[band] ** 2
    design = np.stack([np.ones(shells), abscissa], axis=1)
    target = np.log(power)
    (intercept, slope), *_ = np.linalg.lstsq(design, target, rcond=None)
    rest = target - design @ (intercept, slope)
    return Fit(float(intercept), float(slope), float(DECIBELS * np.sqrt(np.mean(rest**2))))


def exponential_fit(radial: RadialPower) -> Fit:
    """Fit the exponential profile ln P = ln epsilon + c nu^2 to the exact shells with 0.05 <= nu <= 0.6.

    Shells count alike, however many frequencies they have. Ahmed, Ren & Wonka (2022), Eq. (19): an ideal
    Gaussian blue noise of sigma = 1 has c = 4 pi^2.

    Raises
    ------
    RefusalError
        If the band holds fewer than three shells, the spectrum ends within it, or a shell holds only
        rounding.
    """
    return _fit(radial, logarithmic=False)


def powerlaw_fit(radial: RadialPower) -> Fit:
    """Fit the power law ln P = a + b ln nu to the same shells as ``exponential_fit`` (Pilleboue et al. 2015).

    Raises
    ------
    RefusalError
        As ``exponential_fit``.
    """
    return _fit(radial, logarithmic=True)


def evacuated_energy(power: FloatArray, n: int, d: int, fmax: int, sides: Sides | None = None) -> float:
    """Evacuated energy of one set: -(1/n) sum of ln P(f) over all f with 0 < nu < 1 and P(f) < 1.

    Parameters
    ----------
    power : (2*fmax+1,)*d float64
        Power of that set alone, the whole cube or box.
    n, d, fmax : int
        Its points, dimension and largest harmonic; for unequal sides the |k| up to which the box is whole.
    sides : tuple of d floats, optional
        As ``as_sides`` returns them; a cube if not given.

    Returns
    -------
    float
        Nats a point (Ahmed, Ren & Wonka 2022, Sec. 4.3).

    Raises
    ------
    RefusalError
        If the cube ends below nu = 1, or a power is 0 to rounding (its logarithm is unknown).
    """
    edge = math.pow(n, 1 / d) * (1 - EDGE)
    needed = math.ceil(edge) - (sides is None)  # a cube holds every |f| < fmax + 1
    if fmax < needed:
        raise ShortSpectrumError(
            f"evacuated energy needs every frequency with nu < 1: fmax >= {needed}, here {fmax}"
        )
    if sides is None:
        return _evacuated(power, squared_radius(fmax, d), n, edge)
    return _evacuated(power, squared_lengths(tuple(s // 2 for s in power.shape), sides).ravel(), n, edge)


def evacuated_energy_of_ball(
    power: FloatArray, square: NDArray[np.int64] | FloatArray, n: int, d: int, most: float | None = None
) -> float:
    """Evacuated energy of one set from the listed frequencies of one half of a ball.

    Parameters
    ----------
    power : (m,) float64
        Power of that set alone.
    square : (m,) int64 or float64
        |f|^2 of each frequency; all frequencies of one half space up to the largest are there.
    n, d : int
        Its points and dimension.
    most : float, optional
        |k|^2 up to which they are there, for unequal sides.

    Returns
    -------
    float
        Nats a point, as ``evacuated_energy`` of a cube.

    Raises
    ------
    RefusalError
        If the ball ends below nu = 1, or a power is 0 to rounding.
    """
    edge = math.pow(n, 1 / d) * (1 - EDGE)
    if (square.max() + 1 if most is None else most) < edge * edge:
        raise ShortSpectrumError(
            f"evacuated energy needs every frequency with nu < 1: |f|^2 up to {math.ceil(edge * edge) - 1}, "
            f"here {square.max() if most is None else most:.6g}"
        )
    return 2 * _evacuated(power, square, n, edge)


def _evacuated(power: FloatArray, r2: NDArray[np.int64] | FloatArray, n: int, edge: float) -> float:
    chosen = power.ravel()[(r2 > 0) & (r2 < edge * edge)]
    if (chosen <= ROUNDING_POWER).any():
        raise RefusalError("evacuated energy is unbounded: the power of some frequency is 0 to rounding")
    return float(-np.sum(np.log(chosen[chosen < 1])) / n)


def peak(radial: RadialPower) -> tuple[float, float]:
    """Largest mean power over the whole rings round(|f|) = k < fmax with 0.5 <= nu <= 2, and that ring's nu.

    Rings one cycle wide, as in PSA (Schlömer & Deussen 2011), are less noisy than exact shells.

    Raises
    ------
    RefusalError
        If the last whole ring lies below nu = 1, where a peak may still be to come.
    """
    spacing = float(radial.nu[0] / radial.frequency[0])
    ring = np.rint(radial.frequency).astype(np.int64)
    whole = ring < round(radial.frequency[-1])  # the ring of fmax reaches half a unit beyond the cube
    if not whole.any():
        raise ShortSpectrumError(
            "the peak needs whole rings of frequencies up to nu = 1 at least; fmax = 1 holds none"
        )
    count = np.bincount(ring[whole], radial.count[whole])
    total = np.bincount(ring[whole], radial.power[whole] * radial.count[whole])
    nu = (np.arange(len(count)) * spacing).astype(np.float64)
    if nu[-1] < 1 - EDGE:
        raise ShortSpectrumError(
            f"the peak needs whole rings of frequencies up to nu = 1 at least; the last here is at "
            f"{nu[-1]:.2f}"
        )
    band = in_band(nu, *PEAK_BAND) & (count > 0)
    mean = np.where(band, total / np.maximum(count, 1), -np.inf)
    k = int(
        np.flatnonzero(mean >= mean.max() * (1 - TIE))[0]
    )  # the lowest of equals, whatever they rounded to
    return float(mean[k]), float(nu[k])
