"""Tori with unequal sides: rectangles and boxes of volume 1, whose points stay fractions of their sides.

A point x of [0, 1)^d lies at X_a = s_a x_a, and an integer frequency f is the wave vector k_a = f_a / s_a, so
that f.x = k.X: power at f does not change, only the length |k| by which it is ordered. Lengths are in units
of the box's volume^(1/d). So the spacing is n**(-1/d) and nu = |k| n**(-1/d) in every box, as in the cube.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

Sides = tuple[float, ...]

EQUAL = 1e-9  # of the longest side: sides that differ by no more are those of a cube
MOST_UNEQUAL = 1e6  # longest side over the shortest


def as_sides(sides: ArrayLike | None, d: int) -> Sides | None:
    """Check the sides of a torus, and scale them to volume 1.

    Parameters
    ----------
    sides : (d,) array_like or None
        Lengths of the sides in any unit; only their ratios count. None is a cube.
    d : int
        Dimension of the points.

    Returns
    -------
    tuple of d floats, or None
        Sides whose product is 1; None for a cube, which a torus of one dimension always is.

    Raises
    ------
    InputError
        If sides are not d positive numbers within a factor of 1e6 of one another.

    Examples
    --------
    >>> [round(side, 4) for side in as_sides((200, 100), 2)]
    [1.4142, 0.7071]
    >>> as_sides((512, 512), 2) is None
    True
    """
    if sides is None:
        return None
    try:
        given = np.asarray(sides)
        if given.dtype.kind not in "fiu":
            raise TypeError
        lengths = given.astype(np.float64)
    except (TypeError, ValueError):
        raise InputError(f"sides must be {d} lengths, such as {_example(d)}; got {sides!r}") from None
    if lengths.shape != (d,):
        raise InputError(
            f"sides must be {d} lengths, one for each coordinate, such as {_example(d)}; got {sides!r}"
        )
    if not (np.isfinite(lengths).all() and (lengths > 0).all()):
        raise InputError(f"sides must be positive and finite lengths; got {sides!r}")
    shortest, longest = float(lengths.min()), float(lengths.max())
    if longest / shortest > MOST_UNEQUAL:
        raise InputError(f"sides must lie within a factor of {MOST_UNEQUAL:g} of one another; got {sides!r}")
    if longest - shortest <= EQUAL * longest:
        return None
    ratios = lengths / longest
    unit = math.exp(float(np.log(ratios).mean()))
    return tuple(float(ratio / unit) for ratio in ratios)


def _example(d: int) -> str:
    return str((2,) + (1,) * (d - 1)) if d > 1 else "[1]"


def shortest_side(sides: Sides | None) -> float:
    """Length of the shortest side: half of it is the radius of the largest ball that fits the torus."""
    return 1.0 if sides is None else min(sides)


def positions(x: FloatArray, sides: Sides | None) -> FloatArray:
    """Place points in the box: fractions of the sides become lengths.

    Parameters
    ----------
    x : (..., d) float64
        Points of [0, 1)^d.
    sides : tuple of d floats, or None
        As ``as_sides`` returns them.

    Returns
    -------
    (..., d) float64
        In [0, s_a) on axis a; x itself for a cube.
    """
    if sides is None:
        return x
    box = np.array(sides)
    return np.asarray(np.minimum(x * box, np.nextafter(box, 0.0)), dtype=np.float64)  # s_a may be rounded to


def wave_numbers(frequencies: ArrayLike, sides: Sides | None) -> FloatArray:
    """Length |k| of the wave vectors k_a = f_a / s_a.

    Parameters
    ----------
    frequencies : (..., d) array_like of int
        Integer frequencies, cycles per side.
    sides : tuple of d floats, or None
        As ``as_sides`` returns them.

    Returns
    -------
    (...) float64
        Cycles per unit length, the box having volume 1; |f| for a cube.
    """
    f = np.asarray(frequencies, dtype=np.float64)
    k = f if sides is None else f / np.array(sides)
    return np.asarray(np.sqrt((k * k).sum(axis=-1)), dtype=np.float64)


def squared_lengths(harmonics: tuple[int, ...], sides: Sides | None) -> FloatArray:
    """|k|^2 of every frequency of a box |f_a| <= harmonics[a].

    Parameters
    ----------
    harmonics : tuple of d ints
        Largest harmonic on each axis.
    sides : tuple of d floats, or None
        As ``as_sides`` returns them.

    Returns
    -------
    (2*f_a+1, ...) float64
        Zero frequency at the centre; whole numbers for a cube.
    """
    d = len(harmonics)
    total = np.zeros((1,) * d)
    for axis, (largest, side) in enumerate(zip(harmonics, sides or (1.0,) * d, strict=True)):
        squares = np.arange(-largest, largest + 1, dtype=np.float64) ** 2 / side**2
        total = total + squares.reshape([-1 if a == axis else 1 for a in range(d)])
    return total


def sides_text(sides: Sides) -> str:
    """Write the ratios of the sides, the shortest being 1: "2:1"."""
    least = min(sides)
    return ":".join(f"{round(side / least, 9):.6g}" for side in sides)
