"""The protocol of evaluations of the Gaussian Blue Noise energy: many sets at once, gradient and excess."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class EnergyGradient:
    """Gradients and excess energies of several sets.

    Attributes
    ----------
    gradient : (sets, n, d) float64
        dE/du, u = x n^(1/d) in spacings; E is the sum over pairs of the periodised exp(-r^2 / 2 sigma^2).
    excess : (sets,) float64
        Ex = (E + n theta(0)^d / 2 - n (2 pi)^(d/2) sigma^d / 2) / n, the energy a point above that of a
        constant density: (1/2n) sum over f != 0 of w_f P(f).
    """

    gradient: FloatArray
    excess: FloatArray


class EnergyEvaluation(Protocol):
    """Evaluates the energy of sets of n points in d dimensions at one sigma, in one precision.

    Attributes
    ----------
    method : str
        The evaluation, as a plan names it.
    error : float
        Bound on the error of a gradient's component, in units of the largest force of one pair: n pairs
        that all round alike, as those of tight clusters do. Scattered points come to a root of it. Besides,
        the whole field may be off by a factor within 1 ± 1e-15 b, b = 2 (pi sigma / L)^2, since the side
        L = n^(1/d) is rounded: this counts only where the kernel is wider than the box.
    """

    method: str
    error: float

    def __call__(self, x: FloatArray) -> EnergyGradient:
        """Gradient and excess energy at x, (sets, n, d) float64 in box sides, in or out of [0, 1).

        A set's numbers are bitwise the same whatever the other sets of the call, and however many.
        """
        ...
