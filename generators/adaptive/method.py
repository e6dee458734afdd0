"""The common part of adaptive generators: refusals in words before a set is drawn, and progress."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import MOST_PIXELS, Density
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.ranges import raise_refusal


class AdaptiveMethod(ABC):
    """What adaptive generators share: a refusal before the draw, and progress under their name.

    Attributes
    ----------
    name : str
        What the command calls it.
    """

    name: ClassVar[str]

    def refusal(self, density: Density, n: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Refuse nothing, unless a method says otherwise.

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
        return None

    @abstractmethod
    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set that is not refused.

        Parameters
        ----------
        density : Density
            The density.
        n : int
            Points.
        rng : numpy.random.Generator
            The stream that it is drawn from.
        told : callable
            Takes (steps done, steps in all, what is being done).

        Returns
        -------
        (n, d) float64
            Within the density, in pixels, in the order of its axes.
        """

    def __call__(
        self, density: Density, n: int, rng: np.random.Generator, told: Told | None = None
    ) -> FloatArray:
        """Draw one set, as ``AdaptiveGenerator.__call__``; RefusalError with the reason why not."""
        raise_refusal(self.refusal(density, n))
        return self.one_set(density, n, rng, unheard if told is None else told)


def unheard(done: int, steps: int, doing: str) -> None:
    """Take progress, and do nothing with it.

    Parameters
    ----------
    done, steps : int
        Steps done, and in all.
    doing : str
        What is being done.
    """


def too_fine(
    density: Density, n: int, pixels: int, way_out: str = "a smaller image", most: int = MOST_PIXELS
) -> str | None:
    """Say that pixels would have to be cut into more parts than there may be.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.
    pixels : int
        Parts of pixels in all.
    way_out : str
        What helps, besides fewer points.
    most : int
        How many there may be.

    Returns
    -------
    str or None
        The reason; None where they are few enough.
    """
    if pixels <= most:
        return None
    return (
        f"{n:,} points on {density.values.size:,} pixels need these cut into {pixels:,}, and "
        f"{most:,} are the most: fewer points, or {way_out}"
    )
