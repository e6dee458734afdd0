"""Errors of the square root of power, worst and typical, from the rounding of each step of an evaluation."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gbnbench.analysis.spectrum.coordinate_rounding import Coordinates
from gbnbench.core.results.resolution import RESOLVED, resolvable_power

UNIT = {"double": 2.0**-53, "float": 2.0**-24}  # half the distance from 1 to the next number

# Worst cases in units of rounding. A cosine and sine take three roundings of a phase up to pi/4, and those of
# the two series. A complex product takes sqrt(5) (Brent, Percival & Zimmermann 2007).
COSINE = 5.0
COMPLEX = math.sqrt(5.0)
LEAST_SHARE = 0.01  # part of the squared typical error that does not average out over sets
SETS_ROUNDING = 0.12  # typical rounding of a sum over sets, in units times the root of their number
UNRELATED = math.sqrt(2 - math.pi / 2)  # rms difference of the roots of two independent exponential powers


@dataclass(frozen=True)
class Errors:
    """Errors of the square root of power, |F| / sqrt(n), which do not depend on the power.

    Attributes
    ----------
    rms : float
        Typical error: the root mean square over frequencies, for scattered points.
    bound : float
        Worst case: no frequency of any set is further off, even if all points coincide.
    """

    rms: float
    bound: float

    @property
    def resolvable(self) -> float:
        """Smallest power that is typically known to 1%."""
        return resolvable_power(self.rms)

    def or_larger(self, other: Errors) -> Errors:
        """Give errors that hold for what both are stated of."""
        return Errors(max(self.rms, other.rms), max(self.bound, other.bound))

    def averaged(self, sets: int, n: int) -> Errors:
        """Give the errors of the mean power of several sets.

        Typical errors average out over sets, but not below a tenth, since where nearly all of the power is
        error its mean is too. The rounding of the sum over sets is added.

        Parameters
        ----------
        sets : int
            Number of sets, each evaluated with these errors.
        n : int
            Points of a set.

        Returns
        -------
        Errors
        """
        if sets == 1:
            return self
        typical = self.rms * math.sqrt(1 / sets + LEAST_SHARE)
        added = SETS_ROUNDING * UNIT["double"] * math.sqrt(sets)
        return Errors(math.hypot(typical, added), self.bound + sets * UNIT["double"] / 2 * math.sqrt(n))


def sum_errors(
    precision: str, sums: str, at: Coordinates, fmax: int, products: int, in_registers: int, beyond: int
) -> Errors:
    """Errors of a sum over points of cosines and sines.

    Parameters
    ----------
    precision, sums : {"double", "float"}
        Precision of the terms and of the sums in registers, and of what adds those sums up.
    at : Coordinates
        Rounding of the coordinates.
    fmax : int
        Largest harmonic on an axis.
    products : int
        Complex products by which a term is made from tabulated cosines and sines.
    in_registers : int
        Terms that a lane adds up one after another.
    beyond : int
        Additions one after another behind those.

    Returns
    -------
    Errors
        The bound adds up every rounding at its worst. The typical error is that of independent roundings; its
        two constants were fitted to scattered points.
    """
    u, v = UNIT[precision], UNIT[sums]
    term = (products + 1) * COSINE + products * COMPLEX + 1  # and a weight
    running = math.sqrt(2.0) * in_registers
    bound = at.share * (u * (term + running) + v * (2 * math.sqrt(2.0) * beyond + 4))
    bound += 2 * math.pi * fmax * at.coherent
    typical = u * math.sqrt(1.2 + 0.05 * in_registers)
    typical = math.hypot(typical, 2 * math.pi * fmax / math.sqrt(6) * at.scattered)
    # Amplitudes lie between 0 and the share. Two that have nothing in common differ by UNRELATED, 0.66.
    return Errors(min(typical, UNRELATED), min(bound, 1.001 * at.share))


def rms_for(floor: float) -> float:
    """Find the error of sqrt(power) at which a power equal to ``floor`` is still known to 1%."""
    return math.sqrt(floor) * RESOLVED / (1 + math.sqrt(1 + RESOLVED))
