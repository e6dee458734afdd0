"""Deep blue noise: short Gaussian Blue Noise brought to a steep profile by minimum-norm Gauss-Newton."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import ClassVar

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.modes import edge_binding
from gbnbench.generators.gauss_newton.solver import solve_for_amplitudes
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.protocol import MOST_ITERATIONS, Family
from gbnbench.generators.ranges import check_above, check_range, raise_refusal
from gbnbench.generators.spectral_control.band import BandGenerator, check_edge
from gbnbench.generators.spectral_control.target_profiles import Exponential, Table, TargetSetting, as_target

BOUND = math.pi * 0.72**2 / 2  # share of the coordinates that the default edge binds, in any dimension
DEPTH = 10 * math.pi**2 * 0.72**2  # c edge**2 by default: a power of 6e-23 at nu = 0, in any dimension
STEPS = 60  # five to ten are usual, forty where nearly every coordinate is bound
LONGER = ((3, 100), (10, 1000))  # further starts: times ``gradients``, and at least so many
USUAL = 10  # steps that progress expects of a set


@dataclass(frozen=True)
class Deep(BandGenerator):
    """Random points, a few steps of Gaussian Blue Noise, then the least move to a target radial profile.

    Attributes
    ----------
    c : float or None
        Steepness of the profile P = exp(-c (edge**2 - nu**2)), > 0; Gaussian Blue Noise has 4 pi**2. By
        default exp(-c edge**2) is 6e-23, with the default edge 10 pi**2 in the plane.
    edge : float or None
        Where it ends, in nu; by default 0.72 in the plane and elsewhere what binds as many coordinates.
    target : str, callable, (k, 2) array_like or None
        A profile of your own in place of the exponential: a CSV of nu and power, a function of nu, or a
        table. A table ends at its last nu unless ``edge`` is less.
    gradients : int
        Of the start: more give more order and more even sets; 100 the least order.

    Raises
    ------
    InputError
        If a setting is out of range or the target cannot be read.

    Notes
    -----
    The amplitudes below the edge keep the phase and the spread of the start, so the power around a ring stays
    as scattered as noise. A set that does not converge is drawn anew with a longer start and, if that fails
    too, refused: a set off its target would spoil the mean over a batch, and a warning would be lost in it.
    Powers below about 1e-28 are rounding.
    """

    name: ClassVar[str] = "deep"
    summary: ClassVar[str] = "deep blue noise: Gaussian Blue Noise moved least to a steeper profile"
    family: ClassVar[Family] = "spectral"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "gbnbench; after Ahmed, Ren & Wonka, 2022"
    most_bound: ClassVar[float] = 0.995  # up to .992 sets were seen to converge, slowly

    c: float | None = None
    edge: float | None = None
    target: TargetSetting = field(default=None, metadata={"read": as_target, "file": True})
    gradients: int = 200

    def __post_init__(self) -> None:
        object.__setattr__(self, "target", as_target(self.target))
        if self.c is not None:
            check_above("c", self.c, 0)
        check_edge(self.edge)
        check_range("gradients", self.gradients, 0, MOST_ITERATIONS)
        table = self._table()
        if table is not None and self.edge is not None and self.edge > table.edge:
            raise InputError(f"edge must be at most the last nu of the target, {table.edge}; got {self.edge}")

    def _table(self) -> Table | None:
        if isinstance(self.target, str):
            return Table.read(self.target)
        return self.target if isinstance(self.target, Table) else None

    def profile(self, d: int) -> tuple[Callable[[FloatArray], FloatArray], float]:
        """Target power as a function of nu, and its edge, in d dimensions."""
        table = self._table()
        if table is not None:
            return table, table.edge if self.edge is None else self.edge
        edge = edge_binding(BOUND, d) if self.edge is None else self.edge
        if callable(self.target):
            return self.target, edge
        return Exponential(DEPTH / edge**2 if self.c is None else self.c, edge), edge

    def band_edge(self, d: int) -> float:
        """Edge of the profile in d dimensions, in nu."""
        return self.profile(d)[1]

    def too_bound(self, n: int, d: int, bound: float) -> str:
        """Say that a profile binds too many coordinates, and what would do.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        bound : float
            Coordinates that it binds.

        Returns
        -------
        str
        """
        return (
            f"a profile up to nu={self.band_edge(d):.4g} binds {bound:.6g} of the {n * d} coordinates of "
            f"n={n} points in d={d}, and disordered sets can meet {100 * self.most_bound:g}% at most; "
            "lower the edge or take another n"
        )

    def draw(self, n: int, d: int, rngs: Sequence[np.random.Generator], monitor: Monitor) -> FloatArray:
        """Draw one set from each stream. Trace and checkpoint are those of the starts' descent.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rngs : sequence of numpy.random.Generator
            One for each set.
        monitor : Monitor
            Progress, a trace, a checkpoint.

        Returns
        -------
        (len(rngs), n, d) float64

        Raises
        ------
        RefusalError
            Where ``refusal`` has a reason, or no start of a set converged.
        """
        raise_refusal(self.refusal(n, d))
        ahead, counted = len(rngs) * USUAL, 0

        def started(done: int, total: int, doing: str) -> None:
            nonlocal counted
            counted = total
            if monitor.progress is not None:
                monitor.progress(done, total + ahead, f"deep, its start: {doing}")

        def stepped(k: int, step: int, residual: float) -> None:
            if monitor.progress is not None:
                done = counted + k * USUAL + min(step, USUAL - 1)
                told = f"deep, set {k + 1}, {residual:.1e} times what is allowed"
                monitor.progress(done, counted + ahead, told)

        short = GaussianBlueNoise(gradients=self.gradients)
        starts = short.draw(n, d, rngs, replace(monitor, progress=started))
        ends = [
            self._deepened(x, rng, partial(stepped, k))
            for k, (x, rng) in enumerate(zip(starts, rngs, strict=True))
        ]
        return np.stack(ends)

    def _deepened(
        self, x: FloatArray, rng: np.random.Generator, progress: Callable[[int, float], None]
    ) -> FloatArray:
        """Bring one start to the profile, or others drawn from its stream."""
        n, d = x.shape
        target, edge = self.profile(d)
        outcome = solve_for_amplitudes(x, target, edge, steps=STEPS, progress=progress)
        for times, least in LONGER:
            if outcome.converged:
                break
            longer = GaussianBlueNoise(gradients=max(times * self.gradients, least))
            outcome = solve_for_amplitudes(longer(n, d, rng), target, edge, steps=STEPS, progress=progress)
        if not outcome.converged:
            raise RefusalError(
                f"n={n} points in d={d} do not reach this profile from {1 + len(LONGER)} starts: "
                f"{outcome.reason}; lower the edge, now {edge:.4g}, ask for less power, or take more points"
            )
        return outcome.x
