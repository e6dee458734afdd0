"""Cost of measuring a large set, told by its size alone: stages with memory and time, and what is left out.

Constants were measured at n = 1e6 and 1e7; the tests hold the stated memory against that of a process.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gbnbench.analysis.measuring_plan import MeasuringPlan
from gbnbench.analysis.radial.psa import too_many_points
from gbnbench.analysis.spatial.discrepancy import too_many_terms
from gbnbench.analysis.spatial.slabs import SLAB_POINTS, WHOLE
from gbnbench.analysis.spectrum.evaluators.kept_memory import KEPT_BYTES
from gbnbench.analysis.spectrum.plan import plan as spectrum_plan
from gbnbench.core.memory import PROCESS_BYTES

CUBE_BYTES = 64  # for each frequency of a cube while its shells are told apart
TREE_BYTES, DISTANCE_BYTES = 400, 16  # for each point of a slab, and of the set whose distances are kept
STAR_BYTES = 3000  # for each point of a slab that is triangulated
PLANE_BYTES = 300  # for each point, to the next power of two, of a discrepancy in the plane
GRID_SECONDS, TREE_SECONDS, STAR_SECONDS, PLANE_SECONDS = 1e-6, 2.5e-6, 5e-5, 1e-5  # a point, one core


@dataclass(frozen=True)
class MeasuringStage:
    """A part of the work on one set.

    Attributes
    ----------
    name : str
        For the user: "spectrum", "distances", "neighbours" or "discrepancies".
    nbytes : int
        Memory that it takes besides the points and the process.
    seconds : float
        Expected time.
    """

    name: str
    nbytes: int
    seconds: float


@dataclass(frozen=True)
class MeasuringCost:
    """Memory and time of measuring a set, and the measures that its size leaves out.

    Attributes
    ----------
    points : int
        Bytes of the points.
    stages : tuple of MeasuringStage
        In the order in which they are done, the spectrum first; what one takes is free again before the
        next, but for what is kept of the spectrum.
    reach : float
        nu as far as the spectrum goes.
    left_out : dict
        Name of a measure -> why this size leaves it out.
    """

    points: int
    stages: tuple[MeasuringStage, ...]
    reach: float
    left_out: dict[str, str]

    @property
    def nbytes(self) -> int:
        """Memory of the process where it needs most."""
        spectrum, *others = (stage.nbytes for stage in self.stages)
        later = max(others) + min(spectrum, KEPT_BYTES)  # what a thread keeps of the spectrum stays
        return PROCESS_BYTES + self.points + max(spectrum, later)

    @property
    def seconds(self) -> float:
        """Expected time of all stages."""
        return sum(stage.seconds for stage in self.stages)

    def explain(self) -> str:
        """Say in lines what each stage takes, and what is left out."""
        lines = [
            f"  measures: {self.nbytes / 1e9:.2g} GB of memory at most, of it {self.points / 1e9:.2g} GB the "
            f"points; about {self.seconds:.2g} s, spectrum to nu = {self.reach:.3g}"
        ]
        lines += [
            f"    {stage.name}: {stage.nbytes / 1e9:.2g} GB, about {stage.seconds:.2g} s"
            for stage in self.stages
        ]
        lines += [f"  no {name}: {reason}" for name, reason in self.left_out.items()]
        return "\n".join(lines)


def measuring_cost(plan: MeasuringPlan) -> MeasuringCost:
    """State what measuring each set of a source takes.

    Parameters
    ----------
    plan : MeasuringPlan
        Of sets of more than ``slabs.WHOLE`` points; smaller ones take less.

    Returns
    -------
    MeasuringCost

    Raises
    ------
    InputError
        If the spectrum that is asked for can be neither evaluated nor held.
    """
    n, d = plan.n, plan.d
    held = min(n, WHOLE)
    found = [
        _spectrum(plan),
        MeasuringStage("distances", TREE_BYTES * held + DISTANCE_BYTES * n, TREE_SECONDS * n),
    ]
    left_out: dict[str, str] = {}
    if d == 2:
        of_slab = n / -(-n // SLAB_POINTS)
        nbytes = int(STAR_BYTES * of_slab) + DISTANCE_BYTES * n
        found.append(MeasuringStage("neighbours", nbytes, STAR_SECONDS * n))
    reason = too_many_points(n, d)
    if reason is not None:
        left_out |= dict.fromkeys(("effective_nyquist", "oscillations"), reason)
    reason = too_many_terms(n, d)
    if reason is not None:
        left_out |= dict.fromkeys(("discrepancy_wd", "discrepancy_star"), reason)
    else:
        padded = 1 << (n - 1).bit_length()
        found.append(MeasuringStage("discrepancies", PLANE_BYTES * padded, PLANE_SECONDS * n))
    reach = plan.near.reach * n ** (-1 / d)
    if plan.near.listed and plan.sides is None:
        reach = math.sqrt(plan.near.reach) * n ** (-1 / d)
    return MeasuringCost(8 * n * d, tuple(found), reach, left_out)


def _spectrum(plan: MeasuringPlan) -> MeasuringStage:
    near = plan.near
    if near.listed:
        count = len(near.square)
        made = spectrum_plan(plan.n, plan.d, 1, frequencies=count)
    else:
        made = spectrum_plan(plan.n, plan.d, int(near.reach), sides=plan.sides)
        count = made.request.frequencies
    return MeasuringStage("spectrum", made.bytes + CUBE_BYTES * count, made.seconds + GRID_SECONDS * plan.n)
