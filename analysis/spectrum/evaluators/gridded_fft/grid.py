"""Size and layout of the real grid to which points are carried."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gbnbench.analysis.precision import padded
from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import Window, window
from gbnbench.core.torus import FloatArray

AXES = 3  # axes at most: a point reaches WIDTH nodes on each
WIDTH = {"double": 16, "float": 8}  # cells of the window
DEGREE = {"double": 19, "float": 11}  # degree of its polynomials
# Nodes for each frequency -fmax .. fmax: with these the error of the window is less than rounding.
OVERSAMPLING = {"double": 2.23, "float": 2.0}

TILE = {"double": 4, "float": 8}  # rows or columns of the plane that are transformed at once


@dataclass(frozen=True)
class RealGrid:
    """A grid of equal axes for the frequencies |f_a| <= fmax.

    Attributes
    ----------
    d, fmax : int
        Axes, 1 to 3, and largest harmonic on each.
    precision : {"double", "float"}
        Precision of the nodes.
    nodes : int
        Nodes of an axis.
    row_length : int
        Numbers from one row of the last axis to the next: the nodes, and a window's cells beyond them, which
        are folded back.
    """

    d: int
    fmax: int
    precision: str
    nodes: int
    row_length: int

    @property
    def width(self) -> int:
        """Cells of the window."""
        return WIDTH[self.precision]

    @property
    def bins(self) -> int:
        """Bins of an axis, each as wide as a window, by which points are sorted and counted."""
        return -(-self.nodes // self.width)

    @property
    def size(self) -> int:
        """Numbers of a grid."""
        rows = self.nodes * (self.nodes + self.width) if self.d == 3 else self.nodes
        return (1 if self.d == 1 else rows) * self.row_length

    @property
    def itemsize(self) -> int:
        """Bytes of a number."""
        return 8 if self.precision == "double" else 4

    @property
    def window(self) -> Window:
        """The window of this precision."""
        return window(WIDTH[self.precision], DEGREE[self.precision], OVERSAMPLING[self.precision])

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of a grid in memory, with what stands beyond its nodes."""
        return {
            1: (self.row_length,),
            2: (self.nodes, self.row_length),
            3: (self.nodes, self.nodes + self.width, self.row_length),
        }[self.d]


@lru_cache(maxsize=64)
def real_grid(d: int, fmax: int, precision: str) -> RealGrid:
    """Lay out the grid of a request.

    Parameters
    ----------
    d, fmax : int
        Axes, 1 to 3, and largest harmonic on each.
    precision : {"double", "float"}
        Precision of the nodes.

    Returns
    -------
    RealGrid
        Of an even number of nodes whose prime factors are small, so that its transform is fast; in the plane
        the number is a multiple of ``TILE``.
    """
    least = max(math.ceil(OVERSAMPLING[precision] * (2 * fmax + 1)), 2 * WIDTH[precision])
    step = TILE[precision] if d == 2 else 2
    nodes = next_fast_length(least)
    while nodes % step:
        nodes = next_fast_length(nodes + 1)
    row = padded(nodes + WIDTH[precision], 8)
    if row % 64 == 0:  # rows a power of two apart would share the same places of the cache
        row += 8
    return RealGrid(d, fmax, precision, nodes, row)


def next_fast_length(least: int) -> int:
    """Return the smallest product of powers of 2, 3 and 5 that is at least some number.

    It is ``scipy.fft.next_fast_len`` of real data, whose import takes a fifth of a second in every process.

    Parameters
    ----------
    least : int
        At least 1.

    Returns
    -------
    int

    Examples
    --------
    >>> [next_fast_length(least) for least in (1, 7, 11, 97)]
    [1, 8, 12, 100]
    """
    found = 1 << (least - 1).bit_length()  # the power of 2
    five = 1
    while five < found:
        odd = five
        while odd < found:
            found = min(found, odd << max(-(-least // odd) - 1, 0).bit_length())
            odd *= 3
        five *= 5
    return found


@lru_cache(maxsize=16)
def transform_of_window(grid: RealGrid) -> FloatArray:
    """Give the transform of the window at the harmonics of an axis.

    Parameters
    ----------
    grid : RealGrid
        The grid.

    Returns
    -------
    (fmax + 1,) float64
    """
    return grid.window.transform(grid.fmax, grid.nodes)


@lru_cache(maxsize=4)
def window_terms(precision: str) -> FloatArray:
    """Give the window's polynomials in the lower half of its cells, as even and odd ones in place less 1/2.

    Parameters
    ----------
    precision : {"double", "float"}
        Precision, which decides the window.

    Returns
    -------
    (terms, width) float64
        Highest power of the square first: the even parts of all lower cells, then the odd ones divided by the
        place. The upper cells are mirror images: even less odd.
    """
    shape = window(WIDTH[precision], DEGREE[precision], OVERSAMPLING[precision])
    rising = shape.coefficients[::-1, : shape.width // 2]
    return np.ascontiguousarray(np.concatenate([rising[0::2], rising[1::2]], axis=1)[::-1])
