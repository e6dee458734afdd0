"""Gaussian Blue Noise on the torus in any dimension (Ahmed, Ren & Wonka 2022)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.memory import too_large
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gauss_newton.modes import bound_coordinates
from gbnbench.generators.gbn.batches import BATCH, optimise_in_batches
from gbnbench.generators.gbn.box import fold
from gbnbench.generators.gbn.energy_settings import EnergySettings
from gbnbench.generators.gbn.minimisers import first_step, open_minimiser
from gbnbench.generators.gbn.optimiser import Descent
from gbnbench.generators.gbn.pair_kernels import KernelName
from gbnbench.generators.gbn.polish import empty_band
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_least, check_range, raise_refusal

PAPER_ITERATIONS = 10_000  # what the paper recommends
MOST_STEPS = 10_000_000  # ten times the publication's longest run
MOST_BOUND = 0.9  # share of the coordinates that polish may bind
NUMBERS = 30  # doubles a coordinate that a run keeps at once


@dataclass(frozen=True)
class GaussianBlueNoise:
    """Random points moved to the least variance of a sum of Gaussians placed on them.

    Attributes
    ----------
    sigma : float
        Width of the energy's kernel in spacings n**(-1/d), 0.3 to 3; the paper recommends 1.
    gradients : int
        Evaluations of Nesterov's method; 320 reach the quality of the paper's recommended 10,000 steps.
    iterations : int
        If not 0, so many steps of the paper's own descent instead.
    method : {"auto", "nesterov", "descent"}
        "descent" alone takes the paper's 10,000 steps; "auto" is descent where iterations are given.
    step : str
        The first step in squared spacings: "auto" is 1.2 over the energy's largest curvature, 1 over it where
        d > 3; "authors" that of the authors' programs, 0.25 n^(2/d) / n, right in scale for d = 2 only; or a
        number.
    excess : float
        Stop early once the excess energy a point is at most this; in 2D 4.5e-6 is the paper's quality at
        10,000 steps, 1.1e-6 that at 100,000. 0 never stops early.
    cutoff : float
        Where the kernel itself is cut off, in sigmas (Section 4.4, Figures 4 and 5); 0 leaves it whole.
    edge : float
        Highest nu = |f| n**(-1/d) that the energy sees (supplement B); 0 for all.
    precision : {"auto", "double", "float"}
        Of the forces; positions are double either way. "auto" is double where the device has it.
    domain : {"torus", "box"}
        "box" has no periods: the domain itself attracts the points (Section 4.6).
    projections : str
        Coordinate subsets whose projections are to be blue noise too, such as ``1``, ``1/2`` or ``0+1/+2``;
        see ``gbnbench.generators.gbn.projective.subsets``. On the torus.
    projection_edge : float
        Highest nu, in its own spacings, that the energy of a projection sees; 0 for all.
    polish : float
        An extension of the paper: empty the band 0 < nu <= polish afterwards, 0.25 say; 0 leaves it.
    kernel : {"gaussian", "distance", "log", "riesz", "multiquadric", "inverse", "matern", "vonmises"}
        Other kernels in the Gaussian's place, d <= 3: -r, -log r, r**-power; -sqrt(r**2 + sigma**2) and the
        inverse of that root, the Matérn kernel of smoothness 5/2, von Mises densities on the axes.
    power : float
        Of "riesz": 0 < power < d.

    Notes
    -----
    Starts from uniform random points: starts from jittered or regular ones keep a memory of their grid. A
    power below about 1e-30 cannot be reached in double; sets with an excess below 6e-7 in 2D are partly
    crystalline.

    Whatever the kernel, the energy is a squared error of integration in its reproducing kernel Hilbert space,
    which Gräf, Potts & Steidl (2012) minimise by conjugate gradients and such sums. Kernels whose transform
    falls as a power bind high frequencies too, and so order the points.
    """

    name: ClassVar[str] = "gbn"
    summary: ClassVar[str] = "Gaussian Blue Noise (Ahmed, Ren & Wonka 2022)"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Ahmed, Ren & Wonka, Gaussian Blue Noise, 2022"

    sigma: float = 1.0
    gradients: int = 320
    iterations: int = 0
    method: Literal["auto", "nesterov", "descent"] = "auto"
    step: str = "auto"
    excess: float = 0.0
    cutoff: float = 0.0
    edge: float = 0.0
    precision: Literal["auto", "double", "float"] = "auto"
    domain: Literal["torus", "box"] = "torus"
    projections: str = "none"
    projection_edge: float = 0.0
    polish: float = 0.0
    kernel: KernelName = "gaussian"
    power: float = 0.5

    def __post_init__(self) -> None:
        for name in ("gradients", "iterations"):
            check_range(name, getattr(self, name), 0, MOST_STEPS)
        for name in ("excess", "polish"):
            check_least(name, getattr(self, name), 0)
        if self.method == "nesterov" and self.iterations:
            raise InputError(
                f"iterations count the steps of method=descent, gradients those of nesterov; got both "
                f"method=nesterov and iterations={self.iterations}"
            )
        if self.method == "descent" and not self.iterations and self.gradients != GaussianBlueNoise.gradients:
            raise InputError(
                "gradients count evaluations of Nesterov's method; for the paper's descent say iterations, "
                f"got gradients={self.gradients}"
            )
        if self.iterations and self.gradients != GaussianBlueNoise.gradients:
            raise InputError(
                "gradients count evaluations of Nesterov's method, iterations steps of the paper's descent; "
                f"got both gradients={self.gradients} and iterations={self.iterations}"
            )
        if self.polish and self.domain == "box":
            raise InputError("polish empties a band of the torus; leave it out beside domain=box")
        first_step(self.step, self.energy, 2, 2)  # each refuses settings that are wrong
        if self.power != GaussianBlueNoise.power and self.kernel != "riesz":
            raise InputError(
                f"power is that of kernel=riesz; got power={self.power:g} beside kernel={self.kernel}"
            )

    def refusal(self, n: int, d: int) -> str | None:
        """Say why this energy cannot be had for n points in d dimensions; the whole kernel always can.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        if reason := too_large(NUMBERS * 8 * n * d):
            return f"n={n} points in d={d} {reason}; take fewer points"
        if self.polish and (bound := bound_coordinates(n, d, self.polish)) > MOST_BOUND * n * d:
            return (
                f"polish={self.polish:g} binds {bound:.6g} of the {n * d} coordinates of "
                f"n={n} points in d={d}; take 0.25 or so"
            )
        return self.energy.refusal(n, d)

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization; see ``Generator``."""
        one: FloatArray = self.draw(n, d, [rng], Monitor())[0]
        return one

    def draw(self, n: int, d: int, rngs: Sequence[np.random.Generator], monitor: Monitor) -> FloatArray:
        """Draw one set from each stream.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rngs : sequence of numpy.random.Generator
            One for each set.
        monitor : Monitor
            What the caller wants to be told and kept.

        Returns
        -------
        (len(rngs), n, d) float64
            Each set bit by bit as if it were drawn alone.

        Raises
        ------
        RefusalError
            Where ``refusal`` has a reason, or polish cannot empty its band.
        """
        raise_refusal(self.refusal(n, d))
        starts = np.stack([rng.random((n, d)) for rng in rngs])
        if n == 1:
            return starts
        inside = fold if self.domain == "box" else wrap
        x = inside(
            optimise_in_batches(starts, self._optimiser, self.steps, monitor, specification(self), inside)
        )
        return np.stack([empty_band(points, self.polish) for points in x]) if self.polish else x

    @property
    def energy(self) -> EnergySettings:
        """The settings that say which energy is minimised."""
        return EnergySettings(
            self.sigma,
            self.cutoff,
            self.edge,
            self.precision,
            self.domain,
            self.projections,
            self.projection_edge,
            self.kernel,
            self.power,
        )

    @property
    def steps(self) -> int:
        """Most evaluations of the energy."""
        return self.iterations or (PAPER_ITERATIONS if self.method == "descent" else self.gradients)

    def explain(self, n: int, d: int, sets: int = 1) -> str:
        """Say how the energy of n points in d dimensions is evaluated, and what other evaluations would cost.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        sets : int
            Sets of a call.

        Returns
        -------
        str
        """
        found = self.energy.plan(n, d, sets)
        if found is None:
            energy = self.energy.open(n, d)
            return f"{self.name}: {energy.method}, error {energy.error:.1e}"
        whose = "a set" if sets == 1 else f"{sets} sets"
        told = f"{found}\n  milliseconds are CPU time of one gradient of {whose}"
        memory = found.memory(max(n, min(n * sets, BATCH)))
        return told if memory is None else f"{told}\n  about {memory / 1e9:.2g} GB of memory at most"

    def _optimiser(self, starts: FloatArray) -> Descent:
        _, n, d = starts.shape
        settings = self.energy
        descent = bool(self.iterations) or self.method == "descent"
        return open_minimiser(settings, starts, first_step(self.step, settings, n, d), self.excess, descent)
