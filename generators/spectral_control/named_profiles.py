"""Radial spectra with a name: step and single peak (Heck et al. 2013), stairs (Kailkhura et al. 2016)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.modes import edge_binding

MOST_POWER = 1e6  # that a setting may ask for: a thousand times that of a lattice of 1,000 points
DISORDER = 0.6  # largest share of the coordinates that an empty band may bind by default


def widest_step(d: int) -> float:
    """Return the widest edge of a step: V_d nu**d = 1, where the pair correlation at 0 becomes 0.

    Parameters
    ----------
    d : int
        Dimension. In one dimension the band would bind every coordinate, so that 0.3 is returned.

    Returns
    -------
    float
        In nu.

    Examples
    --------
    >>> [round(widest_step(d), 4) for d in (1, 2, 3)]
    [0.3, 0.5642, 0.6204]
    """
    return edge_binding(min(1 / d, DISORDER), d)


def of_the_plane(nu: float, d: int) -> float:
    """Scale a frequency of the plane to d dimensions as the widest step scales.

    Parameters
    ----------
    nu : float
        In the plane.
    d : int
        Dimension.

    Returns
    -------
    float
    """
    return nu * widest_step(d) / widest_step(2)


@dataclass(frozen=True)
class StepProfile:
    """No power below the edge, 1 above.

    Attributes
    ----------
    edge : float
        In nu.
    """

    edge: float

    def __call__(self, nu: FloatArray) -> FloatArray:
        """Power at nu."""
        return np.where(nu < self.edge, 0.0, 1.0)


@dataclass(frozen=True)
class PeakProfile:
    """A step and a peak at its edge, both blurred by a Gaussian along nu.

    Attributes
    ----------
    edge : float
        In nu.
    power : float
        Of the peak: its integral over nu.
    width : float
        Standard deviation of the Gaussian, in nu.
    """

    edge: float
    power: float
    width: float

    def __call__(self, nu: FloatArray) -> FloatArray:
        """Power at nu."""
        from scipy.special import ndtr

        with np.errstate(over="ignore"):  # far from the edge of a narrow peak, where the limits are right
            t = (nu - self.edge) / self.width
            peak = self.power / (self.width * math.sqrt(2 * math.pi)) * np.exp(-(t**2) / 2)
        profile: FloatArray = ndtr(t) + peak
        return profile


@dataclass(frozen=True)
class StairProfile:
    """No power below the edge, one level from there to the end of the stair, 1 beyond.

    Attributes
    ----------
    edge, end : float
        In nu.
    level : float
        Power of the stair.
    """

    edge: float
    end: float
    level: float

    def __call__(self, nu: FloatArray) -> FloatArray:
        """Power at nu."""
        return np.where(nu < self.edge, 0.0, np.where(nu < self.end, self.level, 1.0))
