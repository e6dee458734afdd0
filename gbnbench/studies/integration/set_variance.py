"""Variance of integrals that one source's sets estimate, without a study's folder."""

from __future__ import annotations

from numpy.typing import ArrayLike

from gbnbench.analysis.integration.integrands.registry import find as find_family
from gbnbench.analysis.integration.variance import Variance, variance_of
from gbnbench.core.least_values import require
from gbnbench.core.torus import as_realizations
from gbnbench.studies.integration.blocks import errors_of, instances_of
from gbnbench.studies.integration.requirements import refuse


def variance(
    x: ArrayLike, integrand: str = "gaussians", instances: int = 100, shifts: int = 0, seed: int = 0
) -> Variance:
    """Variance of the integral estimated by the mean over points.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points in [0, 1)^d.
    integrand : str
        A family of ``gbnbench.analysis.integration.integrands.registry``, with or without settings.
    instances : int
        Random integrands of the family, >= 1.
    shifts : int
        Random toroidal shifts of each set; 0 takes the sets as they are.
    seed : int
        Of the integrands and shifts.

    Returns
    -------
    Variance
        Over integrands and sets.

    Raises
    ------
    InputError
        If points, family or a number is wrong.
    RefusalError
        If the family has no integrand in d dimensions.

    Examples
    --------
    >>> from gbnbench import generate
    >>> x = generate("random", n=64, d=2, realizations=50)
    >>> found = variance(x, "korobov", instances=20)
    >>> found.low < ((1 + 2 * 1.0040773561979443) ** 2 - 1) / 64 < found.high  # zeta(8), by Parseval
    True
    """
    sets = as_realizations(x)
    family = find_family(integrand)
    require(instances=(instances, 1), shifts=(shifts, 0), seed=(seed, 0))
    d = sets.shape[2]
    refuse(family, d)
    drawn = instances_of(family, d, seed, instances)
    return variance_of(errors_of(drawn, sets, 0, seed, shifts))
