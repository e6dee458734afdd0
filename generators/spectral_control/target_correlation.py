"""The pair correlation function that a radial spectrum belongs to (Heck, Schlömer & Deussen 2013)."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.targets import TargetPower, power_at

STEPS = 2000  # of the integral over nu
RADII = np.linspace(0.0, 0.6, 61)  # in spacings, where a core is looked for


def pair_correlation_of(target: TargetPower, d: int, highest: float, r: FloatArray) -> FloatArray:
    """Transform a radial spectrum to the pair correlation function of an isotropic process that has it.

    Parameters
    ----------
    target : callable
        Power as a function of nu; 1 is taken beyond ``highest``.
    d : int
        Dimension.
    highest : float
        In nu.
    r : (k,) float64
        Distances, in spacings.

    Returns
    -------
    (k,) float64
        Where it is negative no process has the spectrum.

    Raises
    ------
    InputError
        If the target gives no power somewhere below ``highest``.

    Notes
    -----
    g(r) = 1 + integral of (P - 1) exp(2 pi i nu.r) over nu, by the midpoint rule: about 1e-3 where the target
    jumps.

    Examples
    --------
    >>> edge = 1 / np.sqrt(np.pi)  # the widest step in the plane
    >>> step = lambda nu: np.where(nu < edge, 0.0, 1.0)
    >>> bool(abs(pair_correlation_of(step, 2, 2.0, np.zeros(1))[0]) < 2e-3)
    True
    """
    from scipy.special import jv

    nu = (np.arange(STEPS) + 0.5) * highest / STEPS
    sphere = 2 * math.exp(d / 2 * math.log(math.pi) - math.lgamma(d / 2))
    weight = sphere * nu ** (d - 1) * (power_at(target, nu) - 1) * highest / STEPS
    z = np.maximum(2 * math.pi * np.outer(r, nu), 1e-6)
    wave = math.gamma(d / 2) * (2 / z) ** (d / 2 - 1) * jv(d / 2 - 1, z)
    correlation: FloatArray = 1 + np.einsum("ij,j->i", wave, weight)
    return correlation


def core_of(target: TargetPower, d: int, highest: float, level: float) -> float:
    """Distance up to which the pair correlation of a target stays below a level.

    Parameters
    ----------
    target : callable
        Power as a function of nu.
    d : int
        Dimension.
    highest : float
        In nu.
    level : float
        Of the pair correlation function.

    Returns
    -------
    float
        In spacings, at most 0.6; 0 where it starts above.
    """
    above = pair_correlation_of(target, d, highest, RADII) > level
    return float(RADII[int(np.argmax(above))] if above.any() else RADII[-1])
