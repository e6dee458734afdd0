"""What an evaluation can resolve: errors of sqrt(power), worst and typical, and the power seen to 1%."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gbnbench.core.results import RESOLVED, resolvable_power
from gbnbench.core.torus import FloatArray

UNIT = {"double": 2.0**-53, "float": 2.0**-24}  # half the distance from 1 to the next number
BITS = {"double": 64, "float": 32}  # of a fixed-point coordinate
EXACT_FROM = 2.0**-12  # doubles from here up are multiples of 2^-64

# Worst cases in units of rounding. Cosine and sine together: three roundings of a phase up to pi/4, and those
# of the two series. A complex product: sqrt(5) (Brent, Percival & Zimmermann 2007).
COSINE = 5.0
COMPLEX = math.sqrt(5.0)
LEAST_SHARE = 0.01  # of a typical error squared that a mean over sets keeps
SETS_ROUNDING = 0.12  # typical rounding of a sum over sets, in units times the root of their number
UNRELATED = math.sqrt(2 - math.pi / 2)  # rms difference of two roots of exponentially distributed powers


@dataclass(frozen=True)
class Errors:
    """Errors of the square root of power, |F| / sqrt(n): there they do not depend on the power.

    Attributes
    ----------
    rms : float
        Typical: root mean square over frequencies, for scattered points.
    bound : float
        Worst case: no frequency of any set, coincident points included, is further off.
    """

    rms: float
    bound: float

    @property
    def resolvable(self) -> float:
        """Smallest power that is typically known to 1%."""
        return resolvable_power(self.rms)

    def averaged(self, sets: int, n: int) -> Errors:
        """Of the mean power of so many sets of n points.

        Typical errors average out, though not where nearly all there is is error, and roundings of the sum
        over sets add up.
        """
        if sets == 1:
            return self
        typical = self.rms * math.sqrt(1 / sets + LEAST_SHARE)
        added = SETS_ROUNDING * UNIT["double"] * math.sqrt(sets)
        return Errors(math.hypot(typical, added), self.bound + sets * UNIT["double"] / 2 * math.sqrt(n))


@dataclass(frozen=True)
class Coordinates:
    """How far fixed-point coordinates are from the true ones, at the worst of several sets.

    Attributes
    ----------
    coherent : float
        Sum over points of |w| times the sum over axes of the distance, over the root of the sum of w^2;
        in turns.
    scattered : float
        Root of the sum over points and axes of w^2 times the squared distance, over the same; turns.
    share : float
        Sum of |w| over the root of the sum of w^2: sqrt(n) without weights.
    """

    coherent: float
    scattered: float
    share: float


def coordinates(x: FloatArray, precision: str, weights: FloatArray | None = None) -> Coordinates:
    """Measure the rounding of (sets, n, d) points to 64 or, in float, 32 bits of a turn."""
    n = x.shape[1]
    if weights is None:
        share = math.sqrt(n)
    else:
        share = float((np.abs(weights).sum(axis=1) / np.sqrt((weights**2).sum(axis=1))).max())
    inexact = np.nonzero(x < EXACT_FROM) if precision == "double" else np.nonzero(np.ones(x.shape, bool))
    scaled = x[inexact] * 2.0 ** BITS[precision]
    away = np.abs(scaled - np.rint(scaled)) * 2.0 ** -BITS[precision]
    if not away.any():
        return Coordinates(0.0, 0.0, share)
    norm: FloatArray | float = float(n)
    if weights is not None:
        dealt = np.broadcast_to(weights, (len(x), n))
        away *= np.abs(dealt[inexact[0], inexact[1]])
        norm = (dealt**2).sum(axis=1)
    coherent = np.bincount(inexact[0], away, len(x)) / np.sqrt(norm)
    scattered = np.sqrt(np.bincount(inexact[0], away**2, len(x)) / norm)
    return Coordinates(float(coherent.max()), float(scattered.max()), share)


def sum_errors(
    precision: str, sums: str, at: Coordinates, fmax: int, products: int, in_registers: int, beyond: int
) -> Errors:
    """Errors of a sum over points of cosines and sines.

    Parameters
    ----------
    precision, sums : {"double", "float"}
        Of the terms and the sums in registers, and of what adds those up.
    at : Coordinates
        Rounding of the coordinates.
    fmax : int
        Largest harmonic on an axis.
    products : int
        Complex products that make a term of its cosines and sines, each tabulated once.
    in_registers, beyond : int
        Terms of a lane added up one after another, and additions after that.

    Returns
    -------
    Errors
        The bound adds up every rounding at its worst; the typical error is that of independent roundings, its
        two constants fitted to scattered points.
    """
    u, v = UNIT[precision], UNIT[sums]
    term = (products + 1) * COSINE + products * COMPLEX + 1  # and a weight
    running = math.sqrt(2.0) * in_registers
    bound = at.share * (u * (term + running) + v * (2 * math.sqrt(2.0) * beyond + 4))
    bound += 2 * math.pi * fmax * at.coherent
    typical = u * math.sqrt(1.2 + 0.05 * in_registers)
    typical = math.hypot(typical, 2 * math.pi * fmax / math.sqrt(6) * at.scattered)
    # Amplitudes lie between 0 and the share; those that have nothing in common any more differ by 0.66.
    return Errors(min(typical, UNRELATED), min(bound, 1.001 * at.share))


def rounded_at_worst(n: int, d: int, precision: str) -> Coordinates:
    """Assume of coordinates nobody has seen yet: exact in double, as far off as can be in float."""
    half = 0.0 if precision == "double" else 2.0 ** -(BITS[precision] + 1)
    share = math.sqrt(n)
    return Coordinates(share * d * half, math.sqrt(d / 3) * half, share)


def power_error(power: float, error: float) -> float:
    """Error of a power whose square root is off by error: 2 sqrt(P) e + e^2."""
    return 2 * math.sqrt(power) * error + error * error


def rms_for(floor: float) -> float:
    """Error of sqrt(power) that still resolves a power of floor to 1%."""
    return math.sqrt(floor) * RESOLVED / (1 + math.sqrt(1 + RESOLVED))
