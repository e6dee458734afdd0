"""The distance of the ring means of the power from a target, with its gradient (after Zhou et al. 2012)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from gbnbench.core.integer_frequencies import IntArray
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gauss_newton.modes import Modes, modes_below
from gbnbench.generators.gauss_newton.targets import TargetPower, target_power
from gbnbench.generators.gauss_newton.wave_sums import WaveSums
from gbnbench.generators.spectral_control.soft_core import soft_core

NOTHING = 1e-12  # a target as low asks for no power, of each frequency
LEAST = 1e-12  # share of a target below which the root is smoothed


@dataclass(frozen=True, eq=False)
class Rings:
    """The frequencies of a half space below an edge, with a target, in rings.

    Attributes
    ----------
    modes : Modes
        The frequencies.
    target : (m,) float64
        Power that is asked of each.
    empty : (m,) bool
        Where it is none.
    ring : (k,) int64
        Ring of each frequency that is not empty.
    count : (rings,) float64
        Frequencies a ring.
    """

    modes: Modes
    target: FloatArray
    empty: np.ndarray = field(init=False)
    ring: IntArray = field(init=False)
    count: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "empty", self.target <= NOTHING)
        length = np.sqrt(self.modes.square[~self.empty])
        rings = np.rint(length / ring_width(self.modes.n, self.modes.d))
        _, ring = np.unique(rings, return_inverse=True)
        object.__setattr__(self, "ring", ring.reshape(-1))
        object.__setattr__(self, "count", np.bincount(self.ring).astype(np.float64))

    def means(self, value: FloatArray) -> FloatArray:
        """Mean over each ring of a value of the frequencies that are not empty."""
        mean: FloatArray = np.bincount(self.ring, value, len(self.count)) / self.count
        return mean


def ring_width(n: int, d: int) -> float:
    """Return the width of rings in |f|: 1, in one dimension sqrt(n), for frequencies enough to average.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    float
    """
    return max(1.0, math.pow(n, 1 / d - 0.5))


def rings_below(n: int, d: int, target: TargetPower, highest: float) -> Rings:
    """List the frequencies with 0 < nu < highest with their target, in rings.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    target : callable
        Power as a function of nu.
    highest : float
        In nu.

    Returns
    -------
    Rings

    Raises
    ------
    InputError
        If the target is negative or not finite.
    """
    modes = modes_below(n, d, highest)
    return Rings(modes, target_power(target, modes))


class RingCost:
    """Squared distance of the roots of the ring means from the roots of the target, a point.

    Parameters
    ----------
    rings : Rings
        Frequencies and their target.
    core : float
        Distance, in spacings, below which pairs repel; 0 for none.

    Notes
    -----
    With rho_r the power of ring r over that of its target, N_r its frequencies and T_r their mean target, the
    cost is

        (1/n) [sum_r N_r T_r (sqrt(rho_r) - 1)**2 <nu**-2>_r + sum_f P_f nu_f**-2 + sum of the soft core],

    the second sum being over frequencies that are to have no power. It is the first for T -> 0, so that a
    band is emptied as fast as a ring is filled. 1 / nu**2 turns a change of amplitude into the displacement
    that makes it: without it the lowest frequencies come last. The mean of P_f / T_f in the place of rho_r
    would bind each frequency by its own target; where that falls by orders of magnitude within a ring, as at
    the foot of a narrow peak beyond the plane, the stiffness spreads as far, and descent comes to a halt.
    """

    def __init__(self, rings: Rings, core: float) -> None:
        self.rings, self.core = rings, core
        self.n, self.side = rings.modes.n, math.pow(rings.modes.n, 1 / rings.modes.d)
        filled = ~rings.empty
        stiffness = 1 / rings.modes.nu**2
        self._filled, self._empty_weight = filled, stiffness[rings.empty]
        self._target = rings.means(rings.target[filled])
        self._weight = rings.means(stiffness[filled])

    def __call__(self, u: FloatArray) -> tuple[float, FloatArray]:
        """Evaluate the cost and its gradient per spacing at points in spacings, (n, d)."""
        rings = self.rings
        waves = WaveSums(wrap(u / self.side), rings.modes.f, single=True)
        amplitudes = waves.amplitudes()
        power = np.abs(amplitudes) ** 2 / self.n
        root = np.sqrt(rings.means(power[self._filled]) / self._target + LEAST)
        cost = float(np.sum(rings.count * self._weight * self._target * (root - 1) ** 2))
        cost += float(np.sum(self._empty_weight * power[rings.empty]))
        slope = np.empty(len(power))
        slope[self._filled] = (self._weight * (1 - 1 / root))[rings.ring]
        slope[rings.empty] = self._empty_weight
        gradient = waves.gradient(2 / self.n * slope * amplitudes, self.side)
        if self.core > 0:
            overlap, push = soft_core(u, self.side, self.core)
            cost, gradient = cost + overlap, gradient + push
        return cost / self.n, gradient / self.n
