"""Progressive multi-jittered (0,2) sequences (Christensen, Kensler & Kilpatrick 2018)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import outside_plane, raise_refusal, too_many

BITS = 53  # of a coordinate
MOST_BITS = 24  # log2 of the most points


def missing_digits(
    digits: NDArray[np.int64], bits: int, across: NDArray[np.int64], net: NDArray[np.int64], m: int
) -> NDArray[np.int64]:
    """Find the one stratum of width 2**-(m + 1) that a net leaves to each new point on an axis.

    Parameters
    ----------
    digits : (k,) int64
        First binary digits of the new points on the axis.
    bits : int
        Their number, at least m / 2.
    across : (k,) int64
        Digits on the other axis, as many.
    net : (2, 2**m) int64
        Points of a (0, m, 2)-net in units of 2**-53, the axis first.
    m : int
        log2 of their number.

    Returns
    -------
    (k,) int64
        The first m + 1 digits.

    Notes
    -----
    An elementary interval of area 2**-m holds one point of the net, and in a net of twice the size one point
    in each of its halves. So the next digit of a new point is the opposite of that of the old point in the
    interval of its first j digits on the axis and its first m - j across.
    """
    for j in range(bits, m + 1):
        owner = np.empty(2**m, dtype=np.int64)
        owner[((net[0] >> (BITS - j)) << (m - j)) | (net[1] >> (BITS - m + j))] = np.arange(2**m)
        old = owner[(digits << (m - j)) | (across >> (bits - m + j))]
        digits = (digits << 1) | (1 - (net[0, old] >> (BITS - j - 1) & 1))
    return digits


def doubled(net: NDArray[np.int64], m: int, rng: np.random.Generator) -> NDArray[np.int64]:
    """Add 2**m points to a net of as many, such that it is a net again.

    Parameters
    ----------
    net : (2, 2**m) int64
        In units of 2**-53.
    m : int
        log2 of their number.
    rng : Generator
        Of the choices and of the places in the strata.

    Returns
    -------
    (2, 2**(m + 1)) int64
        The old points first.
    """
    bits = (m + 1) // 2
    digits = net >> (BITS - bits)
    if m % 2:  # each cell of 2**(m - 1) holds two points, at opposite corners: the others are taken in turn
        way = int(rng.integers(0, 2))
        digits = digits ^ np.array([[way], [1 - way]])
    x = missing_digits(digits[0], bits, digits[1], net, m)
    y = missing_digits(digits[1], bits, digits[0], net[::-1], m)
    free = BITS - m - 1
    new = (np.stack([x, y]) << free) | rng.integers(0, 2**free, size=(2, 2**m))
    return np.concatenate([net, new], axis=1)


@dataclass(frozen=True)
class ProgressiveMultiJitter:
    """First n points of a pmj02 sequence, a (0, 2)-sequence in base 2.

    Every 2**m points from a multiple of 2**m on are a (0, m, 2)-net: all prefixes of 2**m points, and what
    stands between them.

    Notes
    -----
    The sequence is doubled time and again. From 4**k points on, the new point of a cell of the grid of 4**k
    comes into the subquadrant opposite to the old one; from 2 4**k on, into one of the two left, then into
    the other. With its subquadrant a point's strata on both axes are given: the digits are those that the old
    points leave to it (``missing_digits``), which the paper finds by trial, and its place in the stratum is
    uniform.

    Which of the two comes first is one coin for all cells, which is what makes a (0, 2)-sequence (Helmer et
    al. 2021). A coin for each cell, as in the paper's first algorithm, makes nets of the prefixes alone, and
    the paper itself balances these choices between the powers of four. Its variant that chooses among
    candidates by distance is not made.

    References
    ----------
    Christensen, Kensler & Kilpatrick, "Progressive multi-jittered sample sequences", CGF 37(4), 2018. Pharr,
    "Efficient generation of points that satisfy two-dimensional elementary intervals", JCGT 8(1), 2019.
    Helmer, Christensen & Kensler, "Stochastic generation of (t, s) sample sequences", EGSR 2021.

    Examples
    --------
    >>> x = ProgressiveMultiJitter()(8, 2, np.random.default_rng(0))
    >>> np.sort(np.floor(x * [4, 2]) @ [2, 1]).tolist()
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    """

    name: ClassVar[str] = "pmj02"
    summary: ClassVar[str] = "progressive multi-jittered (0,2) sequence in 2D (Christensen et al. 2018)"
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 2)
    toroidal: ClassVar[bool] = False
    reference: ClassVar[str] = "Christensen, Kensler & Kilpatrick, 2018"

    def refusal(self, n: int, d: int) -> str | None:
        """Say why not: d is other than 2, or n too large.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        return outside_plane(d, "pmj02 is a sequence in the plane") or too_many(n, 2**MOST_BITS, "for pmj02")

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, 2) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        net = rng.integers(0, 2**BITS, size=(2, 1))
        for m in range((n - 1).bit_length()):
            net = doubled(net, m, rng)
        return np.asarray(np.ascontiguousarray(net[:, :n].T) * 2.0**-BITS, dtype=np.float64)
