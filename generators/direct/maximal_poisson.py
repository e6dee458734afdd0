"""Maximal Poisson-disk sets: no two points within a radius, no place farther away (Ebeida et al. 2012)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.direct.poisson_disk import (
    MOST_CELLS_A_POINT,
    Cells,
    saturated_radius,
    throw_darts,
)
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import too_many, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told

MOST_DIMENSIONS = 4
MOST_POINTS_4D = 2048
DRAWS = 100  # saturated sets to begin with, at most
HALVINGS = 50  # of the interval of the radius
GIVES_WAY = (0.01, 0.03, 0.1, 0.3)  # by how much of it the radius is lowered, one after another
CELL_SHARE = 1 / 16  # of the radius: cells that are searched again at every radius


@dataclass(frozen=True)
class MaximalPoisson(SetBySet):
    """Saturated dart throwing: the discs of one radius leave no point of the torus uncovered.

    Notes
    -----
    Darts are thrown at the cells that no single disc covers, and the cells halved, until none is left
    (Ebeida et al. 2012): the points are drawn as by dart throwing without end, and the set is maximal.

    How many points a radius gives is a matter of chance (at n = 1024 in 2D they spread by 7). So n is met
    by relaxing the radius: a saturated set with a few points less is drawn, then the radius lowered, by
    bisection, until saturating the set again adds just those that lack. In 2D at n = 1024 it gives way by
    some half a per cent. The radius itself is not returned: it is the least distance of the set but for
    what the bisection leaves, and no empty circle is larger.

    References
    ----------
    Ebeida, Mitchell, Patney, Davidson & Owens, "A simple algorithm for maximal Poisson-disk sampling in high
    dimensions", CGF 31(2), 2012. Gamito & Maddock, "Accurate multidimensional Poisson-disk sampling", ACM
    TOG 29(1), 2009.

    Examples
    --------
    >>> MaximalPoisson()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "maximalpoisson"
    summary: ClassVar[str] = "maximal Poisson-disk set on the torus, d <= 4 (Ebeida et al. 2012)"
    family: ClassVar[Family] = "direct"
    dimensions: ClassVar[tuple[int, int | None]] = (1, MOST_DIMENSIONS)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Ebeida, Mitchell, Patney, Davidson & Owens, 2012"

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the voids of n discs in d dimensions are too many cells.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        if reason := too_many_axes(d, MOST_DIMENSIONS, "for a maximal Poisson-disk set"):
            return reason
        most = MOST_POINTS_4D if d == MOST_DIMENSIONS else n
        return too_many(n, most, "for a maximal Poisson-disk set in 4D")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        if n == 1:
            return rng.random((1, d))
        for _ in range(DRAWS):
            found = self.saturated_set(n, d, rng, told)
            if found is not None:
                return found[0]
        raise RefusalError(
            f"none of {DRAWS} maximal Poisson-disk sets came to n={n} points in d={d}; try another seed or n"
        )

    def saturated_set(
        self, n: int, d: int, rng: np.random.Generator, told: Told | None = None
    ) -> tuple[FloatArray, float] | None:
        """Draw a maximal set of n points and its radius, or fail.

        Parameters
        ----------
        n, d : int
            Points, >= 2, and dimension.
        rng : Generator
            The stream.
        told : callable, optional
            Takes the share of the set that is done.

        Returns
        -------
        x : (n, d) float64
            The points.
        radius : float
            At most their least distance, at least that of any place to the nearest of them; box sides.
            None in the place of both where no radius that was tried gave n.
        """
        few = 1.5 * (0.05 * n) ** 0.5  # one and a half standard deviations of the number of points
        high = saturated_radius(max(n - few, 1), d)
        x, _ = throw_darts(np.empty((0, d)), high, n + 1, rng, told=told)
        if len(x) == n:
            return x, high
        if len(x) > n:
            return None
        seed = int(rng.integers(2**63))
        for share in GIVES_WAY:
            low = (1 - share) * high
            cells = self._open_cells(x, low, n, d)
            if len(throw_darts(x, low, n + 1, np.random.default_rng(seed), cells)[0]) > n:
                break
        for _ in range(HALVINGS):
            radius = (low + high) / 2
            more, _ = throw_darts(x, radius, n + 1, np.random.default_rng(seed), cells)
            if len(more) == n:
                return more, radius
            low, high = (radius, high) if len(more) > n else (low, radius)
        return None

    def _open_cells(self, x: FloatArray, radius: float, n: int, d: int) -> Cells:
        """Cells that no disc of this radius covers, so none of a larger one."""
        cells = Cells.of_torus(n, d, radius).uncovered(x, radius)
        while 1 / cells.side > CELL_SHARE * radius and len(cells.corners) * 2**d < MOST_CELLS_A_POINT * n:
            cells = cells.split().uncovered(x, radius)
        return cells
