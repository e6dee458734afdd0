"""Darts thrown at those parts of the torus that no disc covers yet (Ebeida et al. 2012)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.direct.toroidal_tree import toroidal_tree
from gbnbench.generators.lattices.regular_grid import grid_corners

# Share of space that discs of half the radius cover once no more fit, drawn one after another, d = 1 to 6
# (Rényi 1958; Torquato, Uche & Stillinger 2006).
SATURATION = (0.747598, 0.547, 0.3841, 0.2601, 0.1707, 0.1090)
DARTS_A_CELL = 0.8  # thrown between two divisions of the cells
CELLS_A_POINT = 16  # at the start, at most
MOST_CELLS_A_POINT, MOST_CELLS = 128, 2**17  # cells are halved up to the larger of these numbers
LEVELS = 48  # divisions: cells of 2**-48 of the radius are smaller than what rounding leaves of it


def ball_volume(d: int) -> float:
    """Volume of the unit ball in d dimensions."""
    return float(math.pi ** (d / 2) / math.gamma(d / 2 + 1))


def saturated_radius(n: float, d: int) -> float:
    """Radius at which a saturated set has about n points.

    Parameters
    ----------
    n, d : int
        Points and dimension; for d > 6 the coverage is extrapolated by its ratio from d = 5 to 6.

    Returns
    -------
    float
        In box sides.
    """
    known = len(SATURATION)
    ratio = SATURATION[-1] / SATURATION[-2]
    coverage = SATURATION[d - 1] if d <= known else SATURATION[-1] * ratio ** (d - known)
    return float(2 * (coverage / (n * ball_volume(d))) ** (1 / d))


@dataclass(frozen=True)
class Cells:
    """Equal cubes of the torus, among which is everything that no disc covers.

    Attributes
    ----------
    corners : (k, d) int64
        Lower corners, in cells.
    side : int
        Cells an axis.
    """

    corners: NDArray[np.int64]
    side: int

    @classmethod
    def of_torus(cls, n: int, d: int, radius: float) -> Cells:
        """Cut the whole torus in cells that hold a point each at most, or in 16 n where these are fewer.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        radius : float
            Least distance of points, in box sides.

        Returns
        -------
        Cells
        """
        most = max(1, int(max(CELLS_A_POINT * n, 2) ** (1 / d) + 1e-9))
        side = math.ceil(min(math.sqrt(d) / radius, most))
        return cls(grid_corners(side, d).astype(np.int64), side)

    def split(self) -> Cells:
        """Halve every cell along every axis."""
        halves = grid_corners(2, self.corners.shape[1]).astype(np.int64)
        corners = (2 * self.corners[:, None] + halves).reshape(-1, self.corners.shape[1])
        return Cells(corners, 2 * self.side)

    def uncovered(self, x: FloatArray, radius: float) -> Cells:
        """Leave out the cells that lie in the disc round the point nearest to their centre.

        Parameters
        ----------
        x : (n, d) float64
            Points.
        radius : float
            Of the discs, in box sides.

        Returns
        -------
        Cells
        """
        d = self.corners.shape[1]
        if not len(x) or self.too_large(radius):
            return self
        near = radius + 0.5 * math.sqrt(d) / self.side
        centres = (self.corners + 0.5) / self.side
        distance, owner = toroidal_tree(x).query(centres, distance_upper_bound=near)
        keep = np.isinf(np.asarray(distance))
        tested = np.flatnonzero(~keep)
        offset = np.abs(centres[tested] - x[np.asarray(owner)[tested]])
        farthest = np.minimum(offset, 1 - offset) + 0.5 / self.side
        keep[tested] = np.einsum("ka,ka->k", farthest, farthest) > radius * radius
        return Cells(self.corners[keep], self.side)

    def too_large(self, radius: float) -> bool:
        """Whether no disc of a radius, in box sides, can hold a whole cell."""
        return 0.5 * math.sqrt(self.corners.shape[1]) / self.side > radius

    def throw(self, darts: int, rng: np.random.Generator) -> FloatArray:
        """Throw darts uniformly at the cells.

        Parameters
        ----------
        darts : int
            Their number.
        rng : Generator
            Of the darts.

        Returns
        -------
        (darts, d) float64
        """
        hit = self.corners[rng.integers(len(self.corners), size=darts)]
        thrown: FloatArray = (hit + rng.random(hit.shape)) / self.side
        return np.minimum(thrown, 1 - 2.0**-53)


def in_turn(darts: FloatArray, x: FloatArray, radius: float) -> FloatArray:
    """Return the darts that find no point and no earlier dart within the radius, as if thrown in turn.

    Parameters
    ----------
    darts : (k, d) float64
        In the order of their throw.
    x : (n, d) float64
        Points there are.
    radius : float
        Least distance, in box sides.

    Returns
    -------
    (accepted, d) float64
        In order.
    """
    if len(x):
        distance, _ = toroidal_tree(x).query(darts, distance_upper_bound=radius)
        darts = darts[np.isinf(distance)]
    if len(darts) < 2:
        return darts
    pairs = toroidal_tree(darts).query_pairs(radius, output_type="ndarray")
    stands = [True] * len(darts)
    for first, second in pairs[np.argsort(pairs[:, 0], kind="stable")].tolist():
        if stands[first]:
            stands[second] = False
    return np.asarray(darts[np.array(stands)])


def throw_darts(
    x: FloatArray,
    radius: float,
    most: int,
    rng: np.random.Generator,
    cells: Cells | None = None,
    darts_a_point: float = math.inf,
    told: Callable[[float], None] | None = None,
) -> tuple[FloatArray, bool]:
    """Throw darts until there are so many points, or no room for another.

    Parameters
    ----------
    x : (k, d) float64
        Points to begin with, the radius apart.
    radius : float
        Least distance, in box sides.
    most : int
        Stop at so many points.
    rng : Generator
        Of the darts.
    cells : Cells, optional
        Where there may be room; by default everywhere.
    darts_a_point : float
        Stop after so many darts for each of ``most`` points, where cells are too many to be divided.
    told : callable, optional
        Takes the share of ``most`` points that there are, after each round.

    Returns
    -------
    x : (m, d) float64
        The points given and those added, in the order of their throw, m <= most.
    saturated : bool
        Whether no point of the torus is farther than the radius from all of them.

    Notes
    -----
    A dart in a cell that a disc covers would be refused: leaving these cells out changes the time alone.
    """
    d = x.shape[1]
    cells = Cells.of_torus(most, d, radius) if cells is None else cells
    thrown, levels = 0, 0
    while len(x) < most and thrown < darts_a_point * most and levels < LEVELS:
        cells = cells.uncovered(x, radius)
        if not len(cells.corners):
            return x, True
        count = max(most if cells.too_large(radius) else 16, int(DARTS_A_CELL * len(cells.corners)))
        stood = in_turn(cells.throw(count, rng), x, radius)
        x = np.concatenate([x, stood])[:most]
        if told is not None:
            told(len(x) / most)
        few = len(cells.corners) * 2**d <= max(MOST_CELLS_A_POINT * most, MOST_CELLS)
        if few or (
            not len(stood) and darts_a_point == math.inf
        ):  # where no dart stands, cells must be smaller
            cells, levels = cells.split(), levels + 1
        thrown += count
    return x, levels == LEVELS
