"""Errors of integrals over drawn sets, which every claim about integration takes (Sec. 5.2, Fig. 9)."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from gbnbench.analysis.integration.estimator import estimate_errors
from gbnbench.analysis.integration.integrands.gaussians import Gaussians
from gbnbench.analysis.integration.integrands.half_space import HalfSpaces
from gbnbench.analysis.integration.integrands.protocol import Integrand
from gbnbench.analysis.integration.variance import Slope, Variance, slope_of, variance_of
from gbnbench.benchmarks.claims.sets import FAST, SEED, DrawnSets, SetCache
from gbnbench.core.torus import FloatArray

SMOOTH, STEP = Gaussians(), HalfSpaces()
INSTANCES = 60
SIZES = {2: (64, 256, 1024), 3: (64, 216, 1000), 8: (64, 256, 1024)}  # the same for all; 3D has whole grids
OTHERS = {2: ("random", "jittered", "sobol"), 3: ("random", "jittered", "sobol"), 8: ("random", "sobol")}
PARALLEL = 0.15  # difference of two slopes that still counts as one rate
AGREES = 3.0  # joint standard errors


@lru_cache(maxsize=8)
def integrands(family: Gaussians | HalfSpaces, d: int, further: int = 0) -> tuple[Integrand, ...]:
    """Draw the integrands that all sets of a dimension are tried on.

    Parameters
    ----------
    family : Gaussians or HalfSpaces
        The family of integrands.
    d : int
        Dimension.
    further : int
        Number of the draw; every number gives other integrands.

    Returns
    -------
    tuple of Integrand
    """
    rng = np.random.default_rng([SEED, d, further] if further else [SEED, d])
    return tuple(family.draw(d, rng) for _ in range(INSTANCES))


def draw(sets: SetCache, generator: str, n: int, d: int) -> DrawnSets:
    """Draw sets for integration, few of those that cost much.

    Parameters
    ----------
    sets : SetCache
        The sets that are drawn once and shared.
    generator : str
        The generator, with its settings.
    n, d : int
        Points in a set, and dimension.

    Returns
    -------
    DrawnSets
    """
    many = 64 if generator != FAST else 8 if n <= 2048 else 4 if n <= 4096 else 2
    return sets.draw(generator, n=n, d=d, sets=many)


def errors(sets: SetCache, family: Gaussians | HalfSpaces, generator: str, n: int, d: int) -> FloatArray:
    """Estimate every integral with every set.

    Parameters
    ----------
    sets : SetCache
        The sets that are drawn once and shared.
    family : Gaussians or HalfSpaces
        The family of integrands.
    generator : str
        The generator, with its settings.
    n, d : int
        Points in a set, and dimension.

    Returns
    -------
    (integrands, sets) float64
        Estimates less integrals.
    """
    return estimate_errors(integrands(family, d), draw(sets, generator, n, d).x)


def variance(sets: SetCache, family: Gaussians | HalfSpaces, generator: str, n: int, d: int) -> Variance:
    """Compute the variance of the estimates; parameters are those of ``errors``."""
    return variance_of(errors(sets, family, generator, n, d))


def slope(
    sets: SetCache, family: Gaussians | HalfSpaces, generator: str, d: int, sizes: tuple[int, ...]
) -> Slope:
    """Fit the exponent of the variance in n.

    Parameters
    ----------
    sets : SetCache
        The sets that are drawn once and shared.
    family : Gaussians or HalfSpaces
        The family of integrands.
    generator : str
        The generator, with its settings.
    d : int
        Dimension.
    sizes : tuple of int
        Numbers of points.

    Returns
    -------
    Slope
    """
    return slope_of(sizes, [errors(sets, family, generator, n, d) for n in sizes])
