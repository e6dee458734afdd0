"""Figures of one set beside gbnbench's measures: areas of its Voronoi cells, and its gain in integration."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import erf

from gbnbench.core.torus import FloatArray
from gbnbench.generators.power_cells.diagram import power_diagram

WIDTH, INTEGRANDS = 0.25, 256  # of Gaussians in the cube, and how many


def spread_of_voronoi_areas(x: FloatArray) -> float:
    """Areas of the Voronoi cells of points on the torus: their standard deviation over their mean.

    Parameters
    ----------
    x : (n, 2) float64
        Distinct points.

    Returns
    -------
    float
    """
    return float(len(x) * power_diagram(x).mass.std())


def gain_in_integration(x: FloatArray) -> float:
    """Variance of the integrals of 256 Gaussians by independent points, over the squared errors of this set.

    Parameters
    ----------
    x : (n, d) float64
        Points of the cube.

    Returns
    -------
    float
        Sums over ``INTEGRANDS`` Gaussians of width ``WIDTH`` about random centres, whose integrals are known.
    """
    n, d = x.shape
    centres = np.random.default_rng(0).random((INTEGRANDS, d))

    def integrals(width: float) -> FloatArray:
        unit = width * math.sqrt(2)
        each = erf((1 - centres) / unit) + erf(centres / unit)
        found: FloatArray = np.prod(width * math.sqrt(math.pi / 2) * each, axis=1)
        return found

    exact = integrals(WIDTH)
    variance = (integrals(WIDTH / math.sqrt(2)) - exact**2) / n
    square = ((x[None] - centres[:, None]) ** 2).sum(axis=2)
    error = np.exp(-square / (2 * WIDTH**2)).mean(axis=1) - exact
    return float(variance.sum() / (error**2).sum())
