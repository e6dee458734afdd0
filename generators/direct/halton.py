"""Randomised Halton points: radical inverses in the first d primes, digits permuted at random (Owen 2017)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import Family


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
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = False
    reference: ClassVar[str] = "Owen, A randomized Halton algorithm in R, 2017"

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say that any n and d can be made: there is no refusal.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        None
        """
        return None

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64."""
        from scipy.stats import qmc  # half a second to load, and the registry imports every generator

        return np.ascontiguousarray(wrap(qmc.Halton(d, scramble=True, seed=rng).random(n)))
