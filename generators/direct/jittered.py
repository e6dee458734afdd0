"""Stratified (jittered) sampling on a regular grid (Cook 1986)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.lattices.regular_grid import grid_corners, grid_refusal
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import raise_refusal
from gbnbench.generators.strata import placed_in_strata


@dataclass(frozen=True)
class Jittered:
    """One uniform point in each of the n = m**d cells of a regular grid.

    Notes
    -----
    E[P(f)] = 1 - prod over a of sinc(f_a / m)**2 for f != 0, with sinc(t) = sin(pi t) / (pi t).

    References
    ----------
    Cook, "Stochastic sampling in computer graphics", ACM TOG 5(1), 1986.

    Examples
    --------
    >>> Jittered().refusal(1000, 2)
    'n must be m**2 for a jittered grid; got n=1000, nearest is 1024'
    """

    name: ClassVar[str] = "jittered"
    summary: ClassVar[str] = "one uniform point in each cell of a grid of m**d (Cook 1986)"
    family: ClassVar[Family] = "direct"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Cook, Stochastic sampling in computer graphics, 1986"

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n is not m**d, with the nearest number that is.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        return grid_refusal("a jittered grid", n, d)

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        m = round(n ** (1.0 / d))
        return placed_in_strata(grid_corners(m, d), rng.random((n, d)), m)
