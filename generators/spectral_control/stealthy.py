"""Stealthy, or step, blue noise: no power below an edge, none asked beyond (Uche et al. 2006; Supp. B)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gauss_newton.modes import edge_binding, modes_below
from gbnbench.generators.gauss_newton.solver import solve_for_amplitudes
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.optimiser import Nesterov
from gbnbench.generators.gbn.step_sizes import step_size
from gbnbench.generators.monitor import Monitor, refuse_all_but_progress
from gbnbench.generators.protocol import MOST_ITERATIONS, Family
from gbnbench.generators.ranges import check_above, check_least, check_range, raise_refusal
from gbnbench.generators.spectral_control.band import BandGenerator, check_edge
from gbnbench.generators.spectral_control.core_descent import descend_to_core, least_distance, widest_core
from gbnbench.generators.spectral_control.empty_band import band_power, last_step
from gbnbench.generators.spectral_control.set_progress import SetProgress

SHARE = 0.6  # of the coordinates that the default edge binds, in any dimension
LONGER = (1, 3, 10)  # starts for newton, in times of its gradients
SIGMA = 1.0  # of the truncated energy
CHUNK = 50  # gradients between two looks at the band


@dataclass(frozen=True)
class Stealthy(BandGenerator):
    """Random points moved until no power is left at the frequencies 0 < nu < edge.

    Attributes
    ----------
    edge : float or None
        In nu; by default what binds 0.6 of the coordinates: 0.3 in 1D, 0.618 in 2D, 0.755 in 3D.
    method : {"newton", "harmonics"}
        Minimum-norm Gauss-Newton after a short descent, down to rounding; or the descent alone, of the
        Gaussian energy truncated at the edge.
    gradients : int or None
        Of the descent before newton; by default 30, in one dimension 300. A start that does not converge is
        drawn anew with 3 and 10 times as many.
    most : int
        Most gradients of method harmonics.
    power : float
        Largest power below the edge at which method harmonics stops, > 0; the paper's are below 1e-8.
    core : float
        Least distance of any two points, in spacings, of method newton; 0 for none. The descent is then of
        the band's power and a soft core (Kim & Torquato 2025), and ``gradients`` has no part in it. In the
        plane 0.95 is reached with the default edge, in 3D 0.9.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The amplitudes below the edge bind 2 chi = V_d edge^d / d of the coordinates, V_d being the unit ball's
    volume (Uche, Stillinger & Torquato 2006). Disordered sets exist while that is below 1; order sets in
    before. The Gaussian energy of the frequencies below the edge is least, 0, exactly at stealthy sets. A set
    that has not reached its band is refused, never returned.

    References
    ----------
    Heck, Schlömer & Deussen, "Blue noise sampling with controlled aliasing", ACM Trans. Graph. 32(3), 2013.
    Kim & Torquato, "Ultradense sphere packings derived from disordered stealthy hyperuniform ground states",
    2025.
    Uche, Stillinger & Torquato, "Constraints on collective density variables", Phys. Rev. E 74, 031104, 2006.

    Examples
    --------
    >>> x = Stealthy(edge=0.4)(64, 2, np.random.default_rng(0))
    >>> bool(band_power(x, 0.4).max() < 1e-25)
    True
    """

    name: ClassVar[str] = "stealthy"
    summary: ClassVar[str] = "stealthy (step) blue noise: no power below an edge (Uche et al. 2006)"
    family: ClassVar[Family] = "spectral"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Uche, Torquato & Stillinger, Collective coordinate control, 2006"
    most_bound: ClassVar[float] = (
        0.96  # beyond, there are no disordered sets: in 1D they collapse to the grid
    )

    edge: float | None = None
    method: Literal["newton", "harmonics"] = "newton"
    gradients: int | None = None
    most: int = 5000
    power: float = 1e-8
    core: float = 0.0

    def __post_init__(self) -> None:
        check_edge(self.edge)
        for name in ("gradients", "most"):
            check_range(name, getattr(self, name) or 0, 0, MOST_ITERATIONS)
        check_above("power", self.power, 0)
        check_least("core", self.core, 0, "spacings")
        if self.core and self.method != "newton":
            raise InputError(f"a core needs method=newton; got {self.method}")

    def band_edge(self, d: int) -> float:
        """Edge of the empty band in d dimensions, in nu."""
        return edge_binding(SHARE, d) if self.edge is None else self.edge

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n points in d dimensions cannot have an empty band, or a core beside it.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason: that of every band, or that no points keep the core.
        """
        if n > 1 and self.core > (widest := widest_core(d)):
            said = f"no n={n} points in d={d} can be core={self.core:.4g} spacings apart: the densest packing"
            return f"{said} has {widest:.4g}" + (" at most" if d > 3 else "")
        return super().refusal(n, d)

    def too_bound(self, n: int, d: int, bound: float) -> str:
        """Say that an empty band binds too many coordinates, and what would do.

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
        lower = edge_binding(0.8, d)
        return (
            f"an empty band below nu={self.band_edge(d):.4g} binds {bound:.6g} of the {n * d} coordinates of "
            f"n={n} points in d={d}: only lattices, if any, have it; lower the edge, {lower:.3g} still "
            "leaves disorder"
        )

    def draw(self, n: int, d: int, rngs: Sequence[np.random.Generator], monitor: Monitor) -> FloatArray:
        """Draw one set from each stream. There is progress, but neither trace nor checkpoint.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rngs : sequence of numpy.random.Generator
            One for each set.
        monitor : Monitor
            Progress.

        Returns
        -------
        (len(rngs), n, d) float64

        Raises
        ------
        InputError
            If a trace or a checkpoint is asked for.
        RefusalError
            Where ``refusal`` has a reason, or the band was not reached.
        """
        refuse_all_but_progress(monitor, self.name)
        raise_refusal(self.refusal(n, d))
        return np.stack(
            [self._one(n, d, rng, SetProgress(monitor, k, len(rngs))) for k, rng in enumerate(rngs)]
        )

    def _one(self, n: int, d: int, rng: np.random.Generator, progress: SetProgress) -> FloatArray:
        x, edge = rng.random((n, d)), self.band_edge(d)
        if not len(modes_below(n, d, edge)):  # a box of few points has no frequency so low
            return x
        if self.method == "harmonics":
            return self._descended(x, edge, progress)
        if self.core:
            return self._apart(x, edge, rng, progress)
        gradients = (300 if d == 1 else 30) if self.gradients is None else self.gradients
        for times in LONGER:
            start = wrap(_descend(x, edge, times * gradients, progress).x[0])
            outcome = solve_for_amplitudes(start, 0.0, edge, progress=progress.step)
            if outcome.converged:
                return last_step(outcome.x, edge)
            x = rng.random((n, d))
        raise RefusalError(
            f"the power of n={n} points in d={d} below nu={edge:.4g} could not be brought to 0 from "
            f"{len(LONGER)} starts: {outcome.reason}; lower the edge, or raise gradients, now {gradients}"
        )

    def _apart(
        self, x: FloatArray, edge: float, rng: np.random.Generator, progress: SetProgress
    ) -> FloatArray:
        """Empty the band with every two points a core apart."""
        n, d = x.shape
        closest, reason = 0.0, ""
        for _ in LONGER:
            start = descend_to_core(x, edge, self.core, progress.descent)
            outcome = solve_for_amplitudes(start, 0.0, edge, progress=progress.step)
            end = last_step(outcome.x, edge) if outcome.converged else outcome.x
            apart = least_distance(end)
            if outcome.converged and apart >= self.core:
                return end
            closest, reason = max(closest, apart), outcome.reason or reason
            x = rng.random((n, d))
        reason = f": {reason}" if reason else ""
        raise RefusalError(
            f"n={n} points in d={d} with no power below nu={edge:.4g} came no farther apart than "
            f"{closest:.3g} spacings from {len(LONGER)} starts, and core={self.core:.3g} was asked for"
            f"{reason}; lower core or edge"
        )

    def _descended(self, x: FloatArray, edge: float, progress: SetProgress) -> FloatArray:
        run = _descend(x, edge, 0, progress)
        while True:
            left = float(band_power(run.x[0], edge).max())
            doing = f"{run.gradients} gradients, largest power {left:.1e}"
            progress.share(run.gradients / max(self.most, 1), doing)
            if left <= self.power:
                return wrap(run.x[0])
            if run.gradients >= self.most:
                raise RefusalError(
                    f"the largest power below nu={edge:.4g} is {left:.3g} after {run.gradients} gradients, "
                    f"and power={self.power:.3g} was asked for; raise most or power, lower the edge, or take "
                    "method=newton"
                )
            for _ in range(min(CHUNK, self.most - run.gradients)):
                run.advance()


def _descend(x: FloatArray, edge: float, gradients: int, progress: SetProgress) -> Nesterov:
    """Run the descent of the energy below the edge from one set, (n, d)."""
    n, d = x.shape
    run = Nesterov(energy_evaluation(n, d, SIGMA, "double", edge=edge), x[None], step_size(n, d, SIGMA))
    for k in range(gradients):
        run.advance()
        progress.share(k / gradients / 2, f"gradient {k + 1}")
    return run
