"""The frequencies of a ball as pairs of rows of two tables of real waves, and their weights."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import shell_counts
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import kernel

TILE = (4, 3)  # rows of the leading and the trailing table that are multiplied at once
MOST_ROWS = 20_000  # of a table


def square_needed(n: int, d: int, sigma: float, precision: str) -> int:
    """Return |f|^2 beyond which no frequency shows in a gradient of the precision.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.

    Returns
    -------
    int

    Notes
    -----
    The forces of one pair at frequencies left out add up to less than half a rounding of the largest force:
    sum over |f|^2 > s of |f| exp(-b |f|^2), bounded by an integral over the ball's surface.
    """
    b = kernel.decay(kernel.side_of(n, d), sigma)
    surface = math.log(2) + d / 2 * math.log(math.pi) - math.lgamma(d / 2)
    allowed = math.log(kernel.EPS[precision] / 4) + _log_strength(n, d, sigma)
    square = 1
    while True:
        r = math.sqrt(square + 1)
        # a surface r^(d-1) of |f| = r at the next shell, over its decay 2 b r; twice for the lattice
        tail = surface + d * math.log(r) - b * (r * r) - math.log(min(1.0, 2 * b * r)) + math.log(2)
        if tail <= allowed:
            return square
        square += max(1, math.floor(0.02 * square))


def _log_strength(n: int, d: int, sigma: float) -> float:
    """Logarithm of the largest force of one pair over 2 pi mean / L, as the series sum |f| w_f counts it."""
    side = kernel.side_of(n, d)
    mean = d * math.log(math.sqrt(2 * math.pi) * sigma / side)
    return math.log(kernel.largest_force(n, d, sigma)) - mean - math.log(2 * math.pi / side)


def ball_volume(d: int, square: int) -> float:
    """Count the frequencies with |f|^2 <= square, exactly where that is quick.

    Parameters
    ----------
    d : int
        Dimension.
    square : int
        Largest |f|^2.

    Returns
    -------
    float
    """
    if d < 2:
        return 1.0 + 2 * d * math.isqrt(square)
    if square * math.sqrt(square) * d <= 3e5:
        return float(shell_counts(d, square)[1].sum())
    return math.pow(math.pi, d / 2) / math.gamma(d / 2 + 1) * math.pow(math.sqrt(square) + 0.5, d)


def ball_square(n: int, d: int, sigma: float, precision: str, edge: float | None) -> int:
    """Return the largest |f|^2 that is summed.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.
    precision : {"double", "float"}
        Of the arithmetic.
    edge : float or None
        Highest nu that is summed.

    Returns
    -------
    int

    Raises
    ------
    InputError
        If edge is not positive, or so small that no frequency is left.
    """
    if edge is None:
        return square_needed(n, d, sigma, precision)
    if not edge > 0:
        raise InputError(f"edge must be positive, in nu = |f| n^(-1/d); got {edge}")
    side = kernel.side_of(n, d)
    if edge * side < 1 - 1e-12:
        raise InputError(
            f"edge={edge} leaves no frequency of {n} points in {d}D: the lowest is {1 / side:.4g}"
        )
    within = math.floor((edge * side) ** 2 * (1 + 1e-12)) if math.isfinite(edge) else 1 << 60
    return min(within, square_needed(n, d, sigma, precision))


@dataclass(frozen=True)
class AxisGroup:
    """The waves of some axes, in ascending |f|^2, padded to whole tiles by rows of no weight.

    Attributes
    ----------
    first : int
        Axis of the points at which the group begins.
    index : (rows, axes) uint32
        Wave of each axis: 0 for 1, 2 f - 1 for cos 2 pi f x, 2 f for sin 2 pi f x.
    square : (rows,) int64
        |f|^2; beyond every ball for rows that pad.
    """

    first: int
    index: NDArray[np.uint32]
    square: NDArray[np.int64]

    @property
    def rows(self) -> int:
        """Rows, those that pad among them."""
        return len(self.index)

    @property
    def axes(self) -> int:
        """Axes of the points that the group covers."""
        return int(self.index.shape[1])

    def derivative(self) -> tuple[NDArray[np.uint32], FloatArray]:
        """Return the derivative of each row along each axis, as another row and a factor: (rows, axes) both.

        Notes
        -----
        cos' = -2 pi f sin and sin' = 2 pi f cos; a constant has the factor 0.
        """
        f = (self.index.astype(np.int64) + 1) // 2
        sine = self.index % 2 == 0
        where = {tuple(row): i for i, row in enumerate(self.index[self.square < PADDING].tolist())}
        partner = np.zeros(self.index.shape, np.uint32)
        for i, row in enumerate(self.index.tolist()):
            for a, wave in enumerate(row):
                if wave:
                    other = [*row[:a], wave - 1 if wave % 2 == 0 else wave + 1, *row[a + 1 :]]
                    partner[i, a] = where[tuple(other)]
        return partner, 2 * np.pi * np.where(sine, f, -f)


PADDING = 1 << 40


def axis_group(first: int, axes: int, square: int, tile: int) -> AxisGroup:
    """List the waves of some axes with |f|^2 <= square.

    Parameters
    ----------
    first : int
        Axis of the points at which the group begins.
    axes : int
        How many axes it has.
    square : int
        Largest |f|^2.
    tile : int
        Rows are padded to a multiple of this.

    Returns
    -------
    AxisGroup

    Raises
    ------
    RefusalError
        If they are too many.
    """
    count = ball_volume(axes, square)
    if count > MOST_ROWS:
        raise RefusalError(
            f"{count:.3g} waves of {axes} axes are within reach; method harmonics takes {MOST_ROWS}: a "
            "larger sigma or a smaller edge needs fewer, and theta or strips need none"
        )
    index, squares = np.zeros((1, 0), np.int64), np.zeros(1, np.int64)
    waves = np.arange(2 * math.isqrt(square) + 1)
    for _ in range(axes):
        every = squares[:, None] + ((waves + 1) // 2) ** 2
        i, wave = np.nonzero(every <= square)
        index, squares = np.column_stack([index[i], wave]), every[i, wave]
    order = np.argsort(squares, kind="stable")
    index, squares = index[order], squares[order]
    pad = -len(index) % tile
    index = np.concatenate([index, np.zeros((pad, index.shape[1]), np.int64)])
    return AxisGroup(first, index.astype(np.uint32), np.concatenate([squares, np.full(pad, PADDING)]))


@dataclass(frozen=True)
class WaveTables:
    """All frequencies of a ball.

    Attributes
    ----------
    square : int
        Largest |f|^2.
    leading, trailing : Group
        Their rows multiplied give the waves.
    tiles : (count, 2) uint32
        First row of each tile that has a weight.
    """

    square: int
    leading: AxisGroup
    trailing: AxisGroup
    tiles: NDArray[np.uint32]

    @property
    def products(self) -> int:
        """Pairs of rows multiplied, those beyond the ball among them."""
        return len(self.tiles) * TILE[0] * TILE[1]

    def weights(self, b: float) -> FloatArray:
        """W = exp(-b (|f|^2 - 1)) times 2 for each axis with f_a != 0, 0 at f = 0: (rows, rows) float64."""
        square = self.leading.square[:, None] + self.trailing.square
        axes = np.count_nonzero(self.leading.index, axis=1)[:, None] + np.count_nonzero(
            self.trailing.index, axis=1
        )
        inside = (square > 0) & (square <= self.square)
        return np.where(inside, np.exp2(axes) * np.exp(-b * (np.where(inside, square, 1) - 1.0)), 0.0)

    def column_ends(self, side: int) -> NDArray[np.uint32]:
        """Columns beyond which a tile of rows of the leading (0) or trailing (1) group has no weight."""
        rows = (self.leading, self.trailing)[side].rows // TILE[side]
        tile, end = self.tiles[:, side] // TILE[side], self.tiles[:, 1 - side] + TILE[1 - side]
        out = np.zeros(rows, np.uint32)
        np.maximum.at(out, tile, end)
        return out


def ball_waves(d: int, square: int) -> WaveTables:
    """Build the tables for the frequencies with 0 < |f|^2 <= square.

    Parameters
    ----------
    d : int
        Dimension.
    square : int
        Largest |f|^2.

    Returns
    -------
    WaveTables
    """
    lead = (d + 1) // 2
    leading = axis_group(0, lead, square, TILE[0])
    # The one-dimensional case has the wave 1 of its own axis for a trailing row.
    trailing = axis_group(lead, d - lead, square, TILE[1]) if d > 1 else axis_group(0, 1, 0, TILE[1])
    least = leading.square[:: TILE[0], None] + trailing.square[:: TILE[1]]
    tiles = np.argwhere(least <= square) * np.array(TILE)
    return WaveTables(square, leading, trailing, tiles.astype(np.uint32))
