"""Stealthy, or step, blue noise: no power below an edge, none asked beyond (Uche et al. 2006; Supp. B)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gauss_newton.conjugate_gradients import solve
from gbnbench.generators.gauss_newton.gram_matrix import gram_product
from gbnbench.generators.gauss_newton.modes import edge_binding, modes_below
from gbnbench.generators.gauss_newton.solver import solve_for_amplitudes
from gbnbench.generators.gauss_newton.wave_sums import WaveSums
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.optimiser import Nesterov
from gbnbench.generators.gbn.step_sizes import step_size
from gbnbench.generators.monitor import Monitor, refuse_all_but_progress
from gbnbench.generators.protocol import Family
from gbnbench.generators.spectral_control.band import BandGenerator, check_edge

SHARE = 0.6  # of the coordinates that the default edge binds, in any dimension
LONGER = (1, 3, 10)  # starts for newton, in times of its gradients
SIGMA = 1.0  # of the truncated energy
FORCING = 1e-4  # residual of the last step's linear solve
PRODUCTS = 3000
CHUNK = 50  # gradients between two looks at the band
USUAL = 10  # Gauss-Newton steps that progress expects


def band_power(x: FloatArray, edge: float) -> FloatArray:
    """Power of one set at one of each pair f, -f with 0 < nu < edge.

    Parameters
    ----------
    x : (n, d) float64
        Points, box sides.
    edge : float
        In nu.

    Returns
    -------
    (m,) float64
    """
    n, d = x.shape
    amplitudes = WaveSums(wrap(x), modes_below(n, d, edge).f).amplitudes()
    return np.asarray(np.abs(amplitudes) ** 2 / n)


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

    def __post_init__(self) -> None:
        check_edge(self.edge)
        for name in ("gradients", "most"):
            if (getattr(self, name) or 0) < 0:
                raise InputError(f"{name} must be 0 or more; got {getattr(self, name)}")
        if not (math.isfinite(self.power) and self.power > 0):
            raise InputError(f"power must be positive; got {self.power}")

    def band_edge(self, d: int) -> float:
        """Edge of the empty band in d dimensions, in nu."""
        return edge_binding(SHARE, d) if self.edge is None else self.edge

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
        if reason := self.refusal(n, d):
            raise RefusalError(reason)
        return np.stack(
            [self._one(n, d, rng, _SetProgress(monitor, k, len(rngs))) for k, rng in enumerate(rngs)]
        )

    def _one(self, n: int, d: int, rng: np.random.Generator, progress: _SetProgress) -> FloatArray:
        x, edge = rng.random((n, d)), self.band_edge(d)
        if not len(modes_below(n, d, edge)):  # a box of few points has no frequency so low
            return x
        if self.method == "harmonics":
            return self._descended(x, edge, progress)
        gradients = (300 if d == 1 else 30) if self.gradients is None else self.gradients
        for times in LONGER:
            start = wrap(_descend(x, edge, times * gradients, progress).x[0])
            outcome = solve_for_amplitudes(start, 0.0, edge, progress=progress.step)
            if outcome.converged:
                return _once_more(outcome.x, edge)
            x = rng.random((n, d))
        raise RefusalError(
            f"the power of n={n} points in d={d} below nu={edge:.4g} could not be brought to 0 from "
            f"{len(LONGER)} starts: {outcome.reason}; lower the edge, or raise gradients, now {gradients}"
        )

    def _descended(self, x: FloatArray, edge: float, progress: _SetProgress) -> FloatArray:
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


class _SetProgress:
    """Progress of one set of several, in hundredths of a set: half for the descent, half for newton."""

    def __init__(self, monitor: Monitor, k: int, sets: int) -> None:
        self._progress, self._k, self._sets = monitor.progress, k, sets

    def share(self, share: float, doing: str) -> None:
        """Say which share of this set is done."""
        if self._progress is not None:
            done = 100 * self._k + min(99, round(100 * share))
            self._progress(done, 100 * self._sets, f"stealthy, set {self._k + 1}, {doing}")

    def step(self, step: int, residual: float) -> None:
        """Say that a Gauss-Newton step is done."""
        self.share(0.5 + step / (2 * USUAL), f"{residual:.1e} times what is allowed")


def _descend(x: FloatArray, edge: float, gradients: int, progress: _SetProgress) -> Nesterov:
    """Run the descent of the energy below the edge from one set, (n, d)."""
    n, d = x.shape
    run = Nesterov(energy_evaluation(n, d, SIGMA, "double", edge=edge), x[None], step_size(n, d, SIGMA))
    for k in range(gradients):
        run.advance()
        progress.share(k / gradients / 2, f"gradient {k + 1}")
    return run


def _once_more(x: FloatArray, edge: float) -> FloatArray:
    """One more Gauss-Newton step: quadratic convergence leaves rounding alone, 1e-29 for 1,024 points."""
    n, d = x.shape
    below = modes_below(n, d, edge)
    waves = WaveSums(x, below.f)
    scale, side = 1 / (math.sqrt(n) * below.length), math.pow(n, 1 / d)
    y, _ = solve(gram_product(x, below, waves), -waves.amplitudes() * scale, FORCING, PRODUCTS)
    moved = wrap(x + waves.gradient(scale * y, side) / side)
    return moved if band_power(moved, edge).max() < band_power(x, edge).max() else x
