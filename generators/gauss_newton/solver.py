"""Points moved by the least displacement to given amplitudes: damped minimum-norm Gauss-Newton.

Each step solves J du = T - F for the shortest du = J^T (J J^T)^-1 (T - F) by conjugate gradients, only as
well as the step deserves (inexact Newton: Dembo, Eisenstat & Steihaug 1982).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gauss_newton.axis_waves import ComplexArray
from gbnbench.generators.gauss_newton.conjugate_gradients import forcing, inner, solve
from gbnbench.generators.gauss_newton.gram_matrix import gram_product
from gbnbench.generators.gauss_newton.modes import Modes, modes_below
from gbnbench.generators.gauss_newton.targets import (
    TargetPower,
    rounding_error,
    target_amplitudes,
    target_power,
)
from gbnbench.generators.gauss_newton.wave_sums import WaveSums

LONGEST = 0.5  # spacings: cap of one step's longest displacement
HALVINGS = 6  # of a step before a start is given up


@dataclass(frozen=True)
class AmplitudeSolution:
    """The result of ``solve_for_amplitudes``.

    Attributes
    ----------
    x : (n, d) float64
        Points in [0, 1).
    residual : float
        Largest |F - T| / (tolerance sqrt(n P_target) + rounding) over the modes; at most 1 where converged.
    steps : int
        Steps taken.
    products : int
        Products with the Gram matrix.
    converged : bool
        Whether every amplitude below the edge is within its tolerance. A set that is not must not be used.
    reason : str
        Why not, in words; empty where converged.
    """

    x: FloatArray
    residual: float
    steps: int
    products: int
    converged: bool
    reason: str = ""


def solve_for_amplitudes(
    x: FloatArray,
    target: TargetPower | float,
    edge: float,
    *,
    tolerance: float = 1e-3,
    steps: int = 40,
    products: int = 3000,
    progress: Callable[[int, float], None] | None = None,
) -> AmplitudeSolution:
    """Move points so that their power below an edge follows a target, by the shortest steps that do.

    Parameters
    ----------
    x : (n, d) float64
        Start, box sides; disordered, since amplitudes that are rounding alone have no phase to keep.
    target : callable or float
        Power at nu, (m,) -> (m,); >= 0. Each amplitude of the start keeps its phase and its place in the
        spread of its ring; 0 everywhere gives a stealthy set.
    edge : float
        In nu: amplitudes with 0 < nu < edge are bound.
    tolerance : float
        Of an amplitude over sqrt(n P_target(nu)); rounding of the coordinates is always allowed on top.
    steps : int
        Most Gauss-Newton steps.
    products : int
        Most products of one step.
    progress : callable, optional
        Called with the step's number and the residual, as in ``AmplitudeSolution``.

    Returns
    -------
    AmplitudeSolution
        The best set met, which is not always converged.

    Raises
    ------
    InputError
        If the target is negative or not finite below the edge, or the edge or the tolerance not positive.
    """
    for name, value in (("edge", edge), ("tolerance", tolerance)):
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"{name} must be positive and finite; got {value}")
    n, d = x.shape
    below = modes_below(n, d, edge)
    if not len(below):
        return AmplitudeSolution(wrap(x), 0.0, 0, 0, True)
    run = _Iteration(below, target, tolerance, x)
    return run.run(steps, products, progress)


class _Iterate:
    """Points with what is known of them."""

    def __init__(self, run: _Iteration, x: FloatArray) -> None:
        self.x = x
        self.waves = WaveSums(x, run.modes.f)
        self.amplitudes = self.waves.amplitudes()

    def measure(self, run: _Iteration) -> None:
        missing = run.aim - self.amplitudes
        self.residual = float(np.max(np.abs(missing) / run.allowed))
        self.missing: ComplexArray = missing * run.scale
        self.norm = math.sqrt(inner(self.missing, self.missing))


class _Iteration:
    """One descent of the residual."""

    def __init__(self, below: Modes, target: TargetPower | float, tolerance: float, x: FloatArray) -> None:
        self.modes = below
        self.side = math.pow(below.n, 1 / below.d)
        power = target_power(target, below)
        root = math.sqrt(below.n)
        self.allowed = root * (tolerance * np.sqrt(power) + rounding_error(below))
        self.scale = 1 / (root * below.length)
        self.state = _Iterate(self, wrap(x))
        self.aim = target_amplitudes(self.state.amplitudes, below, power)
        self.state.measure(self)

    def run(
        self, steps: int, products: int, progress: Callable[[int, float], None] | None
    ) -> AmplitudeSolution:
        """Step until converged, stalled or out of steps."""
        taken, before, last = 0, math.inf, 0.1
        for step in range(steps + 1):
            now = self.state
            if progress is not None:
                progress(step, now.residual)
            if now.residual <= 1:
                return AmplitudeSolution(now.x, now.residual, step, taken, True)
            if step == steps:
                break
            last = forcing(now.norm, before, last)
            before = now.norm
            product = gram_product(now.x, self.modes, now.waves)
            y, used = solve(product, now.missing, last, products)
            taken += used
            if not self._step(y, last):
                reason = f"no part of step {step + 1} brings the amplitudes nearer to their targets"
                return AmplitudeSolution(now.x, now.residual, step, taken, False, reason)
        reason = f"the amplitudes are not at their targets after {steps} steps"
        return AmplitudeSolution(self.state.x, self.state.residual, steps, taken, False, reason)

    def _step(self, y: ComplexArray, forced: float) -> bool:
        """Take as much of the step as lowers the residual; False where no part does."""
        move = self.state.waves.gradient(self.scale * y, self.side)
        longest = math.sqrt(float(np.max(np.sum(move**2, axis=1))))
        share = min(1.0, LONGEST / longest) if longest > 0 else 1.0
        for _ in range(HALVINGS + 1):
            tried = _Iterate(self, wrap(self.state.x + share * move / self.side))
            tried.measure(self)
            if tried.norm <= (1 - 0.1 * share * (1 - forced)) * self.state.norm or tried.residual <= 1:
                self.state = tried
                return True
            share /= 2
        return False
