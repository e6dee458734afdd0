"""A map from the unit ball to the cube that keeps volumes (Shirley & Chiu 1997; Paulin et al. 2020).

Ball to cylinder, whose cross-section is a ball of one dimension less, and so on down to the interval. Shells
of the ball become shells of the cylinder: where the last axis z is at most gamma times the radius r across it
the shell goes to the cylinder's side, else to its lids.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from gbnbench.core.torus import FloatArray

TINY = 1e-300  # instead of a radius of 0, which is divided by


def ball_to_cube(x: FloatArray) -> FloatArray:
    """Map points of the unit ball to the cube [-1, 1]^d so that equal volumes stay equal.

    Parameters
    ----------
    x : (n, d) float64
        Points, |x| <= 1.

    Returns
    -------
    (n, d) float64

    Examples
    --------
    >>> ball_to_cube(np.array([[1.0, 0.0], [0.0, -0.5], [np.sqrt(0.5), np.sqrt(0.5)]])).round(6) + 0.0
    array([[ 1. ,  0. ],
           [ 0. , -0.5],
           [ 1. ,  1. ]])
    """
    cube = x.copy()
    for d in range(x.shape[1], 1, -1):
        cube[:, :d] = _ball_to_cylinder(cube[:, :d])
    return cube


def _ball_to_cylinder(x: FloatArray) -> FloatArray:
    """Map the unit ball to the cylinder of the same radius and half height, (n, d)."""
    d = x.shape[1]
    across, z = x[:, :-1], x[:, -1]
    r = np.sqrt(np.sum(across**2, axis=1))
    radius = np.sqrt(r**2 + z**2)
    edge = math.atan(slope_of_edge(d))
    side = np.abs(z) <= math.tan(edge) * r
    height = np.abs(z) / np.maximum(radius, TINY)  # sine of the latitude
    breadth = r / np.maximum(radius, TINY)
    to_side = _power_integral(height, 0, d - 2) / _power_integral(np.array([math.sin(edge)]), 0, d - 2)
    to_lid = _power_integral(breadth, d - 2, 0) / _power_integral(np.array([math.cos(edge)]), d - 2, 0)
    out = np.empty(x.shape)
    out[:, -1] = np.copysign(radius * np.where(side, to_side, 1.0), z)
    stretch = radius * np.where(side, 1.0, to_lid ** (1 / (d - 1))) / np.maximum(r, TINY)
    out[:, :-1] = across * stretch[:, None]
    return out


def _power_integral(sine: FloatArray, p: int, q: int) -> FloatArray:
    """Integrate sin**p cos**q from 0 to the angle of a sine, over its value at a right angle."""
    from scipy.special import betainc

    integral: FloatArray = betainc((p + 1) / 2, (q + 1) / 2, np.minimum(sine, 1.0) ** 2)
    return integral


@lru_cache
def slope_of_edge(d: int) -> float:
    """Return gamma, the slope z / r at which side and lids of the cylinder meet.

    Parameters
    ----------
    d : int
        Dimension of the ball, >= 2.

    Returns
    -------
    float

    Notes
    -----
    A cylinder of height 2 has as much of its volume over its side as over its lids, d - 1 to 1, so that the
    integral of cos**(d-2) up to atan(gamma) is d - 1 times that of sin**(d-2) up to atan(1/gamma).

    Examples
    --------
    >>> round(slope_of_edge(2), 9), round(slope_of_edge(3), 9)
    (1.0, 0.894427191)
    """
    from scipy.optimize import brentq

    def excess(angle: float) -> float:
        side = _power_integral(np.array([math.sin(angle)]), 0, d - 2)[0]
        lid = _power_integral(np.array([math.cos(angle)]), d - 2, 0)[0]
        return float(side - (d - 1) * lid)

    return math.tan(float(brentq(excess, 0.0, math.pi / 2, xtol=1e-15)))
