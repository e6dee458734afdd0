"""The frequencies of a ball as pairs of rows of two tables of real waves, and their weights."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.frequency_ball import ball_volume

TILE = (4, 3)  # rows of the leading and the trailing table that are multiplied at once
MOST_ROWS = 20_000  # of a table


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
    leading, trailing : AxisGroup
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
