"""The evaluations of the energy that a plan chooses from: the cost of each, its truncation, what opens it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from gbnbench.generators.gbn import operation_counts
from gbnbench.generators.gbn.energy_cost import EnergyCost
from gbnbench.generators.gbn.harmonics import Harmonics
from gbnbench.generators.gbn.images import Images
from gbnbench.generators.gbn.protocol import EnergyEvaluation
from gbnbench.generators.gbn.strips import Strips
from gbnbench.generators.gbn.theta import Theta


@dataclass(frozen=True)
class EnergyMethod:
    """One evaluation of the energy, as a plan knows it.

    Attributes
    ----------
    cost : callable
        ``cost(n, d, sigma, precision)``, with the value of its truncation last where there is one, is the
        EnergyCost; RefusalError where it cannot serve.
    evaluation : callable
        ``evaluation(runtime, n, d, sigma, precision)``, with the same last, opens the EnergyEvaluation.
    truncation : {"cutoff", "edge"} or None
        The truncation of the kernel that no other evaluation has.
    """

    cost: Callable[..., EnergyCost]
    evaluation: Callable[..., EnergyEvaluation]
    truncation: Literal["cutoff", "edge"] | None = None


METHODS = {
    "strips": EnergyMethod(operation_counts.strips, Strips, "cutoff"),
    "images": EnergyMethod(operation_counts.images, Images),
    "theta": EnergyMethod(operation_counts.theta, Theta),
    "harmonics": EnergyMethod(operation_counts.harmonics, Harmonics, "edge"),
}
