"""What an evaluation can resolve: errors of sqrt(power), worst and typical, and the power seen to 1%."""

from __future__ import annotations

import math
from dataclasses import dataclass

RESOLVED = 0.01  # relative error of a power that counts as resolved


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


def power_error(power: float, error: float) -> float:
    """Error of a power whose square root is off by error: 2 sqrt(P) e + e^2."""
    return 2 * math.sqrt(power) * error + error * error


def resolvable_power(rms: float) -> float:
    """Smallest power known to 1% where its square root is off by rms: about (200 rms)^2."""
    return (rms * (1 + math.sqrt(1 + RESOLVED)) / RESOLVED) ** 2


def rms_for(floor: float) -> float:
    """Error of sqrt(power) that still resolves a power of floor to 1%."""
    return math.sqrt(floor) * RESOLVED / (1 + math.sqrt(1 + RESOLVED))
