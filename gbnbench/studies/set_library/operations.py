"""Counted operations of a draw, by which a cost that was measured at one n is carried over to another."""

from __future__ import annotations

from gbnbench.generators.gauss_newton.product_cost import solver_operations
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.gbn.plan import plan_energy
from gbnbench.generators.protocol import Generator
from gbnbench.generators.spectral_control.deep import Deep
from gbnbench.generators.spectral_control.stealthy import Stealthy


def draw_operations(generator: Generator, n: int, d: int) -> float | None:
    """Count the operations of one set, as the generators' own plans do.

    Parameters
    ----------
    generator : Generator
        Of any kind.
    n, d : int
        Points and dimension.

    Returns
    -------
    float or None
        Multiplications and additions in pairs, in the time that they take; None where nobody counts them.
        The short descent of ``stealthy`` is left out: it is a few sums of waves among hundreds.
    """
    if isinstance(generator, GaussianBlueNoise):
        if (generator.domain, generator.projections, generator.kernel) != ("torus", "none", "gaussian"):
            return None
        precision = "float" if generator.precision == "float" else "double"
        cutoff, edge = generator.cutoff or None, generator.edge or None
        plan = plan_energy(n, d, generator.sigma, precision, cutoff=cutoff, edge=edge)
        return generator.steps * plan.chosen.effort
    if isinstance(generator, Deep):
        start = draw_operations(GaussianBlueNoise(gradients=generator.gradients), n, d)
        return (start or 0.0) + solver_operations(n, d, generator.band_edge(d))
    if isinstance(generator, Stealthy) and generator.method == "newton" and not generator.core:
        return solver_operations(n, d, generator.band_edge(d))
    return None
