"""Randomised Halton points: radical inverses in the first d primes, digits permuted at random (Owen 2017)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import raise_refusal, too_many_axes

MOST_DIMENSIONS = 3000  # permutations of their primes' digits take a gigabyte, and grow as d**2


@dataclass(frozen=True)
class Halton:
    """First n points of a randomised Halton sequence; not toroidal by design.

    Notes
    -----
    scipy's engine: each digit position of each prime has its own uniform permutation, shared by all points,
    so b**k points have one in each stratum of width b**-k of the axis with prime b, and there they are a
    shifted regular grid.

    References
    ----------
    Halton, Numerische Mathematik 2, 1960. Owen, "A randomized Halton algorithm in R", arXiv:1706.02808, 2017.

    Examples
    --------
    >>> x = Halton()(9, 2, np.random.default_rng(0))
    >>> np.sort(np.floor(9 * x[:, 1])).tolist()
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]
    """

    name: ClassVar[str] = "halton"
    summary: ClassVar[str] = "Halton sequence with randomly permuted digits (Owen 2017)"
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (1, MOST_DIMENSIONS)
    toroidal: ClassVar[bool] = False
    reference: ClassVar[str] = "Owen, A randomized Halton algorithm in R, 2017"

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say why the permutations of d primes are too many.

        Parameters
        ----------
        n : int
            Points; any number will do.
        d : int
            Dimension.

        Returns
        -------
        str or None
            The reason; None for d <= 3000.
        """
        return too_many_axes(d, MOST_DIMENSIONS, "for Halton points and their permutations")

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        from scipy.stats import qmc  # half a second to load, and the registry imports every generator

        return np.ascontiguousarray(wrap(qmc.Halton(d, scramble=True, seed=rng).random(n)))
