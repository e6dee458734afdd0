"""An adaptive energy at a set of points, and what a descent asks of such an energy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density


@dataclass(frozen=True)
class AdaptiveGradient:
    """The energy at a set.

    Attributes
    ----------
    energy : float
        E less 1/2 the integral of T^2; of a sum of energies the sum of that, each with its weight.
    gradient : (n, d) float64
        Its slope by each point, a pixel.
    widths : (n,) float64
        Width of each point's kernel, pixels; of a sum of energies those of each, one after the other.
    spacings : (n,) float64
        Local spacing of the points, pixels.
    stiffness : (n,) float64
        The unit that the uniform method's curvature has at each point.
    """

    energy: float
    gradient: FloatArray
    widths: FloatArray
    spacings: FloatArray
    stiffness: FloatArray


class DescendedEnergy(Protocol):
    """An energy of points in a domain."""

    @property
    def density(self) -> Density:
        """Of all points: its borders hold them."""
        ...

    @property
    def sigma(self) -> float:
        """Kernel width of the uniform method, in spacings."""
        ...

    def __call__(self, x: FloatArray) -> AdaptiveGradient:
        """Evaluate the energy and its gradient.

        Parameters
        ----------
        x : (n, d) float64
            Points within the density, in pixels.

        Returns
        -------
        AdaptiveGradient
        """
        ...

    def allowed(self, x: FloatArray, widths: FloatArray) -> NDArray[np.bool_]:
        """Tell which places have ink, and kernels not much wider than before.

        Parameters
        ----------
        x : (n, d) float64
            Places within the density, in pixels.
        widths : (m,) float64
            Of the kernels before, as ``AdaptiveGradient`` has them.

        Returns
        -------
        (n,) bool
        """
        ...
