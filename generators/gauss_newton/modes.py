"""Frequencies of one half space below an edge in nu, and how many numbers they bind."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

IntArray = NDArray[np.int64]
MANY = 1e150  # counts are capped here, so that their products stay finite
COUNTED = 5000  # squared radius beyond which the ball's volume is near enough
ROUNDING = 1e-9  # of a squared radius: frequencies on the edge itself are left out


@dataclass(frozen=True, eq=False)
class Modes:
    """One of each pair f, -f with 0 < nu < edge.

    Attributes
    ----------
    n, d : int
        Points and dimension.
    edge : float
        In nu.
    f : (m, d) int64
        Frequencies, the first component that is not 0 being positive, in lexical order.
    length : (m,) float64
        |q| = 2 pi nu, radians a spacing.
    direction : (m, d) float64
        q / |q|.
    """

    n: int
    d: int
    edge: float
    f: IntArray
    length: FloatArray
    direction: FloatArray

    def __len__(self) -> int:
        """Count the pairs."""
        return len(self.f)

    @property
    def nu(self) -> FloatArray:
        """|f| n**(-1/d), (m,)."""
        return self.length / (2 * math.pi)

    @property
    def square(self) -> IntArray:
        """|f|**2, (m,)."""
        square: IntArray = np.sum(self.f**2, axis=1)
        return square


def squared_reach(n: int, d: int, edge: float) -> int:
    """Return the largest |f|**2 below the edge."""
    radius = edge * math.pow(n, 1 / d)
    return max(0, math.ceil(radius**2 * (1 - ROUNDING)) - 1)


def half_ball(reach: int, d: int) -> IntArray:
    """One of each pair f, -f of integer vectors with 0 < |f|**2 <= reach, in lexical order: (m, d)."""
    side = math.isqrt(reach)
    axis = np.arange(-side, side + 1)
    found = np.zeros((1, 0), np.int64)
    square = np.zeros(1, np.int64)
    for _ in range(d):
        grown = square[:, None] + axis**2
        row, column = np.nonzero(grown <= reach)
        found = np.concatenate([found[row], axis[column, None]], axis=1)
        square = grown[row, column]
        # Of vectors that are 0 so far only those that go on to be positive, or stay 0, are kept.
        leading = found[np.arange(len(found)), np.argmax(found != 0, axis=1)]
        found, square = found[leading >= 0], square[leading >= 0]
    return found[square > 0]


def modes(n: int, d: int, edge: float) -> Modes:
    """List the frequencies with 0 < nu < edge of n points in d dimensions."""
    f = half_ball(squared_reach(n, d, edge), d)
    q = 2 * math.pi * f / math.pow(n, 1 / d)
    length = np.sqrt(np.sum(q**2, axis=1))
    return Modes(n, d, edge, f, length, q / length[:, None])


def edge_of(share: float, d: int) -> float:
    """Edge in nu below which a share of the coordinates is bound: V_d nu^d = share d.

    Examples
    --------
    >>> [round(edge_of(0.6, d), 3) for d in (1, 2, 3, 5)]
    [0.3, 0.618, 0.755, 0.894]
    """
    log_ball = d / 2 * math.log(math.pi) - math.lgamma(d / 2 + 1)
    return math.exp((math.log(share * d) - log_ball) / d)


def bound(n: int, d: int, edge: float) -> float:
    """Real numbers bound by the amplitudes below the edge: integer vectors with 0 < nu < edge, both halves.

    Disordered solutions exist while they are fewer than the coordinates, n d.

    Examples
    --------
    >>> bound(1024, 2, 0.1), len(modes(1024, 2, 0.1))
    (36.0, 18)
    """
    return count(squared_reach(n, d, edge), d)


def count(reach: int, d: int) -> float:
    """Integer vectors with 0 < |f|**2 <= reach, at most 1e150.

    By the theta series, without a list; in large balls by their volume, to 1e-3.
    """
    if reach > COUNTED:
        return math.exp(min(d / 2 * math.log(math.pi * reach) - math.lgamma(d / 2 + 1), math.log(MANY)))
    theta = np.zeros(reach + 1)
    squares = np.arange(math.isqrt(reach) + 1) ** 2
    theta[squares] = 2.0
    theta[0] = 1.0
    series, power, left = np.eye(1, reach + 1)[0], theta, d
    while left:
        if left % 2:
            series = np.minimum(np.convolve(series, power)[: reach + 1], MANY)
        power = np.minimum(np.convolve(power, power)[: reach + 1], MANY)
        left //= 2
    return float(min(series.sum() - 1, MANY))
