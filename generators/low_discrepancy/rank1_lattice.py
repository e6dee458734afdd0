"""Rank-1 lattices of Korobov's form, of the best figure of merit (Korobov 1959; Sloan & Joe 1994)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import raise_refusal, too_many, too_many_axes

Criterion = Literal["p2", "distance"]
MOST_POINTS = 2**20  # products of two residues are exact in int64, and the search takes seconds
MOST_DIMENSIONS = 20  # beyond, P_2 is its constant term but for rounding
MOST_TERMS = 3e8  # residues that the search may look at
CHUNK = 2**21


def candidates(n: int, d: int) -> NDArray[np.int64]:
    """List generators to be tried: residues prime to n up to n/2, or of these an even share that time allows.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    (k,) int64
    """
    a = np.arange(1, max(2, n // 2 + 1), dtype=np.int64)
    a = a[np.gcd(a, n) == 1]
    most = max(16, int(MOST_TERMS / (n * d)))
    return a if len(a) <= most else np.asarray(a[np.linspace(0, len(a) - 1, most).astype(np.int64)])


def korobov_vectors(a: NDArray[np.int64], n: int, d: int) -> NDArray[np.int64]:
    """Vectors (1, a, a**2, ..., a**(d - 1)) mod n.

    Parameters
    ----------
    a : (k,) int64
        Generators.
    n, d : int
        Points and dimension.

    Returns
    -------
    (k, d) int64
    """
    z = np.ones((len(a), d), dtype=np.int64)
    for axis in range(1, d):
        z[:, axis] = z[:, axis - 1] * a % n
    return z


def merits(z: NDArray[np.int64], n: int, criterion: Criterion) -> FloatArray:
    """Figure of merit of lattices; less is better.

    Parameters
    ----------
    z : (k, d) int64
        Their generating vectors.
    n : int
        Points.
    criterion : {"p2", "distance"}
        P_2, or the least distance of two points, negative.

    Returns
    -------
    (k,) float64

    Notes
    -----
    P_2 = -1 + (1/n) sum over points of the product over axes of 1 + 2 pi**2 (x_a**2 - x_a + 1/6):
    the sum over the dual lattice without 0 of the product of max(1, |h_a|)**-2 (Sloan & Joe 1994, Sec. 4.2).
    """
    i = np.arange(n // 2 + 1, dtype=np.int64)  # a lattice is its own mirror image
    u = np.arange(n) / n
    bernoulli = 1 + 2 * np.pi**2 * (u * u - u + 1 / 6)
    square = np.minimum(u, 1 - u) ** 2
    twice = np.where((i == 0) | (2 * i == n), 1.0, 2.0)
    found = np.empty(len(z))
    step = max(1, CHUNK // len(i))
    for first in range(0, len(z), step):
        part = z[first : first + step]
        if criterion == "p2":
            product = np.ones((len(part), len(i)))
            for axis in range(z.shape[1]):
                product *= bernoulli[part[:, axis, None] * i % n]
            found[first : first + step] = product @ twice / n - 1
        else:
            total = np.zeros((len(part), len(i) - 1))
            for axis in range(z.shape[1]):
                total += square[part[:, axis, None] * i[1:] % n]
            found[first : first + step] = -np.sqrt(total.min(axis=1)) if n > 1 else 0.0
    return found


@lru_cache(maxsize=64)
def best_generator(n: int, d: int, criterion: Criterion) -> int:
    """Find the generator whose lattice has the best figure of merit, the smallest of equals.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    criterion : {"p2", "distance"}
        Figure of merit.

    Returns
    -------
    int
    """
    a = candidates(n, d)
    merit = merits(korobov_vectors(a, n, d), n, criterion)
    return int(a[np.flatnonzero(merit <= merit.min() + 1e-12 * abs(merit.min()))[0]])


@dataclass(frozen=True)
class Rank1Lattice:
    """The lattice {i (1, a, a**2, ...) / n} of the best a, randomly shifted.

    Parameters
    ----------
    criterion : {"p2", "distance"}
        Figure of merit by which a is chosen: the worst-case error P_2 of periodic functions, least, or the
        least distance of two points on the torus, greatest (Dammertz & Keller 2008).
    shift : bool
        Move each realization by its own uniform toroidal shift.

    Notes
    -----
    All a up to n/2 prime to n are tried (n - a gives the mirror image), or, where that were more than
    3e8 residues (in 2D beyond n = 17,000), as many of them, evenly spread; the choice is the same for every
    seed. An a that shares a divisor with n makes points coincide on an axis and is left out, though by
    ``distance`` it may be better: by an eighth at n = 100.

    In 2D the dual lattice is the lattice itself, turned and enlarged, so that ``distance`` is the spectral
    test. At Fibonacci numbers n in 2D, P_2 is least for the Fibonacci lattice, whose L2-periodic discrepancy
    is least of all lattices of that size as far as they were searched. P(f) is n on the dual lattice, 0
    elsewhere.

    References
    ----------
    Korobov, "The approximate computation of multiple integrals", Dokl. Akad. Nauk SSSR 124, 1959. Sloan &
    Joe, "Lattice methods for multiple integration", 1994. Dammertz & Keller, "Image synthesis by rank-1
    lattices", MCQMC 2006, 2008.

    Examples
    --------
    >>> best_generator(89, 2, "p2")
    34
    """

    name: ClassVar[str] = "rank1"
    summary: ClassVar[str] = (
        "rank-1 lattice of Korobov's form of least P_2 or greatest distance (Sloan & Joe 1994)"
    )
    family: ClassVar[Family] = "lattice"
    dimensions: ClassVar[tuple[int, int | None]] = (1, MOST_DIMENSIONS)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Korobov, 1959; Sloan & Joe, 1994; Dammertz & Keller, 2008"
    criterion: Criterion = "p2"
    shift: bool = True

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n or d is too large for the search.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        return too_many_axes(d, MOST_DIMENSIONS, "for the search of rank-1 lattices") or too_many(
            n, MOST_POINTS, "for a search of lattices"
        )

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        z = korobov_vectors(np.array([best_generator(n, d, self.criterion)]), n, d)
        x = np.arange(n, dtype=np.int64)[:, None] * z % n / n
        return wrap(x + rng.random(d)) if self.shift else wrap(x)
