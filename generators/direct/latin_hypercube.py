"""Latin hypercube sampling: every axis cut in n strata, one point in each (McKay, Beckman & Conover 1979)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family
from gbnbench.generators.strata import placed_in_strata


@dataclass(frozen=True)
class LatinHypercube:
    """Uniform points of a Latin hypercube with n strata an axis.

    Notes
    -----
    E[P(f)] = 1 + (n - 1) times the product of -sinc(f_a / n)**2 / (n - 1) over the nonzero components of f:
    on an axis 1 - sinc(f_a / n)**2, elsewhere 1 + O(1/n).

    References
    ----------
    McKay, Beckman & Conover, Technometrics 21(2), 1979.

    Examples
    --------
    >>> x = LatinHypercube()(5, 2, np.random.default_rng(0))
    >>> np.sort(np.floor(5 * x), axis=0)[:, 1].tolist()
    [0.0, 1.0, 2.0, 3.0, 4.0]
    """

    name: ClassVar[str] = "latin"
    summary: ClassVar[str] = (
        "Latin hypercube: one point in each of n strata of every axis (McKay et al. 1979)"
    )
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = False
    reference: ClassVar[str] = "McKay, Beckman & Conover, 1979"

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
        strata = rng.permuted(np.tile(np.arange(n), (d, 1)), axis=1).T
        return placed_in_strata(strata, rng.random((n, d)), n)
