"""Settings that say which energy Gaussian Blue Noise minimises: torus or box, truncations, projections."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.generators.gbn.box import BoxEnergy, box_curvature
from gbnbench.generators.gbn.energy import default_precision, energy_evaluation
from gbnbench.generators.gbn.mesh_evaluation import MOST, MeshEvaluation
from gbnbench.generators.gbn.pair_kernels import KernelName, transform
from gbnbench.generators.gbn.plan import EnergyPlan, plan_energy
from gbnbench.generators.gbn.projective import ProjectiveEnergy, subsets
from gbnbench.generators.gbn.protocol import EnergyEvaluation
from gbnbench.generators.gbn.step_sizes import (
    Curvature,
    gaussian_curvature,
    mode_step,
    stable_step,
    step_size,
)
from gbnbench.generators.ranges import check_range

LEAST_CUTOFF = 0.5  # sigmas
LARGEST = 1e6  # of a cutoff or an edge


@dataclass(frozen=True)
class EnergySettings:
    """The settings of ``GaussianBlueNoise`` that say which energy is minimised.

    Attributes
    ----------
    sigma, cutoff, edge, precision, domain, projections, projection_edge, kernel, power
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
    kernel: KernelName = "gaussian"
    power: float = 0.5

    def __post_init__(self) -> None:
        check_range("sigma", self.sigma, 0.3, 3, "spacings")
        for name in ("cutoff", "edge", "projection_edge"):
            check_range(name, getattr(self, name), 0, LARGEST)
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
        if not 0 < self.power < 3:
            raise InputError(f"power must be above 0 and below the dimension; got {self.power}")
        if self.kernel != "gaussian" and not (self.plain and self.precision != "float"):
            raise InputError(
                f"kernel={self.kernel} is summed whole over the torus, in double; leave out cutoff, edge, "
                "domain, projections and precision=float beside it"
            )

    def refusal(self, n: int, d: int) -> str | None:
        """Say why this energy cannot be had for n points in d dimensions; the whole kernel always can.

        Parameters and returns are those of ``GaussianBlueNoise.refusal``.
        """
        if self.kernel != "gaussian":
            return self._mesh_refusal(n, d)
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

    def _mesh_refusal(self, n: int, d: int) -> str | None:
        if d > 3:
            return (
                f"d must be 1, 2 or 3 for kernel={self.kernel}, summed over a mesh; got d={d}, nearest is 3"
            )
        if self.kernel == "riesz" and self.power >= d:
            return f"power must be below the dimension for riesz energies; got power={self.power:g} in d={d}"
        if n > MOST[d]:
            return (
                f"n must be at most {MOST[d]} in {d}D for kernel={self.kernel}, minutes of sums; got n={n}, "
                f"nearest is {MOST[d]}"
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
        if self.kernel != "gaussian":
            return MeshEvaluation(self.kernel, n, d, self.sigma, self.power)
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
        if self.kernel != "gaussian":
            return mode_step(self.curvature(d))
        return step_size(n, d, self.sigma)

    def curvature(self, d: int) -> Curvature:
        """Return the curvature of the torus's whole energy along modes of displacement.

        Parameters
        ----------
        d : int
            Dimension.

        Returns
        -------
        callable
            lambda_q at |q|^2, q = 2 pi f n^(-1/d).
        """
        if self.kernel == "gaussian":
            return gaussian_curvature(d, self.sigma)
        return lambda q2: q2 * transform(self.kernel, np.sqrt(q2), d, self.sigma, self.power)

    def plan(self, n: int, d: int, sets: int) -> EnergyPlan | None:
        """Plan how it is evaluated; None in the box, with projections and under other kernels: one way alone.

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
        if self.domain == "box" or self.projections != "none" or self.kernel != "gaussian":
            return None
        cutoff, edge = self.cutoff or None, self.edge or None
        return plan_energy(n, d, self.sigma, self.chosen_precision, sets=sets, cutoff=cutoff, edge=edge)
