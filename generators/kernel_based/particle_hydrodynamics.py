"""Blue noise as a fluid at rest, by smoothed particle hydrodynamics (Jiang et al. 2015)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import MOST_ITERATIONS, Family
from gbnbench.generators.ranges import check_range, too_many, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told

STIFFNESS = 0.04  # squared spacings a squared time step: sound travels a fifth of a spacing in a step
DAMPING = 0.9  # of velocities, each step
LONGEST = 0.5  # spacings a step
MOST = 100_000
# 1 over the integrals of (1 - r**2)**3 and (1 - r)**3 over the unit ball in d = 1, 2, 3.
POLY6 = {1: 35 / 32, 2: 4 / math.pi, 3: 315 / (64 * math.pi)}
SPIKY = {1: 2.0, 2: 10 / math.pi, 3: 15 / math.pi}


@dataclass(frozen=True)
class ParticleHydrodynamics(SetBySet):
    """Particles of a damped fluid on the torus, moved by differences of their pressure.

    Parameters
    ----------
    rest : float
        Density at which the pressure is none, in mean densities of the particles, 0 to 1: 0.9 gives sets as
        capacity constraints do, lower ones approach the order of Lloyd's method.
    iterations : int
        Time steps; 0 takes 200, or 6.25 times the box's side in spacings where that is more, in 2D
        above n = 1,024: what sound needs to go across and a little back.
    support : float
        Radius of the kernels in spacings, 1.5 to 6.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    Density is the sum of kernels (1 - r**2)**3, its own included; the pressure max(rho - rest, 0) accelerates
    by -grad of kernels (1 - r)**3, weighted p_i / rho_i**2 + p_j / rho_j**2. The single parameter that takes
    the sets from Lloyd's to those of capacity-constrained tessellations is the publication's; that it is the
    rest density, the equation of state, stiffness, damping and support are those of a later program that
    follows it (SPlisHSPlasH), as the text was not at hand. Cohesion, which holds a surface, is left out: the
    torus has none. At rest = 1 half of the particles have no pressure and do not spread.

    References
    ----------
    Jiang, Zhou, Wang, Southern & Zhang, "Blue noise sampling using an SPH-based method", ACM Trans. Graphics
    34(6), 2015.

    Examples
    --------
    >>> ParticleHydrodynamics(iterations=3)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "sph"
    summary: ClassVar[str] = "rest of a fluid by smoothed particle hydrodynamics, d <= 3 (Jiang et al. 2015)"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 3)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Jiang et al., Blue noise sampling using an SPH-based method, 2015"
    rest: float = 0.9
    iterations: int = 0
    support: float = 2.0

    def __post_init__(self) -> None:
        check_range("rest", self.rest, 0, 1, "mean densities")
        check_range("iterations", self.iterations, 0, MOST_ITERATIONS)
        check_range("support", self.support, 1.5, 6, "spacings")

    def refusal(self, n: int, d: int) -> str | None:
        """Say why there is no such fluid.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason; None for d <= 3 and n that take minutes at most.
        """
        return too_many_axes(d, 3, "for the kernels of the fluid") or too_many(
            n, MOST, "for the steps to take no more than minutes"
        )

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        x = rng.random((n, d))
        side = n ** (1 / d)
        velocity = np.zeros((n, d))
        steps = self.iterations or max(200, math.ceil(6.25 * side - 1e-9))
        for step in range(steps):
            told(step / steps)
            velocity += STIFFNESS * pressure_acceleration(x, self.rest, self.support)
            velocity *= DAMPING
            length = np.linalg.norm(velocity, axis=1, keepdims=True)
            velocity /= np.maximum(length / LONGEST, 1.0)
            x = wrap(x + velocity / side)
        return x


def pressure_acceleration(x: FloatArray, rest: float, support: float) -> FloatArray:
    """Accelerate particles by the pressure about them, at unit stiffness.

    Parameters
    ----------
    x : (n, d) float64
        Particles of unit mass in [0, 1).
    rest : float
        Density without pressure, in mean densities of the particles.
    support : float
        Radius of the kernels in spacings, at most half the box.

    Returns
    -------
    (n, d) float64
        In spacings; adds up to none.
    """
    from scipy.spatial import cKDTree

    n, d = x.shape
    side = n ** (1 / d)
    support = min(support, 0.499 * side)
    i, j = cKDTree(x, boxsize=np.ones(d)).query_pairs(support / side, output_type="ndarray").T
    apart = x[i] - x[j]
    apart = (apart - np.round(apart)) * (side / support)
    r = np.sqrt(np.einsum("pa,pa->p", apart, apart))
    kernel = (1 - r**2) ** 3
    density = POLY6[d] / support**d * (1 + np.bincount(i, kernel, n) + np.bincount(j, kernel, n))
    pressure = np.maximum(density - rest * density.mean(), 0) / density**2
    slope = 3 * SPIKY[d] / support ** (d + 1) * (1 - r) ** 2
    force = ((pressure[i] + pressure[j]) * slope / np.maximum(r, 1e-12))[:, None] * apart
    total = np.empty_like(x)
    for axis in range(d):
        total[:, axis] = np.bincount(i, force[:, axis], n) - np.bincount(j, force[:, axis], n)
    return total
