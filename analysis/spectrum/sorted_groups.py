"""Groups of axes whose frequencies are sorted by |f|^2, so that those of a ball or a band can be counted.

A frequency of the cube is a pair: one frequency of the leading axes and one of the trailing axes. The
trailing frequencies that make up a band with a given leading one are consecutive in the sorted list.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.digits import Axes, size, whole_axes
from gbnbench.core.errors import RefusalError


@dataclass(frozen=True)
class SortedGroup:
    """The frequencies of one half space of a group of axes within a ball, ascending in |f|^2.

    Attributes
    ----------
    axes : tuple of Axis
        The group's axes.
    order : (count,) uint64
        Indices in base-(2F+1) digits.
    square : (count,) int64
        |f|^2 of each frequency.
    """

    axes: Axes
    order: NDArray[np.uint64]
    square: NDArray[np.int64]


def sorted_group(axes: Axes, most: int) -> SortedGroup:
    """List one half space of |f|^2 <= most, axis by axis, so that nothing outside the ball is ever listed.

    Parameters
    ----------
    axes : tuple of Axis
        The group's axes.
    most : int
        Largest |f|^2.

    Returns
    -------
    SortedGroup

    Raises
    ------
    RefusalError
        If the group's indices do not fit in 64 bits.
    """
    if size(axes) >= 1 << 63:
        raise RefusalError(
            f"a group of {len(axes)} axes has {float(size(axes)):.2g} frequencies, beyond 2^63"
        )
    index, square = np.zeros(1, np.int64), np.zeros(1, np.int64)
    for axis in axes:
        reach = min(axis.largest, math.isqrt(most))
        digit = np.arange(axis.largest - reach, axis.largest + reach + 1)
        total = square[:, None] + (digit - axis.largest) ** 2
        keep = total <= most
        index = (index[:, None] * axis.base + digit)[keep]
        square = total[keep]
    half = index >= size(axes) // 2
    index, square = index[half], square[half]
    order = np.lexsort((index, square))
    return SortedGroup(axes, index[order].astype(np.uint64), square[order])


def two_sorted_groups(d: int, fmax: int, most: int) -> tuple[SortedGroup, SortedGroup]:
    """Sort the frequencies of the leading and of the trailing half of the axes.

    Parameters
    ----------
    d, fmax : int
        Dimension, and largest harmonic on each axis.
    most : int
        Largest |f|^2.

    Returns
    -------
    leading, trailing : SortedGroup
    """
    axes = whole_axes(d, fmax)
    return sorted_group(axes[: d // 2], most), sorted_group(axes[d // 2 :], most)


def count_pairs(a: SortedGroup, b: SortedGroup, low: int, high: int) -> int:
    """Count the pairs whose squares add up to low .. high.

    Parameters
    ----------
    a, b : SortedGroup
        The leading and the trailing axes.
    low, high : int
        Smallest and largest |f|^2.

    Returns
    -------
    int
        Each pair stands for up to four frequencies: (fa, fb), (fa, -fb) and their mirror images.
    """
    start = np.searchsorted(b.square, low - a.square)
    end = np.searchsorted(b.square, high - a.square, side="right")
    return int(np.maximum(end - start, 0).sum())
