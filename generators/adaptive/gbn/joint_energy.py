"""A sum of adaptive energies of parts of one set: of each class of points and of their union.

Points of several classes, such as inks, are to be blue noise class by class and all together (Wei 2010). With
the Gaussian energy that is one sum,

    E = sum over parts p of weight_p E_p(x[points_p]),

each part with a density, kernel widths and a target of its own; a part may be any choice of the points.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density, as_density
from gbnbench.generators.adaptive.gbn.gradient import AdaptiveGradient, DescendedEnergy


@dataclass(frozen=True)
class Part:
    """Some of the points, and their energy.

    Attributes
    ----------
    points : slice
        Which of all points.
    energy : DescendedEnergy
        Of these.
    weight : float
        Of the energy in the sum, above 0.
    """

    points: slice
    energy: DescendedEnergy
    weight: float


class JointEnergy:
    """The sum.

    Parameters
    ----------
    density : Density
        Of all points.
    parts : sequence of Part
        On the pixels of the density, of one sigma; each point belongs to one of them at least.

    Attributes
    ----------
    density : Density
        As given.
    sigma : float
        Kernel width of the uniform method, in spacings.
    """

    def __init__(self, density: Density, parts: Sequence[Part]) -> None:
        self.density = density
        self.sigma = parts[0].energy.sigma
        self._parts = tuple(parts)

    def __call__(self, x: FloatArray) -> AdaptiveGradient:
        """Evaluate the energy and its gradient.

        Parameters
        ----------
        x : (n, d) float64
            Points within the density, in pixels.

        Returns
        -------
        AdaptiveGradient
            A spacing is the smallest of those that the point has in its parts.
        """
        energy, widths = 0.0, []
        gradient, stiffness = np.zeros(x.shape), np.zeros(len(x))
        spacings = np.full(len(x), np.inf)
        for part in self._parts:
            at = part.energy(x[part.points])
            energy += part.weight * at.energy
            gradient[part.points] += part.weight * at.gradient
            stiffness[part.points] += part.weight * at.stiffness
            spacings[part.points] = np.minimum(spacings[part.points], at.spacings)
            widths.append(at.widths)
        return AdaptiveGradient(energy, gradient, np.concatenate(widths), spacings, stiffness)

    def allowed(self, x: FloatArray, widths: FloatArray) -> NDArray[np.bool_]:
        """Tell which places every part allows, as ``AdaptiveEnergy.allowed`` says.

        Parameters
        ----------
        x : (n, d) float64
            Places within the density, in pixels.
        widths : (m,) float64
            Of the kernels before, part after part.

        Returns
        -------
        (n,) bool
        """
        allowed = np.ones(len(x), np.bool_)
        first = 0
        for part in self._parts:
            here = x[part.points]
            allowed[part.points] &= part.energy.allowed(here, widths[first : first + len(here)])
            first += len(here)
        return allowed


def union_density(densities: Sequence[Density], counts: Sequence[int]) -> Density:
    """Add densities of classes, each scaled to its points.

    Parameters
    ----------
    densities : sequence of Density
        On one grid of pixels.
    counts : sequence of int
        Points of each class.

    Returns
    -------
    Density
    """
    if len(densities) == 1:
        return densities[0]
    total = np.sum([one.of_points(n) for one, n in zip(densities, counts, strict=True)], axis=0)
    return as_density(total, toroidal=densities[0].toroidal)
