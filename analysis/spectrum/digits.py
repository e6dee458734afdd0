"""Integer frequencies in balanced digits, and how a cube of them becomes the product of two groups.

A digit of base 2F+1 runs over -F .. F (Ahmed, Ren & Wonka 2022, App. C). Any f with |f| <= F is B h + l,
again in balanced digits, |l| <= (B-1)/2 of an odd base B: so a dimension can be divided where a whole one
would leave two groups of very different size, and one dimension alone becomes a product of two.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

TABLE_COST = 40  # multiply-adds that a table's entry costs, against 4 of a pair of entries


@dataclass(frozen=True)
class Axis:
    """Digits of one coordinate in a group: f = multiple * digit, |digit| <= largest.

    Attributes
    ----------
    coordinate : int
        Which of the points' coordinates.
    multiple, largest : int
        Of the digit; base 2*largest+1.
    """

    coordinate: int
    multiple: int
    largest: int

    @property
    def base(self) -> int:
        """Number of digits."""
        return 2 * self.largest + 1


Axes = tuple[Axis, ...]


def divide(axis: Axis, fine: int) -> tuple[Axes, Axes]:
    """Coarse and fine digits of an axis, the fine ones up to fine; an empty part has no axis."""
    base = 2 * fine + 1
    coarse = Axis(axis.coordinate, axis.multiple * base, -(-(axis.largest - fine) // base))
    return ((coarse,) if coarse.largest else ()), (
        (Axis(axis.coordinate, axis.multiple, fine),) if fine else ()
    )


def size(axes: Axes) -> int:
    """Count the frequencies of a group."""
    return math.prod(axis.base for axis in axes)


def half_size(axes: Axes) -> int:
    """Zero and one half space of a group."""
    return (size(axes) + 1) // 2


def whole_axes(d: int, fmax: int) -> Axes:
    """Every coordinate with digits up to fmax."""
    return tuple(Axis(a, 1, fmax) for a in range(d))


@dataclass(frozen=True)
class Division:
    """A group of axes in a leading and a trailing part; the axis divided stands in both.

    Attributes
    ----------
    leading, trailing : tuple of Axis
        Their frequencies' sums are the group's, each once, and perhaps a few beyond its edge.
    at : int
        Position of the axis that is divided, or with which the trailing part begins.
    fine : int
        Its largest fine digit: 0 where all of it leads, its own largest where all of it trails.
    """

    leading: Axes
    trailing: Axes
    at: int
    fine: int


def division(axes: Axes, at: int, fine: int) -> Division:
    """Divide at an axis, whose fine digits trail."""
    coarse, rest = divide(axes[at], fine)
    return Division(axes[:at] + coarse, rest + axes[at + 1 :], at, fine)


@lru_cache(maxsize=256)
def even_division(axes: Axes) -> Division:
    """Division with the fewest entries in both half spaces together: one sine and cosine each."""
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


@lru_cache(maxsize=256)
def cheapest_division(d: int, fmax: int, rows: int) -> Division:
    """Division of a whole cube that a real product in tiles of so many rows evaluates at least cost."""
    axes = whole_axes(d, fmax)
    best: tuple[float, Division] | None = None
    for at in range(d):
        lead, trail = (2 * fmax + 1) ** at, (2 * fmax + 1) ** (d - at - 1)
        ideal = min(round((math.sqrt((2 * fmax + 1) * lead / trail) - 1) / 2), fmax)
        near = range(ideal // 2, 2 * ideal + 3) if d > 1 or fmax < 1 << 12 else (ideal,)
        for fine in {0, fmax, *(min(max(f, 0), fmax) for f in near)}:
            found = division(axes, at, fine)
            a, b = half_size(found.leading), half_size(found.trailing)
            cost = 4 * (-(-a // rows) * rows) * b + TABLE_COST * (a + b)
            if best is None or cost < best[0]:
                best = cost, found
    assert best is not None  # noqa: S101 - d is at least 1
    return best[1]


def half_space(axes: Axes) -> NDArray[np.int64]:
    """Digits of zero and of one half space, in the order of the index: (half_size, axes) int64."""
    bases = tuple(axis.base for axis in axes)
    index = np.arange(size(axes) // 2, size(axes))
    digits = np.stack(np.unravel_index(index, bases), axis=1) if axes else np.zeros((1, 0), np.int64)
    return digits.astype(np.int64) - np.array([axis.largest for axis in axes], np.int64)


def multiples(axes: Axes, digits: NDArray[np.int64], d: int) -> NDArray[np.int64]:
    """Frequency vectors of digits: (m, axes) -> (m, d) int64."""
    f = np.zeros((len(digits), d), np.int64)
    for column, axis in zip(digits.T, axes, strict=True):
        f[:, axis.coordinate] += axis.multiple * column
    return f
