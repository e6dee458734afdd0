"""The protocol of adaptive generators: settings that draw a set with the density of an image or a volume."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density

Told = Callable[[int, int, str], None]
Seen = Callable[[Sequence[FloatArray]], None]


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


@runtime_checkable
class ClassGenerator(AdaptiveGenerator, Protocol):
    """A generator that also draws sets of several classes, each of them blue noise and so their union."""

    def classes(
        self,
        densities: Sequence[Density],
        counts: Sequence[int],
        rngs: Sequence[np.random.Generator],
        told: Told | None = None,
        seen: Seen | None = None,
    ) -> list[FloatArray]:
        """Draw one set a class.

        Parameters
        ----------
        densities : sequence of Density
            One a class, on one grid of pixels.
        counts : sequence of int
            Points of each class.
        rngs : sequence of numpy.random.Generator
            The streams that they are drawn from.
        told : callable, optional
            Called with (steps done, steps in all, what is being done).
        seen : callable, optional
            Called with the points at the start and after each step.

        Returns
        -------
        list of (n, d) float64
            In pixels.

        Raises
        ------
        RefusalError
            If the sets cannot be made.
        """
        ...
