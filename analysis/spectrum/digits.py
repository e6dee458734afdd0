"""Balanced digits of integer frequencies, and the division of a cube of frequencies in two groups.

A digit of base 2F+1 runs over -F .. F (Ahmed, Ren & Wonka 2022, App. C). For an odd base B, every f with |f|
<= F is B h + l with |l| <= (B-1)/2 and both h and l in balanced digits again. An axis can thus be cut in a
coarse and a fine part. This makes two groups of nearly the same size out of any number of axes, even of one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import padded

Harmonics = int | tuple[int, ...]  # largest harmonic on every axis of a cube, or on each axis of a box

TABLE_COST = 40  # multiply-adds for an entry of a table; a pair of entries takes 4


@dataclass(frozen=True)
class Axis:
    """One digit of the frequency on one coordinate: f = multiple * digit with |digit| <= largest.

    Attributes
    ----------
    coordinate : int
        Index of the points' coordinate.
    multiple : int
        Weight of the digit in the frequency.
    largest : int
        Largest digit; the base is 2*largest+1.
    """

    coordinate: int
    multiple: int
    largest: int

    @property
    def base(self) -> int:
        """Number of values of the digit."""
        return 2 * self.largest + 1


Axes = tuple[Axis, ...]


def divide(axis: Axis, fine: int) -> tuple[Axes, Axes]:
    """Cut an axis in coarse and fine digits.

    Parameters
    ----------
    axis : Axis
        The axis.
    fine : int
        Largest fine digit, 0 .. axis.largest.

    Returns
    -------
    coarse, fine : tuple of Axis
        One axis each, or none where the part has no digit but 0.
    """
    base = 2 * fine + 1
    coarse = Axis(axis.coordinate, axis.multiple * base, -(-(axis.largest - fine) // base))
    return ((coarse,) if coarse.largest else ()), (
        (Axis(axis.coordinate, axis.multiple, fine),) if fine else ()
    )


def size(axes: Axes) -> int:
    """Count the frequencies of a group."""
    return math.prod(axis.base for axis in axes)


def half_size(axes: Axes) -> int:
    """Count zero and one half space of a group of axes."""
    return (size(axes) + 1) // 2


def each_axis(d: int, fmax: Harmonics) -> tuple[int, ...]:
    """Give the largest harmonic on each axis, of a cube or of a box.

    Parameters
    ----------
    d : int
        Dimension.
    fmax : int or tuple of d ints
        One number for every axis of a cube, or one an axis.

    Returns
    -------
    tuple of d ints
    """
    return (fmax,) * d if isinstance(fmax, int) else fmax


def whole_axes(d: int, fmax: Harmonics) -> Axes:
    """List one undivided axis for each coordinate.

    Parameters
    ----------
    d : int
        Dimension.
    fmax : int or tuple of d ints
        Largest harmonic on each axis.

    Returns
    -------
    tuple of Axis
    """
    return tuple(Axis(a, 1, largest) for a, largest in enumerate(each_axis(d, fmax)))


@dataclass(frozen=True)
class Division:
    """Division of a group of axes in a leading and a trailing part; the axis that is cut stands in both.

    Attributes
    ----------
    leading, trailing : tuple of Axis
        Sums of one frequency of each part give every frequency of the group once. They may also give a few
        beyond the group's edge.
    at : int
        Position of the axis that is cut, or with which the trailing part begins.
    fine : int
        Largest fine digit of that axis: 0 where the whole axis leads, its own largest where the whole axis
        trails.
    """

    leading: Axes
    trailing: Axes
    at: int
    fine: int


def division(axes: Axes, at: int, fine: int) -> Division:
    """Divide a group at one of its axes, whose fine digits go to the trailing part.

    Parameters
    ----------
    axes : tuple of Axis
        The group.
    at : int
        Position of the axis that is cut.
    fine : int
        Its largest fine digit.

    Returns
    -------
    Division
    """
    coarse, rest = divide(axes[at], fine)
    return Division(axes[:at] + coarse, rest + axes[at + 1 :], at, fine)


@lru_cache(maxsize=256)
def even_division(axes: Axes) -> Division:
    """Find the division whose two half spaces have the fewest frequencies together.

    Every one of them takes a sine and a cosine, so this division is the cheapest to tabulate.
    """
    if not axes:
        return Division((), (), 0, 0)
    best: tuple[int, Division] | None = None
    for at, axis in enumerate(axes):
        lead, trail = size(axes[:at]), size(axes[at + 1 :])
        ideal = round((math.sqrt(axis.base * lead / trail) - 1) / 2)
        for fine in {0, axis.largest, *(min(max(ideal + e, 0), axis.largest) for e in (-1, 0, 1))}:
            found = division(axes, at, fine)
            entries = half_size(found.leading) + half_size(found.trailing)
            if best is None or entries < best[0]:
                best = entries, found
    assert best is not None  # noqa: S101 - a group has an axis
    return best[1]


def zero_apart(count: int, columns: int) -> bool:
    """Tell whether f = 0 of a trailing group would need a part of a block of its own, and is summed apart.

    Parameters
    ----------
    count : int
        Frequencies of the group's half space, f = 0 among them.
    columns : int
        Columns of the smallest part of a block.

    Returns
    -------
    bool
    """
    return columns > 1 and count % columns == 1


def multiplied_columns(count: int, columns: int) -> int:
    """Count the columns that are multiplied for a trailing group.

    Parameters
    ----------
    count, columns : int
        As in ``zero_apart``.

    Returns
    -------
    int
        A multiple of ``columns``; 0 where f = 0 is all.
    """
    return count - 1 if zero_apart(count, columns) else padded(count, columns)


@lru_cache(maxsize=256)
def cheapest_division(d: int, fmax: Harmonics, rows: int, columns: int = 1) -> Division:
    """Find the division of a whole cube or box that a real matrix product evaluates at the least cost.

    Parameters
    ----------
    d : int
        Dimension.
    fmax : int or tuple of d ints
        Largest harmonic on each axis.
    rows : int
        Rows of a register tile; the leading group is padded to a multiple of it.
    columns : int
        Columns of the smallest part of a block, as in ``multiplied_columns``.

    Returns
    -------
    Division
    """
    axes = whole_axes(d, fmax)
    best: tuple[float, Division] | None = None
    for at, axis in enumerate(axes):
        lead, trail = size(axes[:at]), size(axes[at + 1 :])
        ideal = min(round((math.sqrt(axis.base * lead / trail) - 1) / 2), axis.largest)
        near = range(ideal // 2, 2 * ideal + 3) if d > 1 or axis.largest < 1 << 12 else (ideal,)
        for fine in {0, axis.largest, *(min(max(f, 0), axis.largest) for f in near)}:
            found = division(axes, at, fine)
            a, b = half_size(found.leading), half_size(found.trailing)
            cost = 4 * padded(a, rows) * multiplied_columns(b, columns) + TABLE_COST * (a + b)
            if best is None or cost < best[0]:
                best = cost, found
    assert best is not None  # noqa: S101 - d is at least 1
    return best[1]


def half_space(axes: Axes) -> NDArray[np.int64]:
    """Digits of zero and of one half space, in the order of their indices: (half_size, axes) int64."""
    bases = tuple(axis.base for axis in axes)
    index = np.arange(size(axes) // 2, size(axes))
    digits = np.stack(np.unravel_index(index, bases), axis=1) if axes else np.zeros((1, 0), np.int64)
    return digits.astype(np.int64) - np.array([axis.largest for axis in axes], np.int64)


def multiples(axes: Axes, digits: NDArray[np.int64], d: int) -> NDArray[np.int64]:
    """Turn digits into frequency vectors.

    Parameters
    ----------
    axes : tuple of Axis
        The group.
    digits : (m, axes) int64
        One digit for each axis.
    d : int
        Dimension.

    Returns
    -------
    (m, d) int64
        Frequencies; 0 on coordinates that the group lacks.
    """
    f = np.zeros((len(digits), d), np.int64)
    for column, axis in zip(digits.T, axes, strict=True):
        f[:, axis.coordinate] += axis.multiple * column
    return f
