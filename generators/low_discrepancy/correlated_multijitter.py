"""Correlated multi-jittered sampling of any number of points (Kensler 2013)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_above, outside_plane, raise_refusal
from gbnbench.generators.strata import placed_in_strata


@dataclass(frozen=True)
class CorrelatedMultiJitter:
    """A jittered grid of a columns and b rows whose points also fall in strata of their own on both axes.

    Parameters
    ----------
    aspect : float
        Columns by rows, about, > 0.

    Raises
    ------
    InputError
        If it is out of range.

    Notes
    -----
    a = floor(sqrt(n aspect)), b = ceil(n / a). Point s has

        x = (p(s mod a) + (q(floor(s / a)) + u) / b) / a,   y = (s + v) / n,

    with one permutation p of columns for all rows and one q of rows for all columns, which is the paper's
    correlated shuffle, and u, v uniform. So each of n strata of y holds one point; each of a b strata of x
    holds one if n = a b, else at most one. The paper's permutations are hashes, ours are drawn.

    References
    ----------
    Kensler, "Correlated multi-jittered sampling", Pixar Technical Memo 13-01, 2013. Chiu, Shirley & Wang,
    "Multi-jittered sampling", Graphics Gems IV, 1994.

    Examples
    --------
    >>> x = CorrelatedMultiJitter()(12, 2, np.random.default_rng(0))
    >>> np.sort(np.floor(12 * x), axis=0)[:, 0].tolist()
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0]
    """

    name: ClassVar[str] = "cmj"
    summary: ClassVar[str] = "correlated multi-jittered sampling in 2D (Kensler 2013)"
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 2)
    toroidal: ClassVar[bool] = False
    reference: ClassVar[str] = "Kensler, Correlated multi-jittered sampling, 2013"
    aspect: float = 1.0

    def __post_init__(self) -> None:
        check_above("aspect", self.aspect, 0)

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say why not: d is other than 2.

        Parameters
        ----------
        n : int
            Points; any number will do.
        d : int
            Dimension.

        Returns
        -------
        str or None
            The reason; None for d = 2.
        """
        return outside_plane(d, "cmj is a method of the plane")

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, 2) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        columns = max(1, int(min(math.sqrt(n * self.aspect), n)))
        rows = -(-n // columns)
        s = np.arange(n)
        column, row = rng.permutation(columns)[s % columns], rng.permutation(rows)[s // columns]
        jitter = rng.random((n, 2))
        x = placed_in_strata(column * rows + row, jitter[:, 0], columns * rows)
        return np.stack([x, placed_in_strata(s, jitter[:, 1], n)], axis=1)
