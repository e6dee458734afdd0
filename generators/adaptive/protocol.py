"""The protocol of adaptive generators: settings that draw a set with the density of an image or a volume."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density

Told = Callable[[int, int, str], None]


@runtime_checkable
class AdaptiveGenerator(Protocol):
    """A generator of points for a density.

    Attributes
    ----------
    name : str
        What the command calls it.
    summary : str
        One line for lists, with the source.
    reference : str
        The publication that it follows.
    """

    name: ClassVar[str]
    summary: ClassVar[str]
    reference: ClassVar[str]

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why n points cannot be made for a density.

        Parameters
        ----------
        density : Density
            The density.
        n : int
            Points, >= 1.

        Returns
        -------
        str or None
            The reason; None where the set can be made.
        """
        ...

    def __call__(
        self, density: Density, n: int, rng: np.random.Generator, told: Told | None = None
    ) -> FloatArray:
        """Draw one set.

        Parameters
        ----------
        density : Density
            The density.
        n : int
            Points.
        rng : numpy.random.Generator
            The stream that it is drawn from; the same state gives the same set.
        told : callable, optional
            Called with (steps done, steps in all, what is being done).

        Returns
        -------
        (n, d) float64
            Within the density, in pixels, in the order of its axes: rows first.
        """
        ...
