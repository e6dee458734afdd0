"""Best-candidate sampling: each point is the farthest from the others of many random ones (Mitchell 1991)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.direct.toroidal_tree import toroidal_tree
from gbnbench.generators.lattices.regular_grid import grid_corners
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_range, too_many
from gbnbench.generators.set_by_set import SetBySet, Told

TOLD = 16  # points after which progress is told
PLAIN = 64  # points drawn from all their candidates, before cells pay
CELLS_A_POINT = 64
LOWER = 0.9  # the aim, when no candidate was as far
WATCH = 0.85  # of the aim: cells whose bound is above are looked through at every step
MOST_POINTS, MOST_POINTS_ALL_DRAWN = 65_536, 4096  # at one candidate a point: a minute or two
MOST_CANDIDATES = 1000
MOST_CELL_DIMENSIONS = 4


@dataclass(frozen=True)
class BestCandidate(SetBySet):
    """A sequence of points, each the best of candidates whose number grows with the points there are.

    Parameters
    ----------
    candidates : int
        Candidates for each point there is already (Mitchell's m), in [1, 1000].

    Raises
    ------
    InputError
        If it is out of range.

    Notes
    -----
    The k-th point is that of (k - 1) m uniform ones whose nearest neighbour on the torus is farthest. Any
    prefix is such a set.

    All candidates are counted, but not all drawn. The torus is cut in cells, each with an upper bound of the
    distance from its places to the nearest point. How many candidates fall on cells whose bound is above an
    aim is a binomial number; these are drawn there, and if one is farther than the aim, none of the others
    can be the best. Otherwise the aim is lowered, and those of the next cells are drawn. So the sets are
    distributed as Mitchell's at a few candidates in a hundred. From 5D on, where cells do not pay, every
    candidate is drawn.

    References
    ----------
    Mitchell, "Spectrally optimal sampling for distribution ray tracing", SIGGRAPH 1991.

    Examples
    --------
    >>> BestCandidate()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "bestcandidate"
    summary: ClassVar[str] = "best-candidate sampling on the torus, progressive (Mitchell 1991)"
    family: ClassVar[Family] = "direct"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Mitchell, Spectrally optimal sampling for distribution ray tracing, 1991"
    candidates: int = 1

    def __post_init__(self) -> None:
        check_range("candidates", self.candidates, 1, MOST_CANDIDATES)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n is too large: candidates grow as its square.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        most = MOST_POINTS if d <= MOST_CELL_DIMENSIONS else MOST_POINTS_ALL_DRAWN / math.sqrt(d / 5)
        most = max(1, int(most / math.sqrt(self.candidates)))
        return too_many(n, most, f"for best candidates, {self.candidates} a point, in d={d}")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        x = np.empty((n, d))
        x[0] = rng.random(d)
        points = Nearest(x)
        bounds: Bounds | None = None
        for k in range(1, n):
            if k % TOLD == 0:
                told(k / n)
            points.count = k
            if k >= PLAIN and d <= MOST_CELL_DIMENSIONS:
                if bounds is None or CELLS_A_POINT * k > 4 * len(bounds.high):
                    bounds = Bounds(points)
                x[k] = bounds.best(self.candidates * k, rng)
                bounds.lower(x[k])
            else:
                candidates = rng.random((self.candidates * k, d))
                x[k] = candidates[np.argmax(points.distances(candidates))]
        return x


class Nearest:
    """Distances to the first points of an array, most of which are in a tree.

    Parameters
    ----------
    x : (n, d) float64
        Points, of which the first ``count`` are there.
    """

    def __init__(self, x: FloatArray) -> None:
        self.x = x
        self.count = 1
        self._in_tree = 0

    def distances(self, y: FloatArray) -> FloatArray:
        """Distance on the torus from each place to the nearest point.

        Parameters
        ----------
        y : (k, d) float64
            Places.

        Returns
        -------
        (k,) float64
        """
        if self.count - self._in_tree > 16 + self._in_tree // 256:
            self._tree = toroidal_tree(self.x[: self.count])
            self._in_tree = self.count
        found: FloatArray = np.full(len(y), np.inf)
        if self._in_tree:
            found = np.asarray(self._tree.query(y)[0])
        late = self.x[self._in_tree : self.count]
        if len(late):
            square = _squared_gaps(y.T[:, :, None], late.T[:, None])
            found = np.minimum(found, np.sqrt(square.min(axis=1)))
        return np.asarray(found)


class Bounds:
    """Upper bounds, cell by cell, of the distance to the nearest point.

    Parameters
    ----------
    points : Nearest
        The points there are.
    """

    def __init__(self, points: Nearest) -> None:
        d = points.x.shape[1]
        self.points = points
        self.side = math.ceil((CELLS_A_POINT * points.count) ** (1 / d))
        self.corners = grid_corners(self.side, d)
        self.half = 0.5 * math.sqrt(d) / self.side
        self.high = points.distances((self.corners + 0.5) / self.side) + self.half
        self.last = float(self.high.max())
        self.watched_aim = math.inf
        reach = min(math.ceil(float(self.high.max()) * self.side) + 1, (self.side - 1) // 2)
        self.stencil = np.arange(-reach, reach + 1)
        self.across = np.eye(d, dtype=np.int64) * (len(self.stencil) - 1) + 1  # shapes of the axes of a block

    def best(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Draw the best of so many uniform candidates.

        Parameters
        ----------
        count : int
            Candidates.
        rng : Generator
            Of the draw.

        Returns
        -------
        (d,) float64
        """
        # bounds never rise: all above an aim are among those watched as long as these have a lower one
        aim = (1 - 2 / math.sqrt(self.points.count)) * self.last
        if aim < self.watched_aim:
            self.watched_aim = WATCH * aim
            self.watched = np.flatnonzero(self.high > self.watched_aim)
        best, farthest = self.corners[0], -1.0
        above, left = math.inf, len(self.high)
        while count and farthest <= above:
            cells = self.watched if aim >= self.watched_aim else np.arange(len(self.high))
            bound = self.high[cells]
            here = cells[bound > aim if above == math.inf else (bound > aim) & (bound <= above)]
            inside = int(rng.binomial(count, len(here) / left)) if len(here) < left else count
            if inside:
                candidates = self._draw(here, inside, rng)
                distance = self.points.distances(candidates)
                first = int(np.argmax(distance))
                if distance[first] > farthest:
                    best, farthest = candidates[first], float(distance[first])
            count, left = count - inside, left - len(here)
            aim, above = LOWER * aim if aim > self.half else -1.0, aim
        self.last = farthest
        return np.asarray(best)

    def lower(self, point: FloatArray) -> None:
        """Lower the bounds round a new point.

        Parameters
        ----------
        point : (d,) float64
            The point.
        """
        flat: NDArray[np.int64] = np.zeros(1, np.int64)
        middles = []
        for place, shape in zip(point, self.across, strict=True):
            cells = (int(place * self.side) + self.stencil) % self.side
            middles.append(((cells + 0.5) / self.side).reshape(shape))
            flat = flat * self.side + cells.reshape(shape)
        square = _squared_gaps(middles, point)
        self.high[flat] = np.minimum(self.high[flat], np.sqrt(square) + self.half)

    def _draw(self, cells: NDArray[np.intp], count: int, rng: np.random.Generator) -> FloatArray:
        """Draw uniform points of some cells."""
        d = self.corners.shape[1]
        chosen = self.corners[cells[rng.integers(len(cells), size=count)]]
        return np.asarray(np.minimum((chosen + rng.random((count, d))) / self.side, 1 - 2.0**-53))


def _squared_gaps(a: Iterable[FloatArray], b: Iterable[FloatArray]) -> FloatArray:
    """Squared distances on the torus of places whose coordinates come one axis after the other."""
    total: FloatArray = np.zeros(())
    for of_a, of_b in zip(a, b, strict=True):
        gap = of_a - of_b
        gap -= np.rint(gap)
        total = total + gap * gap
    return total
