"""Weighted sample elimination: the most crowded of many random points are removed (Yuksel 2015)."""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray, displacement
from gbnbench.generators.direct.poisson_disk import ball_volume
from gbnbench.generators.direct.toroidal_tree import toroidal_tree
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_above, check_range, too_many
from gbnbench.generators.set_by_set import SetBySet, Told

MOST_PAIRS = 10_000_000  # of points within reach of each other: a minute and 3 GB
TOLD = 64  # points removed after which progress is told
WEIGHTS = 0.4  # of the time is spent on them
FEWEST = 3  # a progressive order is sought down to as many points


def largest_radius(n: int, d: int) -> float:
    """Yuksel's r_max: half the distance of n points as dense as can be.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    float
        In box sides: of the densest packing for d <= 3, beyond of balls that fill space, as in the paper.
    """
    coverage = {1: 1.0, 2: math.pi / math.sqrt(12), 3: math.pi / math.sqrt(18)}.get(d, 1.0)
    return float((coverage / (n * ball_volume(d))) ** (1 / d))


@dataclass(frozen=True)
class SampleElimination(SetBySet):
    """The n points that are left of random ones, the one with the nearest neighbours removed at each step.

    Parameters
    ----------
    inputs : float
        Random points for each point wanted, above 1, at most 1000.
    alpha : float
        Exponent of the weights, above 0, at most 1000.
    beta, gamma : float
        Limit of the weights: distances below 2 r_max (1 - (n/m)**gamma) beta count as that much; beta in
        [0, 1], 0 for no limit, gamma above 0, at most 1000.
    progressive : bool
        Order the points such that the first half of them is what elimination leaves of all, the first quarter
        what it leaves of these, and so on.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The weight of a point is the sum over the others within 2 r_max of (1 - distance / (2 r_max))**alpha; the
    heaviest goes, and its neighbours lose their share of it. Weights only fall, so that a heap whose entries
    are renewed when they come to the top gives the very same order as one kept up to date.

    References
    ----------
    Yuksel, "Sample elimination for generating Poisson disk sample sets", CGF 34(2), 2015.

    Examples
    --------
    >>> SampleElimination()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "elimination"
    summary: ClassVar[str] = "weighted sample elimination on the torus (Yuksel 2015)"
    family: ClassVar[Family] = "direct"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Yuksel, Sample elimination for generating Poisson disk sample sets, 2015"
    inputs: float = 5.0
    alpha: float = 8.0
    beta: float = 0.65
    gamma: float = 1.5
    progressive: bool = False

    def __post_init__(self) -> None:
        for name, above in (("inputs", 1), ("alpha", 0), ("gamma", 0)):
            check_above(name, getattr(self, name), above, 1000)
        check_range("beta", self.beta, 0, 1)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n or d is too large: too many pairs of the random points are within reach of each other.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        what = f"for sample elimination of {self.inputs:g} random points a point in d={d}"
        return too_many(n, self._most_points(d), what)

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        start = rng.random((math.ceil(self.inputs * n), d))
        kept, _ = self.eliminate(start, n, told)
        x: FloatArray = start[kept]
        if not self.progressive:
            return x
        order: list[NDArray[np.intp]] = []
        left = np.arange(n)
        while len(left) > FEWEST:
            kept, removed = self.eliminate(x[left], len(left) // 2)
            order.append(left[removed[::-1]])
            left = left[kept]
        return np.asarray(x[np.concatenate([left, *order[::-1]])])

    def eliminate(
        self, x: FloatArray, n: int, told: Told | None = None
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Remove the heaviest of the points, again and again.

        Parameters
        ----------
        x : (m, d) float64
            Points on the torus.
        n : int
            Points to leave.
        told : callable, optional
            Takes the share of the work that is done.

        Returns
        -------
        kept : (n,) intp
            Their indices, ascending.
        removed : (m - n,) intp
            The others, in the order of their removal.
        """
        m, d = x.shape
        radius = largest_radius(n, d)
        least = radius * (1 - (n / m) ** self.gamma) * self.beta
        neighbours, shares = self._weights(x, 2 * radius, 2 * least)
        if told is not None:
            told(WEIGHTS)
        weight = [sum(of_point) for of_point in shares]
        heap = [(-w, i) for i, w in enumerate(weight)]
        heapq.heapify(heap)
        stands = [True] * m
        removed: list[int] = []
        while len(removed) < m - n:
            was, i = heap[0]
            if -was != weight[i]:
                heapq.heapreplace(heap, (-weight[i], i))
                continue
            heapq.heappop(heap)
            stands[i] = False
            removed.append(i)
            if told is not None and len(removed) % TOLD == 0:
                told(WEIGHTS + (1 - WEIGHTS) * len(removed) / (m - n))
            for j, share in zip(neighbours[i], shares[i], strict=True):
                weight[j] -= share
        return np.flatnonzero(stands), np.array(removed, dtype=np.intp)

    def _weights(
        self, x: FloatArray, reach: float, least: float
    ) -> tuple[list[list[int]], list[list[float]]]:
        """Neighbours within reach of each point, and what each adds to its weight."""
        pairs = toroidal_tree(x).query_pairs(reach, output_type="ndarray")
        gap = displacement(x[pairs[:, 0]], x[pairs[:, 1]])
        distance = np.sqrt(np.einsum("ka,ka->k", gap, gap))
        share = np.maximum(1 - np.maximum(distance, least) / reach, 0) ** self.alpha
        first, second = np.concatenate([pairs, pairs[:, ::-1]]).T
        order = np.lexsort((second, first))
        ends = np.cumsum(np.bincount(first, minlength=len(x))).tolist()
        starts = [0, *ends[:-1]]
        owner, value = second[order].tolist(), np.concatenate([share, share])[order].tolist()
        spans = list(zip(starts, ends, strict=True))
        return [owner[a:b] for a, b in spans], [value[a:b] for a, b in spans]

    def _most_points(self, d: int) -> int:
        """Largest n whose random points have no more than so many pairs within reach."""
        near = self.inputs * (1 if d > 3 else largest_radius(1, d) ** d * ball_volume(d)) * 2.0 ** min(d, 60)
        return int(max(MOST_PAIRS / (self.inputs * near / 2), math.sqrt(2 * MOST_PAIRS) / self.inputs))
