"""Point sets whose ring means of the power are those of a target (Zhou et al. 2012; Heck et al. 2013)."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.memory import too_large
from gbnbench.core.torus import FloatArray, as_realizations, wrap
from gbnbench.generators.gauss_newton.modes import ball_count, largest_square
from gbnbench.generators.gauss_newton.product_cost import list_operations, table_bytes, wave_sum_operations
from gbnbench.generators.gauss_newton.targets import TargetPower
from gbnbench.generators.monitor import Monitor, refuse_all_but_progress
from gbnbench.generators.ranges import check_above, check_least, raise_refusal
from gbnbench.generators.spectral_control.correlation_descent import (
    LEVELS,
    CorrelationDescent,
    correlation_refusal,
)
from gbnbench.generators.spectral_control.limited_memory_bfgs import minimise
from gbnbench.generators.spectral_control.named_profiles import of_the_plane
from gbnbench.generators.spectral_control.ring_cost import RingCost, rings_below
from gbnbench.generators.spectral_control.target_correlation import core_of
from gbnbench.generators.spectral_control.target_fit import TargetFit, target_fit

HIGHEST = 2.0  # nu up to which a target is met by default, in the plane
BARE = 0.1  # level of the target's pair correlation below which pairs are kept apart
ENOUGH = 1e-10  # cost a point at which a set is at its target: rings within 1e-4 of it
SUMS = 3  # of waves, an evaluation: amplitudes, and a gradient that costs two
STEPS = 10  # of the descent by correlation, for each of ``iterations``: some 250 are taken
MODE_BYTES = 32  # a frequency and axis, of the half that is listed and what is kept of it
WORK = 5e12  # most operations of a set: some minutes


@dataclass(frozen=True)
class RingMeans(ABC):
    """What the generators share that bring the ring means of the power to a target.

    Attributes
    ----------
    highest : float or None
        nu up to which the target is met; what is beyond follows from nothing. By default 2 in the plane.
    core : float or None
        Distance, in spacings, below which pairs repel; by default that up to which the pair correlation of
        the target is below a tenth. 0 for none.
    iterations : int
        Most steps, >= 0; of method=correlation ten times as many.
    method : {"power", "correlation"}
        "power" brings ring means of the power to the target, "correlation" the pair correlation function to
        that of the target, in the plane, by the descent of Heck, Schlömer & Deussen (2013); ``core`` has no
        part in it.

    Raises
    ------
    InputError
        If a setting is out of range.
    """

    highest: float | None = None
    core: float | None = None
    iterations: int = 100
    method: Literal["power", "correlation"] = "power"

    def __post_init__(self) -> None:
        if self.highest is not None:
            check_above("highest", self.highest, 0)
        if self.core is not None:
            check_least("core", self.core, 0, "spacings")
        check_least("iterations", self.iterations, 0)

    @abstractmethod
    def profile(self, d: int) -> TargetPower:
        """Target power as a function of nu in d dimensions."""

    def highest_nu(self, d: int) -> float:
        """Return the nu up to which the target is met in d dimensions."""
        return of_the_plane(HIGHEST, d) if self.highest is None else self.highest

    def fit(self, x: ArrayLike) -> TargetFit:
        """Measure how near the power of sets came to the target.

        Parameters
        ----------
        x : (n, d) or (realizations, n, d) array_like
            Points, box sides: sets of this generator, or any others.

        Returns
        -------
        TargetFit
            Of the mean power of the sets; as text it says so in words.

        Raises
        ------
        InputError
            If x is no point set, or too small for any frequency below ``highest``.
        """
        d = as_realizations(x).shape[2]
        return target_fit(x, self.profile(d), self.highest_nu(d))

    def refusal(self, n: int, d: int) -> str | None:
        """Say why a set of n points in d dimensions would take too long, or nothing is asked of it.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason; None where it does not.
        """
        if self.method == "correlation":
            return correlation_refusal(n, d)
        highest = self.highest_nu(d)
        square = largest_square(n, d, highest)
        if square == 0:
            return (
                f"no frequency of n={n} points in d={d} has nu below {highest:.4g}, so that nothing would be "
                f"asked of them: the lowest has {math.pow(n, -1 / d):.4g}; raise highest"
            )
        if reason := too_large(MODE_BYTES * d * ball_count(d, square) + table_bytes(n, d, square)):
            return f"the frequencies of n={n} points in d={d} up to nu={highest:.4g} {reason}; lower highest"
        evaluation = SUMS * wave_sum_operations(n, d, square) + list_operations(n, d, square)
        operations = evaluation * max(self.iterations, 1)
        if operations <= WORK:
            return None
        return (
            f"n={n} points in d={d} up to nu={highest:.4g} are too much work: {operations:.2g} operations, "
            f"of {WORK:.0e} at most; take fewer points, or lower highest or iterations"
        )

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rng : numpy.random.Generator
            The stream that it is drawn from.

        Returns
        -------
        (n, d) float64
        """
        one: FloatArray = self.draw(n, d, [rng], Monitor())[0]
        return one

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
            If a trace or a checkpoint is asked for, or the target is no power.
        RefusalError
            Where ``refusal`` has a reason.
        """
        refuse_all_but_progress(monitor, type(self).__name__)
        raise_refusal(self.refusal(n, d))
        target, highest = self.profile(d), self.highest_nu(d)
        if self.method == "correlation":
            return self._by_correlation(CorrelationDescent(n, target, highest), rngs, monitor)
        side = math.pow(n, 1 / d)
        core = core_of(target, d, highest, BARE) if self.core is None else self.core
        cost = RingCost(rings_below(n, d, target, highest), core if core < side / 2 else 0.0)
        sets = []
        for k, rng in enumerate(rngs):
            told = self._told(monitor, k, len(rngs), self.iterations, "cost a point")
            end = minimise(cost, side * rng.random((n, d)), self.iterations, ENOUGH, told)
            sets.append(wrap(end.x / side))
        return np.stack(sets)

    def _by_correlation(
        self, descent: CorrelationDescent, rngs: Sequence[np.random.Generator], monitor: Monitor
    ) -> FloatArray:
        sets = []
        for k, rng in enumerate(rngs):
            told = self._told(monitor, k, len(rngs), LEVELS, "misfit")
            x = rng.random((descent.n, 2))
            sets.append(descent.run(x, STEPS * self.iterations, told) if descent.n > 1 else x)
        return np.stack(sets)

    @staticmethod
    def _told(
        monitor: Monitor, k: int, sets: int, most: int, what: str
    ) -> Callable[[int, float], None] | None:
        """Progress of set k, of so many steps at most."""
        progress = monitor.progress
        if progress is None:
            return None

        def told(done: int, cost: float) -> None:
            progress(k * most + done, sets * most, f"set {k + 1}, {what} {cost:.1e}")

        return told
