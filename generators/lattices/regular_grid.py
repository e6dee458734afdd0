"""The regular grid Z^d / m on the torus, and the arithmetic of sizes n = m**d."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import raise_refusal


def grid_side(n: int, d: int) -> int | None:
    """Return the whole m with m**d = n, None where there is none.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    int
        m, the points on an axis.

    Examples
    --------
    >>> grid_side(1024, 2), grid_side(1000, 2)
    (32, None)
    """
    side = round(n ** (1.0 / d))
    return side if side**d == n else None


def grid_refusal(what: str, n: int, d: int) -> str | None:
    """Why n is not m**d, with the nearest that is; None where it is.

    Parameters
    ----------
    what : str
        The grid, for the message.
    n, d : int
        Points and dimension.

    Returns
    -------
    str or None
        The reason, with the nearest numbers that can; None where they can.

    Examples
    --------
    >>> grid_refusal("a jittered grid", 1000, 2)
    'n must be m**2 for a jittered grid; got n=1000, nearest is 1024'
    """
    if grid_side(n, d) is not None:
        return None
    side = round(n ** (1.0 / d))
    nearest = min((m**d for m in range(max(side - 1, 1), side + 2)), key=lambda size: abs(size - n))
    return f"n must be m**{d} for {what}; got n={n}, nearest is {nearest}"


def grid_corners(m: int, d: int) -> FloatArray:
    """List the lower corners of the cells of a grid, in units of a cell.

    Parameters
    ----------
    m : int
        Cells on an axis.
    d : int
        Dimension.

    Returns
    -------
    (m**d, d) float64
        Whole numbers.
    """
    if m == 1:  # in any dimension; arrays have at most 64 axes
        return np.zeros((1, d))
    return np.ascontiguousarray(np.indices((m,) * d, dtype=np.float64).reshape(d, -1).T)


@dataclass(frozen=True)
class Grid:
    """Regular grid of n = m**d points.

    Parameters
    ----------
    shift : bool
        Move each realization by its own uniform toroidal shift; without it the points are the centres of the
        cells, the same in every realization.

    Notes
    -----
    P(f) = n where m divides every f_a, 0 elsewhere.

    Examples
    --------
    >>> Grid(shift=False)(4, 2, np.random.default_rng(0)).tolist()
    [[0.25, 0.25], [0.25, 0.75], [0.75, 0.25], [0.75, 0.75]]
    """

    name: ClassVar[str] = "grid"
    summary: ClassVar[str] = "regular grid of m**d points, each realization shifted at random"
    family: ClassVar[Family] = "lattice"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = ""
    shift: bool = True

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n is not m**d, with the nearest number that is.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        return grid_refusal("a regular grid", n, d)

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        raise_refusal(self.refusal(n, d))
        m = round(n ** (1.0 / d))
        offset = rng.random(d) if self.shift else np.full(d, 0.5)
        return wrap((grid_corners(m, d) + offset) / m)
