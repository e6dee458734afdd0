"""The window: a box with its corners in the points' unit, and the check of points that it holds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray

MOST_DIMENSIONS = 8
LEAST_POINTS = 16  # fewer points give no estimate worth its error
VOLUMES = (1e-140, 1e140)


@dataclass(frozen=True)
class Window:
    """A box [low, high] in which a point process is seen.

    Attributes
    ----------
    low, high : (d,) float64
        Opposite corners, in the unit of the points.
    """

    low: FloatArray
    high: FloatArray

    @property
    def sides(self) -> FloatArray:
        """Lengths of the sides: (d,)."""
        return self.high - self.low

    @property
    def volume(self) -> float:
        """Volume, in the points' unit to the power d."""
        return float(np.prod(self.sides))

    @property
    def d(self) -> int:
        """Dimension."""
        return len(self.low)

    def fractions(self, points: FloatArray) -> FloatArray:
        """Return points as fractions of the sides, in [0, 1]: (n, d)."""
        scaled: FloatArray = (points - self.low) / self.sides
        return scaled


def check_window(points: ArrayLike, low: ArrayLike, high: ArrayLike) -> tuple[FloatArray, Window]:
    """Return points and the window they lie in, or raise an error that says what is wrong.

    Parameters
    ----------
    points : (n, d) array_like
        Coordinates in any unit, n >= 16.
    low, high : float or (d,) array_like
        Opposite corners of the window, one number for all axes or one an axis.

    Returns
    -------
    points : (n, d) float64
    window : Window

    Raises
    ------
    InputError
        If points are no (n, d) real numbers, d is above 8, there are fewer than 16 of them or all are one,
        the corners are no corners of a box, its volume is not between 1e-140 and 1e140, or a point lies
        outside.

    Examples
    --------
    >>> points, window = check_window(np.random.default_rng(0).random((20, 2)) * [4, 1], 0, [4, 1])
    >>> window.sides.tolist(), window.volume
    ([4.0, 1.0], 4.0)
    """
    try:
        given = np.asarray(points)
        if given.dtype.kind not in "fiu" or isinstance(points, np.ma.MaskedArray):
            raise TypeError
        x = np.ascontiguousarray(given, dtype=np.float64)
        corners = [np.asarray(corner, dtype=np.float64) for corner in (low, high)]
    except (TypeError, ValueError):
        raise InputError("points, low and high must be real numbers, none of them masked") from None
    if x.ndim != 2 or x.shape[1] == 0:
        raise InputError(f"points must be (n, d), one set of one window; got shape {x.shape}")
    n, d = x.shape
    if d > MOST_DIMENSIONS:
        raise RefusalError(
            f"estimates in a window are made in up to {MOST_DIMENSIONS} dimensions; beyond, nearly every "
            f"point lies at its border; got d={d}. Project the points onto fewer axes, as with --columns"
        )
    if n < LEAST_POINTS:
        raise InputError(f"estimates in a window need at least {LEAST_POINTS} points; got {n}")
    for corner, name in zip(corners, ("low", "high"), strict=True):
        if corner.shape not in ((), (d,)):
            raise InputError(
                f"{name} must be one number or {d} of them, one an axis; got shape {corner.shape}"
            )
    least, most = (np.broadcast_to(corner, (d,)).copy() for corner in corners)
    with np.errstate(invalid="ignore", over="ignore"):
        sides = most - least
    if not (np.isfinite(sides).all() and (sides > 0).all()):
        raise InputError(
            f"low must be below high on every axis, and both finite; got low={least.tolist()}, "
            f"high={most.tolist()}"
        )
    volume = float(np.prod(sides))
    if not VOLUMES[0] < volume < VOLUMES[1]:
        raise InputError(
            f"the window's volume is {volume:g}, whose square is too small or too large for a number: give "
            "points and window in another unit"
        )
    outside = ~((x >= least) & (x <= most))
    if outside.any():
        i, a = (int(index) for index in np.argwhere(outside)[0])
        raise InputError(
            f"points must lie in the window: coordinate {a} of point {i} is {float(x[i, a])!r}, and the "
            f"window reaches from {least[a]:g} to {most[a]:g} there "
            f"({int(outside.any(axis=1).sum())} points of {n} "
            "lie outside). Give a window that holds them all, or cut the set to the window first"
        )
    if (x == x[0]).all():
        raise InputError(f"all {n} points are one point, {x[0].tolist()}: nothing can be estimated")
    return x, Window(least, most)
