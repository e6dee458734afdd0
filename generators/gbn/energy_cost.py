"""The cost of one evaluation of the energy: what it sums, how many instructions it takes, how exact it is."""

from __future__ import annotations

from dataclasses import dataclass

# Share of the multiply-add peak that each reaches once it is large, and the instructions that a launch costs;
# measured once, rounded, and fixed: the choice of a method must not depend on the hour.
SHARE = {"theta": 0.8, "images": 0.6, "harmonics": 0.4, "strips": 0.45}
LAUNCH = 2e6
LAUNCHES = {"theta": 2, "images": 2, "harmonics": 7, "strips": 4}


@dataclass(frozen=True)
class EnergyCost:
    """One evaluation at one size.

    Attributes
    ----------
    method : str
        strips, images, theta or harmonics.
    detail : str
        What it sums, in words.
    work : float
        Pairs, both ways round, or frequencies times points.
    instructions : float
        A set, by count; nothing on memory or launches.
    error : float
        Bound as ``EnergyEvaluation.error``.
    """

    method: str
    detail: str
    work: float
    instructions: float
    error: float

    @property
    def launches(self) -> float:
        """Instructions that take as long as its launches, which serve all sets of a call at once."""
        return LAUNCH * LAUNCHES[self.method]

    @property
    def effort(self) -> float:
        """Instructions at the peak that take as long, launches among them: what a plan compares."""
        return self.instructions / SHARE[self.method] + self.launches
