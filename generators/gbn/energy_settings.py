"""Settings that say which energy Gaussian Blue Noise minimises: torus or box, truncations, projections."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from gbnbench.core.errors import InputError
from gbnbench.generators.gbn.box import BoxEnergy, box_curvature
from gbnbench.generators.gbn.energy import default_precision, energy_evaluation
from gbnbench.generators.gbn.plan import EnergyPlan, plan_energy
from gbnbench.generators.gbn.projective import ProjectiveEnergy, subsets
from gbnbench.generators.gbn.protocol import EnergyEvaluation
from gbnbench.generators.gbn.step_sizes import stable_step, step_size

LEAST_CUTOFF = 0.5  # sigmas


@dataclass(frozen=True)
class EnergySettings:
    """The settings of ``GaussianBlueNoise`` that say which energy is minimised.

    Attributes
    ----------
    sigma, cutoff, edge, precision, domain, projections, projection_edge
        As ``GaussianBlueNoise`` has them.

    Raises
    ------
    InputError
        If a setting is out of range, or two of them do not go together.
    """

    sigma: float
    cutoff: float
    edge: float
    precision: Literal["auto", "double", "float"]
    domain: Literal["torus", "box"]
    projections: str
    projection_edge: float

    def __post_init__(self) -> None:
        if not (math.isfinite(self.sigma) and 0.3 <= self.sigma <= 3):
            raise InputError(f"sigma must be between 0.3 and 3 spacings; got {self.sigma}")
        for name in ("cutoff", "edge", "projection_edge"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0):
                raise InputError(f"{name} must be 0 or more; got {getattr(self, name)}")
        if self.projection_edge and self.projections == "none":
            raise InputError(
                f"projection_edge={self.projection_edge:g} goes with projections, such as projections=1; "
                "got none"
            )
        if self.cutoff and self.cutoff < LEAST_CUTOFF:
            raise InputError(
                f"cutoff must be 0, for the whole kernel, or at least {LEAST_CUTOFF}; got {self.cutoff}: "
                "nothing would move"
            )
        if self.cutoff and self.edge:
            raise InputError(
                "a kernel is cut off in space or in frequency; got both "
                f"cutoff={self.cutoff} and edge={self.edge}"
            )
        if self.domain == "box" and (self.cutoff or self.edge or self.projections != "none"):
            raise InputError(
                "domain=box has the whole energy alone; leave out cutoff, edge and projections beside it"
            )
        if self.projections != "none" and (self.cutoff or self.edge):
            raise InputError(
                "projections go with the whole energy; got cutoff or edge beside them: leave these out, or "
                "truncate the projections by projection_edge"
            )

    def refusal(self, n: int, d: int) -> str | None:
        """Say why this energy cannot be had for n points in d dimensions; the whole kernel always can.

        Parameters and returns are those of ``GaussianBlueNoise.refusal``.
        """
        side = n ** (1 / d)
        if self.projections != "none":
            try:
                subsets(self.projections, d)
            except InputError as error:
                return f"{error}; d={d}"
        if self.cutoff and d > 3:
            return f"d must be at most 3 where the kernel is cut off; got d={d}"
        if 2 * self.cutoff * self.sigma > side:
            least = math.ceil((2 * self.cutoff * self.sigma) ** d)
            return (
                f"n must be at least {least} in d={d} for cutoff={self.cutoff:g}, sigma={self.sigma:g}: "
                f"the box must be twice the cut-off wide; got n={n}"
            )
        if self.edge and self.edge * side < 1:
            return (
                f"edge must be at least {1 / side:.3g} for n={n}, d={d}, or no frequency is left; "
                f"got {self.edge}"
            )
        return None

    @property
    def plain(self) -> bool:
        """Whether it is the torus's whole energy, and no other beside it."""
        return self.domain == "torus" and not (self.edge or self.cutoff) and self.projections == "none"

    @property
    def chosen_precision(self) -> str:
        """Precision of the forces: that which is set, or the best of the device."""
        return default_precision() if self.precision == "auto" else self.precision

    def open(self, n: int, d: int) -> EnergyEvaluation:
        """Open the evaluation of this energy on the chosen device.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        EnergyEvaluation

        Raises
        ------
        DeviceError
            If there is no device, or it has no such precision.
        """
        precision = self.chosen_precision
        if self.domain == "box":
            return BoxEnergy(n, d, self.sigma, precision)
        if self.projections != "none":
            return ProjectiveEnergy(
                n,
                d,
                self.sigma,
                subsets(self.projections, d),
                edge=self.projection_edge or None,
                precision=precision,
            )
        cutoff, edge = self.cutoff or None, self.edge or None
        return energy_evaluation(n, d, self.sigma, precision, cutoff=cutoff, edge=edge)

    def first_step(self, n: int, d: int) -> float:
        """Return the first step that the largest curvature allows, in squared spacings.

        Parameters and returns are those of ``step_size``.
        """
        if self.domain == "box":
            return stable_step(box_curvature(n, d, self.sigma), d, self.sigma)
        return step_size(n, d, self.sigma)

    def plan(self, n: int, d: int, sets: int) -> EnergyPlan | None:
        """Plan how it is evaluated; None in the box and with projections, where there is no choice.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        sets : int
            Sets of a call.

        Returns
        -------
        EnergyPlan or None
        """
        if self.domain == "box" or self.projections != "none":
            return None
        cutoff, edge = self.cutoff or None, self.edge or None
        return plan_energy(n, d, self.sigma, self.chosen_precision, sets=sets, cutoff=cutoff, edge=edge)
