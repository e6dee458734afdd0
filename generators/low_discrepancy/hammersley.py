"""Hammersley points: i/n beside the radical inverses of i in the first d - 1 primes (Hammersley 1960)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import Family


def primes(count: int) -> list[int]:
    """Return the first so many primes."""
    found: list[int] = []
    sieve = np.ones(max(16, int(count * (np.log(count + 2) + np.log(np.log(count + 3)) + 2))), dtype=bool)
    sieve[:2] = False
    for p in range(2, len(sieve)):
        if len(found) == count:
            break
        if sieve[p]:
            found.append(p)
            sieve[p * p :: p] = False
    return found


def radical_inverse(i: np.typing.NDArray[np.int64], base: int) -> FloatArray:
    """Mirror the digits of whole numbers at the point.

    Parameters
    ----------
    i : (n,) int64
        Numbers, >= 0.
    base : int
        Of the digits, >= 2.

    Returns
    -------
    (n,) float64
        In [0, 1); rounded once, hence exact in base 2, as long as i times the base is below 2**53.
    """
    left, mirrored, whole = i.copy(), np.zeros_like(i), 1
    while left.any():
        left, digit = np.divmod(left, base)
        mirrored, whole = mirrored * base + digit, whole * base
    return np.asarray(mirrored / whole, dtype=np.float64)


@dataclass(frozen=True)
class Hammersley:
    """The Hammersley set of n points.

    Parameters
    ----------
    shift : bool
        Move each realization by its own uniform toroidal shift (Cranley & Patterson 1976); without it all
        realizations are the same set.

    Notes
    -----
    Point i = 0, ..., n - 1 is (i/n, phi_2(i), phi_3(i), phi_5(i), ...). In 2D at n = 2**m they are a
    (0, m, 2)-net in base 2; the shift moves its elementary intervals along.

    References
    ----------
    Hammersley, "Monte Carlo methods for solving multivariable problems", Annals of the New York Academy of
    Sciences 86, 1960. Cranley & Patterson, "Randomization of number theoretic methods for multiple
    integration", SIAM J. Numer. Anal. 13(6), 1976.

    Examples
    --------
    >>> Hammersley(shift=False)(4, 2, np.random.default_rng(0)).tolist()
    [[0.0, 0.0], [0.25, 0.5], [0.5, 0.25], [0.75, 0.75]]
    """

    name: ClassVar[str] = "hammersley"
    summary: ClassVar[str] = "Hammersley set in the first primes, randomly shifted (Hammersley 1960)"
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = False
    reference: ClassVar[str] = "Hammersley, 1960; Cranley & Patterson, 1976"
    shift: bool = True

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
        i = np.arange(n, dtype=np.int64)
        x = np.stack([i / n, *(radical_inverse(i, base) for base in primes(d - 1))], axis=1)
        return wrap(x + rng.random(d)) if self.shift else wrap(x)
