"""The deviation of the ring means of the power of point sets from a target."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, as_realizations
from gbnbench.generators.gauss_newton.targets import TargetPower
from gbnbench.generators.gauss_newton.wave_sums import WaveSums
from gbnbench.generators.spectral_control.ring_cost import rings_below

AUDIBLE = 0.01  # rings with a target no higher have no part in the deviation in dB


@dataclass(frozen=True)
class TargetFit:
    """Ring means of the power beside their target.

    Attributes
    ----------
    nu : (rings,) float64
        Mean nu of each ring of frequencies whose target is not 0.
    target, power : (rings,) float64
        Means over its frequencies.
    count : (rings,) float64
        Frequencies a ring, one of each pair f, -f.
    stray : float
        Mean power over the frequencies whose target is 0; nan where there are none.
    highest : float
        nu up to which they are compared.
    """

    nu: FloatArray
    target: FloatArray
    power: FloatArray
    count: FloatArray
    stray: float
    highest: float

    @property
    def rms_db(self) -> float:
        """Root of the mean squared deviation of ring means, in dB, over rings whose target is above 0.01."""
        heard = self.target > AUDIBLE
        if not heard.any():
            return float("nan")
        deviation = 10 * np.log10(self.power[heard] / self.target[heard])
        return float(np.sqrt(np.mean(deviation**2)))

    def __str__(self) -> str:
        """Say in words how near the power came to its target."""
        said, faint = [], self.target <= AUDIBLE
        if not faint.all():
            said.append(f"ring means of the power are within {self.rms_db:.2g} dB (rms) of the target")
        if faint.any():
            share = self.count[faint] / self.count[faint].sum()
            power, target = share @ self.power[faint], share @ self.target[faint]
            said.append(f"where it asks for {AUDIBLE} or less, {target:.2g} on average, they are {power:.2g}")
        if not math.isnan(self.stray):
            said.append(f"where it asks for no power, there is {self.stray:.2g}")
        return f"Up to nu = {self.highest:.4g}: {'; '.join(said)}."


def target_fit(x: ArrayLike, target: TargetPower, highest: float) -> TargetFit:
    """Compare the ring means of the power of sets, in double precision, with a target.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points, box sides.
    target : callable
        Power as a function of nu.
    highest : float
        nu up to which they are compared.

    Returns
    -------
    TargetFit
        Of the mean power of the sets.

    Raises
    ------
    InputError
        If x is no point set, the target no power, or no frequency lies below ``highest``.

    Examples
    --------
    >>> from gbnbench.generators.spectral_control.step import Step
    >>> generator = Step()
    >>> x = generator(256, 2, np.random.default_rng(0))
    >>> fit = target_fit(x, generator.profile(2), generator.highest_nu(2))  # or generator.fit(x)
    >>> fit.rms_db < 0.01, fit.stray < 1e-6
    (True, True)
    """
    sets = as_realizations(x)
    _, n, d = sets.shape
    rings = rings_below(n, d, target, highest)
    if not len(rings.modes):
        raise InputError(f"no frequency of n={n} points in d={d} has nu below {highest:.4g}")
    power = np.mean([np.abs(WaveSums(one, rings.modes.f).amplitudes()) ** 2 / n for one in sets], axis=0)
    filled, empty = ~rings.empty, rings.empty
    return TargetFit(
        rings.means(rings.modes.nu[filled]),
        rings.means(rings.target[filled]),
        rings.means(power[filled]),
        rings.count,
        float(np.mean(power[empty])) if empty.any() else float("nan"),
        highest,
    )
