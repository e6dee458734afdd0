"""Kronecker sequences of the generalised golden ratio (Kronecker 1884; Roberts 2018)."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal, localcontext
from functools import lru_cache
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import raise_refusal, too_many, too_many_axes

MOST_DIMENSIONS = 100  # beyond, the ratio is so near 1 that axes follow one another
MOST_POINTS = 2**32
DIGITS = 60  # decimal ones, of the ratio


def generalised_golden_ratio(d: int) -> Decimal:
    """Positive root of phi**(d + 1) = phi + 1, by Newton's method: the golden ratio for d = 1.

    Parameters
    ----------
    d : int
        Dimension.

    Returns
    -------
    Decimal
        To some 58 digits.
    """
    with localcontext(prec=DIGITS):
        ratio = Decimal(2)
        for _ in range(200):  # from above the root of a convex function, every step lowers it
            step = (ratio ** (d + 1) - ratio - 1) / ((d + 1) * ratio**d - 1)
            if ratio - step >= ratio:
                break
            ratio -= step
    return ratio


@lru_cache(maxsize=128)
def steps(d: int) -> tuple[tuple[int, int], ...]:
    """Powers phi**-1, ..., phi**-d in turns: 64 binary digits of each, and the next 32."""
    with localcontext(prec=DIGITS):
        ratio = generalised_golden_ratio(d)
        return tuple(divmod(int(ratio**-k * 2**96), 2**32) for k in range(1, d + 1))


@dataclass(frozen=True)
class Kronecker:
    """First n points of the R_d sequence, {s + i alpha}.

    Parameters
    ----------
    shift : bool
        Begin each realization at its own uniform s; without it at 1/2, as Roberts does.

    Notes
    -----
    alpha = (phi**-1, phi**-2, ..., phi**-d), where phi**(d + 1) = phi + 1. In 1D these are the multiples of
    the golden ratio, whose gaps have at most three lengths. Any prefix is such a set, on the torus. Multiples
    are counted in whole units of 2**-64, and cut to 53 digits: every coordinate is within 2**-52 of its
    place, however far the sequence.

    References
    ----------
    Roberts, "The unreasonable effectiveness of quasirandom sequences", Extreme Learning, 2018. Kuipers &
    Niederreiter, "Uniform distribution of sequences", 1974.

    Examples
    --------
    >>> Kronecker(shift=False)(3, 2, np.random.default_rng(0)).round(4).tolist()
    [[0.2549, 0.0698], [0.0098, 0.6397], [0.7646, 0.2095]]
    """

    name: ClassVar[str] = "kronecker"
    summary: ClassVar[str] = (
        "R_d sequence: multiples of powers of the generalised golden ratio (Roberts 2018)"
    )
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (1, MOST_DIMENSIONS)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Roberts, The unreasonable effectiveness of quasirandom sequences, 2018"
    shift: bool = True

    def refusal(self, n: int, d: int) -> str | None:
        """Say why there is no such sequence in d dimensions, or none of n points.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason; None for d <= 100 and n <= 2**32.
        """
        return too_many_axes(d, MOST_DIMENSIONS, "for the R_d sequence, whose axes grow alike") or too_many(
            n, MOST_POINTS, "for the R_d sequence"
        )

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        i = np.arange(1, n + 1, dtype=np.uint64)[:, None]
        alpha, rest = np.array(steps(d), dtype=np.uint64).T
        start = rng.random(d) if self.shift else np.full(d, 0.5)
        # modulo 2**64, which are a turn
        turned = (start * 2.0**64).astype(np.uint64) + i * alpha + (i * rest >> np.uint64(32))
        return np.asarray((turned >> np.uint64(11)) * 2.0**-53, dtype=np.float64)
