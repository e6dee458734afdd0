"""Nesterov's method for adaptive sets: points move on the scale of their spacing, and stay on the ink."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.domain import shortest, within
from gbnbench.generators.adaptive.gbn.gradient import DescendedEnergy

STEP = 1.2  # over the largest curvature of the uniform energy
PATIENCE = 5  # gradients that the energy may lie above its lowest
SHORTER = 0.7  # factor of the step after that
INSIDE = 1e-3  # pixels from a border, at least


def descend(
    energy: DescendedEnergy,
    x: FloatArray,
    gradients: int,
    told: Callable[[int, float, FloatArray], None] | None = None,
) -> FloatArray:
    """Lower the energy of a set.

    Parameters
    ----------
    energy : DescendedEnergy
        The energy.
    x : (n, d) float64
        The start, in pixels.
    gradients : int
        How many gradients.
    told : callable, optional
        Called after each with its number, the energy, and the points as they are then.

    Returns
    -------
    (n, d) float64
        The set.

    Notes
    -----
    A point's step is its gradient times that which the uniform method would take at its local density, at
    most one local spacing. Moves onto pixels of density 0, or to where kernels are twice as wide, are
    refused: points would stand alone in white, where nothing moves them any more. The momentum is given up
    where it leads uphill (O'Donoghue & Candès 2015), and with a shorter step where the energy has not fallen
    to a new low for some gradients.
    """
    d, sigma = energy.density.d, energy.sigma
    x = x.copy()
    y, momentum, size = x, 1.0, STEP / largest_curvature(d, sigma)
    lowest, above = math.inf, 0
    for number in range(gradients):
        at = energy(y)
        step = -size * at.gradient / at.stiffness[:, None]
        length = np.sqrt((step**2).sum(axis=1)) / at.spacings
        moved = _inside(energy, y + step / np.maximum(1, length)[:, None])
        refused = ~energy.allowed(moved, at.widths)
        moved[refused] = x[refused]
        above = above + 1 if at.energy > lowest else 0
        lowest = min(lowest, at.energy)
        if told is not None:
            told(number + 1, at.energy, moved)
        ahead = shortest(energy.density, moved - x)
        if above >= PATIENCE:
            size, above, lowest = size * SHORTER, 0, at.energy
            momentum, y = 1.0, moved
        elif float((at.gradient * ahead).sum()) > 0:
            momentum, y = 1.0, moved
        else:
            following = (1 + math.sqrt(1 + 4 * momentum**2)) / 2
            y = _inside(energy, moved + (momentum - 1) / following * ahead)
            momentum = following
            refused = ~energy.allowed(y, at.widths)
            y[refused] = moved[refused]
        x = moved
    return x


def largest_curvature(d: int, sigma: float) -> float:
    """Largest curvature of the uniform energy by a point's position, in squared spacings.

    Parameters
    ----------
    d : int
        Dimension.
    sigma : float
        Kernel width in spacings.

    Returns
    -------
    float
        max over q of q^2 (2 pi)^(d/2) sigma^d exp(-sigma^2 q^2 / 2), at q^2 = 2 / sigma^2; or 2 / sigma^2,
        that of a pair, if it is larger.
    """
    waves = (2 * math.pi) ** (d / 2) * sigma**d * 2 / sigma**2 / math.e
    return float(max(waves, 2 / sigma**2))


def _inside(energy: DescendedEnergy, x: FloatArray) -> FloatArray:
    """Bring points back to the torus, or to the domain's border."""
    shape = np.array(energy.density.shape, np.float64)
    if energy.density.toroidal:
        return within(energy.density, x)
    return np.clip(x, INSIDE, shape - INSIDE)
