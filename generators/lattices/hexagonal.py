"""The hexagonal lattice on the unit torus, as nearly as a periodic lattice of n points can be it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import outside_plane, raise_refusal, too_many

MOST_STRAIN = 0.02  # 1024, 4096 and half of all n near 1,000 fit, nearly all beyond 5,000
MOST_POINTS = 1_000_000  # there are more than n lattices to choose from


@lru_cache(maxsize=1024)
def best_lattice(n: int) -> tuple[int, int, int, float]:
    """Find the lattice of n points nearest to hexagonal, of all with the unit torus's periods.

    Returns
    -------
    a, b, s : int
        Points ((i + j s / b) / a, j / b), 0 <= i < a, 0 <= j < b, n = a b.
    strain : float
        Largest relative change of a length when the hexagonal lattice of the same density is stretched to it.

    Notes
    -----
    Every lattice of index n containing Z^2 has one such (a, b, s) with 0 <= s < b. Its shape is the point
    tau = (s + i a) / b of the upper half plane, taken modulo changes of basis; at hyperbolic distance r from
    the hexagonal shape exp(i pi / 3), the map between the two has singular values exp(r/2) and exp(-r/2).
    """
    low_divisors = [b for b in range(1, math.isqrt(n) + 1) if n % b == 0]
    rows = np.array(sorted({*low_divisors, *(n // b for b in low_divisors)}))
    shears = rows // 2 + 1  # s and b - s are mirror images
    b = np.repeat(rows, shears)
    s = np.arange(len(b)) - np.repeat(np.cumsum(shears) - shears, shears)
    tau = (s + 1j * (n // b)) / b
    while True:  # Gauss's reduction, for all lattices at once
        tau -= np.rint(tau.real)
        low = np.abs(tau) < 1 - 1e-12
        if not low.any():
            break
        tau[low] = -1 / tau[low]
    gap = np.abs(np.abs(tau.real) + 1j * tau.imag - np.exp(1j * np.pi / 3)) ** 2 / tau.imag
    best = int(np.argmin(np.round(gap, 12)))  # the first of equals, whatever the rounding
    strain = float(np.expm1(np.arccosh(1 + gap[best] / np.sqrt(3)) / 2))
    return n // int(b[best]), int(b[best]), int(s[best]), strain


@dataclass(frozen=True)
class Hexagonal:
    """Hexagonal lattice in 2D, at any orientation that makes it periodic.

    No hexagonal lattice is exactly periodic on the unit torus. Of all periodic lattices of n points the one
    nearest to hexagonal is taken, and n is refused where even that one changes some length by more than 2%.

    Parameters
    ----------
    shift : bool
        Move each realization by its own uniform toroidal shift.

    Notes
    -----
    P(f) is n on the reciprocal lattice, 0 elsewhere.

    Examples
    --------
    >>> Hexagonal()(56, 2, np.random.default_rng(0)).shape
    (56, 2)
    """

    name: ClassVar[str] = "hexagonal"
    summary: ClassVar[str] = "hexagonal lattice in 2D, strained by at most 2% to be periodic"
    family: ClassVar[Family] = "lattice"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 2)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = ""
    shift: bool = True

    def refusal(self, n: int, d: int) -> str | None:
        """Say why no lattice of n points is hexagonal enough, with the nearest n that has one.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        if reason := outside_plane(d, "d must be 2 for the hexagonal lattice"):
            return reason
        if reason := too_many(n, MOST_POINTS, "for a hexagonal lattice"):
            return reason
        strain = best_lattice(n)[3]
        if strain <= MOST_STRAIN:
            return None
        nearest, away = 0, 0
        while not nearest:
            away += 1
            fits = [m for m in (n - away, n + away) if m >= 1 and best_lattice(m)[3] <= MOST_STRAIN]
            nearest = fits[0] if fits else 0
        return (
            f"n must fit a hexagonal lattice strained by at most {MOST_STRAIN:.0%} on the unit torus; "
            f"got n={n} (strain {strain:.1%}), nearest is {nearest}"
        )

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        a, b, s, _ = best_lattice(n)
        j, i = np.divmod(np.arange(n), a)
        x = np.stack([i / a + (j * s % n) / n, j / b], axis=1)
        return wrap(x + rng.random(d)) if self.shift else wrap(x)
