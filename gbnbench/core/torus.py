"""Points on the unit torus [0, 1)^d: validation, wrapping, distances, spacings and exact fractions."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.real_numbers import as_real_numbers

FloatArray = NDArray[np.float64]

BITS_OF_ONE = 0x3FF0000000000000  # of the double 1.0, read as an integer
# Determinants of the densest lattices known in d = 9 ... 24, scaled to a minimal squared length of 4: of
# laminated lattices, in d = 11 to 13 of Coxeter and Todd's family (Conway & Sloane, Tables 1.3 and 6.1).
DETERMINANTS = (512, 768, 972, 729, 972, 768, 512, 256, 256, 192, 128, 64, 32, 12, 4, 1)
# Hermite's constant gamma_d: of the densest lattice for d <= 8 and d = 24, of the densest known between.
HERMITE = (
    1.0, 2 / math.sqrt(3), 2 ** (1 / 3), math.sqrt(2), 8**0.2, (64 / 3) ** (1 / 6), 64 ** (1 / 7), 2.0,
    *(4 / determinant ** (1 / d) for d, determinant in enumerate(DETERMINANTS, start=9)),
)  # fmt: skip


def check_points(x: ArrayLike) -> FloatArray:
    """Return x as float64 points of the unit torus, or raise an error that says why it is none.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Coordinates in [0, 1).

    Returns
    -------
    (n, d) or (realizations, n, d) float64
        The same points, C-contiguous.

    Raises
    ------
    InputError
        If x has another shape, is empty, is not finite, or leaves [0, 1).

    Examples
    --------
    >>> check_points([[0.25, 0.5]]).shape
    (1, 2)
    """
    try:
        array = np.asarray(x)
        if array.dtype.kind not in "fiub" or isinstance(x, np.ma.MaskedArray):
            raise TypeError
        points = np.ascontiguousarray(array, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(
            "x must be an array of real numbers, none of them masked, (n, d) or (realizations, n, d)"
        ) from None
    if points.ndim not in (2, 3) or 0 in points.shape:
        raise InputError(
            f"x must be (n, d) or (realizations, n, d) with no empty axis; got shape {points.shape}"
        )
    # As integers, doubles of [0, 1) are the least; what is negative, -0.0 too, or no number is larger than 1.
    if points.view(np.uint64).max() >= BITS_OF_ONE:
        inside = (points >= 0) & (points < 1)
        if not inside.all():
            where = tuple(int(i) for i in np.argwhere(~inside)[0])
            raise InputError(
                f"points must lie in [0, 1); got {float(points[where])!r} at index {where}. On a torus, "
                "gbnbench.wrap(x) brings them inside; gbnbench.scale(x, low, high) does it for a box"
            )
    return points


def as_realizations(x: ArrayLike) -> FloatArray:
    """Return checked points as (realizations, n, d); one set becomes one realization."""
    points = check_points(x)
    return points if points.ndim == 3 else points[None]


def wrap(x: ArrayLike) -> FloatArray:
    """Bring coordinates onto [0, 1) by whole turns.

    Parameters
    ----------
    x : (..., d) array_like
        Finite coordinates, in sides of the unit torus.

    Returns
    -------
    (..., d) float64
        The same points of the torus, in [0, 1).

    Raises
    ------
    InputError
        If x holds anything but real numbers, or masked ones.

    Notes
    -----
    ``-1e-17 % 1.0`` rounds to 1.0; the torus has no 1.0, so it becomes 0.

    Examples
    --------
    >>> wrap([1.25, -1e-17])
    array([0.25, 0.  ])
    """
    reals = as_real_numbers(x, "x must be an array of real numbers, none of them masked, (..., d)")
    turned: FloatArray = np.atleast_1d(np.mod(reals, 1.0))
    turned[turned >= 1.0] = 0.0
    return turned


def scale(x: ArrayLike, low: ArrayLike = 0.0, high: ArrayLike = 1.0) -> FloatArray:
    """Map points of a box onto the unit torus: (x - low) / (high - low).

    Parameters
    ----------
    x : (..., d) array_like
        Points of the box, low <= x <= high.
    low, high : float or (d,) array_like
        Corners of the box, one number for all axes or one an axis, in the units of x.

    Returns
    -------
    (..., d) float64
        In [0, 1): the far side of the box is the near one of the torus, so that high becomes 0.

    Raises
    ------
    InputError
        If low and high are no corners of a box, or a point lies outside it or is not finite.

    Examples
    --------
    >>> scale([[0.0, 15.0], [2.5, 20.0]], low=[0, 10], high=[10, 20])
    array([[0.  , 0.5 ],
           [0.25, 0.  ]])
    """
    rule = "x, low and high must be real numbers, none masked: x (..., d), low, high one number or d of them"
    points, least, most = (as_real_numbers(value, rule) for value in (x, low, high))
    try:
        outside = ~((points >= least) & (points <= most))
    except ValueError:
        raise InputError(rule) from None
    if outside.shape != points.shape:
        raise InputError(f"low and high must be one number or one an axis of x; x has shape {points.shape}")
    if not (np.isfinite(least).all() and np.isfinite(most).all() and (least < most).all()):
        raise InputError(f"low must be below high on every axis; got low={low!r}, high={high!r}")
    if outside.any():
        where = tuple(int(i) for i in np.argwhere(outside)[0])
        raise InputError(
            f"points must lie in the box from low to high; got {float(points[where])!r} at index {where}"
        )
    scaled: FloatArray = np.atleast_1d((points - least) / (most - least))
    scaled[scaled >= 1.0] = 0.0
    return scaled


def displacement(a: FloatArray, b: FloatArray) -> FloatArray:
    """Shortest vector from b to a on the torus.

    Parameters
    ----------
    a, b : (..., d) float64
        Points on the unit torus; shapes broadcast.

    Returns
    -------
    (..., d) float64
        Each coordinate in [-1/2, 1/2], good to 2^-53 of itself: the turn is taken off the coordinate that
        needs it, which is exact, before the other is subtracted. a - b first would leave of points that
        nearly meet across the border only what 1 - a has digits for.
    """
    turns = np.rint(a - b)
    difference: FloatArray = (a - np.maximum(turns, 0.0)) - (b + np.minimum(turns, 0.0))
    return difference


def toroidal_distance(a: FloatArray, b: FloatArray) -> FloatArray:
    """Length of the shortest vector from b to a on the torus.

    Parameters
    ----------
    a, b : (..., d) float64
        Points on the unit torus; shapes broadcast.

    Returns
    -------
    (...) float64
        Distances, at most sqrt(d)/2.
    """
    distance: FloatArray = np.sqrt(np.sum(displacement(a, b) ** 2, axis=-1))
    return distance


def spacing(n: int, d: int) -> float:
    """Nominal grid spacing n**(-1/d), the unit of sigma and the inverse of the unit of frequency in nu.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    float
        In box sides.
    """
    return math.pow(n, -1.0 / d)


def densest_spacing(n: int, d: int) -> float:
    """Minimum distance of the densest known lattice: sqrt(gamma_d) n**(-1/d).

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    float
        In box sides; nan for d > 24. In 2D it is d_hex = sqrt(2 / (sqrt(3) n)), the unit of PSA's distances.
    """
    if d > len(HERMITE):
        return math.nan
    return math.sqrt(HERMITE[d - 1]) * spacing(n, d)


def fixed_point(x: FloatArray, bits: int) -> NDArray[Any]:
    """Coordinates as unsigned fractions of a turn: uint32 or uint64, so that f.x mod 1 is integer wrap.

    Parameters
    ----------
    x : (...) float64
        Coordinates in [0, 1).
    bits : {32, 64}
        64 is exact for every multiple of 2**-64, so for every double from 2**-12 up.

    Returns
    -------
    (...) uint32 or uint64
        ``rint(x * 2**bits) mod 2**bits``.
    """
    if bits == 64:  # a turn off from 1/2 up is exact, and processors convert to signed integers faster
        signed: NDArray[Any] = np.rint((x - (x >= 0.5)) * 2.0**64).astype(np.int64)
        return signed.view(np.uint64)
    return np.rint(x * 2.0**32).astype(np.uint64).astype(np.uint32)
