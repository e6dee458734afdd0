"""The frequencies of a half space below an edge in nu, and how many coordinates they bind."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gbnbench.core.integer_frequencies import IntArray, half_ball, shell_counts
from gbnbench.core.torus import FloatArray

MANY = 1e150  # counts are capped here, so that their products stay finite
LARGEST = 1e300  # |f|^2 is capped here, far beyond what any work allows
COUNTED = 5000  # |f|^2 beyond which the ball's volume is near enough
ROUNDING = 1e-9  # of |f|^2: frequencies on the edge itself are left out


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
        Frequencies, the first component that is not 0 being positive, in lexicographic order.
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


def largest_square(n: int, d: int, edge: float) -> int:
    """Return the largest |f|**2 with nu < edge.

    Parameters
    ----------
    n, d : int
        Points and dimension, which give the spacing n**(-1/d).
    edge : float
        In nu.

    Returns
    -------
    int
        0 where even the lowest frequency is not below the edge.
    """
    radius = edge * math.pow(n, 1 / d)
    return max(0, math.ceil(min(radius * radius * (1 - ROUNDING), LARGEST)) - 1)


def modes_below(n: int, d: int, edge: float) -> Modes:
    """List the frequencies of a half space with 0 < nu < edge.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    edge : float
        In nu.

    Returns
    -------
    Modes
    """
    f = half_ball(d, largest_square(n, d, edge))
    q = 2 * math.pi * f / math.pow(n, 1 / d)
    length = np.sqrt(np.sum(q**2, axis=1))
    return Modes(n, d, edge, f, length, q / length[:, None])


def edge_binding(share: float, d: int) -> float:
    """Return the edge below which the frequencies bind a share of the coordinates: V_d nu^d = share d.

    Parameters
    ----------
    share : float
        > 0.
    d : int
        Dimension.

    Returns
    -------
    float
        In nu.

    Examples
    --------
    >>> [round(edge_binding(0.6, d), 3) for d in (1, 2, 3, 5)]
    [0.3, 0.618, 0.755, 0.894]
    """
    log_ball = d / 2 * math.log(math.pi) - math.lgamma(d / 2 + 1)
    return math.exp((math.log(share * d) - log_ball) / d)


def bound_coordinates(n: int, d: int, edge: float) -> float:
    """Count the real numbers that amplitudes below an edge bind: two for each pair f, -f with 0 < nu < edge.

    Disordered solutions exist while they are fewer than the coordinates, n d.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    edge : float
        In nu.

    Returns
    -------
    float

    Examples
    --------
    >>> bound_coordinates(1024, 2, 0.1), len(modes_below(1024, 2, 0.1))
    (36.0, 18)
    """
    return ball_count(d, largest_square(n, d, edge))


def ball_count(d: int, square: int) -> float:
    """Count the integer vectors with 0 < |f|**2 <= square, without a list; in large balls by their volume.

    Parameters
    ----------
    d : int
        Number of components.
    square : int
        Largest |f|**2.

    Returns
    -------
    float
        At most 1e150; good to 1e-3 where square is above 5000.
    """
    if square > COUNTED:
        return math.exp(min(d / 2 * math.log(math.pi * square) - math.lgamma(d / 2 + 1), math.log(MANY)))
    if d == 0:
        return 0.0
    return float(min(shell_counts(d, square, MANY)[1].sum() - 1, MANY))
