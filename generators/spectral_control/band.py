"""A prescribed power below an edge: what the generators of deep and stealthy blue noise share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.modes import bound_coordinates
from gbnbench.generators.gauss_newton.product_cost import too_long
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.ranges import check_range


def check_edge(edge: float | None) -> None:
    """Refuse an edge that is no frequency.

    Raises
    ------
    InputError
        If it is given and not within 1e-9 and 1e9, where its square is a number yet.
    """
    if edge is not None:
        check_range("edge", edge, 1e-9, 1e9)


class BandGenerator(ABC):
    """A generator whose sets have a given power at every frequency with 0 < nu < edge.

    Attributes
    ----------
    most_bound : float
        Largest share of the n d coordinates that the amplitudes below the edge may bind.
    """

    most_bound: ClassVar[float]

    @abstractmethod
    def band_edge(self, d: int) -> float:
        """Edge of the band in d dimensions, in nu."""

    @abstractmethod
    def too_bound(self, n: int, d: int, bound: float) -> str:
        """Say that a band binds too many coordinates, and what would do.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        bound : float
            Coordinates that the band binds, more than ``most_bound`` n d.

        Returns
        -------
        str
        """

    @abstractmethod
    def draw(self, n: int, d: int, rngs: Sequence[np.random.Generator], monitor: Monitor) -> FloatArray:
        """Draw one set from each stream.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rngs : sequence of numpy.random.Generator
            One for each set.
        monitor : Monitor
            What the caller wants to be told.

        Returns
        -------
        (len(rngs), n, d) float64
        """

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n points in d dimensions cannot have this power below the edge.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason: too few coordinates are left free, or the solution takes hours. None where they can.
        """
        edge = self.band_edge(d)
        bound = bound_coordinates(n, d, edge)
        if bound > self.most_bound * n * d:
            return self.too_bound(n, d, bound)
        return too_long(n, d, edge)

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rng : numpy.random.Generator
            The stream that it is drawn from.

        Returns
        -------
        (n, d) float64
        """
        one: FloatArray = self.draw(n, d, [rng], Monitor())[0]
        return one
