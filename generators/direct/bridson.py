"""Poisson-disk sampling by a front of active points (Bridson 2007), on the torus in any dimension."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.direct.poisson_disk import ball_volume, saturated_radius
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_range, too_many, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told

# First radius over that of a saturated set, d = 1 to 6: with 30 candidates it gives .98 n, as was measured.
START = (0.92, 0.95, 0.93, 0.905, 0.9, 0.893)
LARGER, SMALLER = 1.01, 0.99  # the radius after a front that did not close, and after one that closed early
LEAST_SHARE = 0.96  # of n, in a front that is gone on from
RESTARTS = 20
TOLD = 16  # points after which progress is told
LEAST_RADIUS = 0.5  # of the first: a front that closes early there does so at any radius
MOST_POINTS = 100_000
MOST_CANDIDATES = 10_000
MOST_DISTANCES = 3e9  # of trials to points near by, for each axis: two minutes
MOST_DIMENSIONS = 100


@dataclass(frozen=True)
class Bridson(SetBySet):
    """Points that spread from the first: each is tried at one to two radii from an active point.

    Parameters
    ----------
    candidates : int
        Most trials round an active point (Bridson's k), in [1, 10000]; when all fail it is active no more.

    Raises
    ------
    InputError
        If it is out of range.

    Notes
    -----
    Candidates are uniform in the shell between one and two radii, the active point is drawn at random.

    The method takes a radius and gives as many points as come; n is met thus: the radius is searched at which
    a front closes with 96 to 100 % of n, for a front that is stopped at n leaves a part of the torus empty.
    Then all points become active again at a radius a hundredth smaller (as McCool & Fiume 1992 relax theirs),
    until the n-th point stands. The last few are so a little nearer to others than the first.

    With few candidates, one in 2D or a dozen in 1D, a front mostly dies out before it has filled the torus,
    whatever the radius. Then there is no set, and a RefusalError asks for more of them.

    References
    ----------
    Bridson, "Fast Poisson disk sampling in arbitrary dimensions", SIGGRAPH sketches, 2007.

    Examples
    --------
    >>> Bridson()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "bridson"
    summary: ClassVar[str] = "Poisson-disk sampling by a front of active points, toroidal (Bridson 2007)"
    family: ClassVar[Family] = "direct"
    dimensions: ClassVar[tuple[int, int | None]] = (1, MOST_DIMENSIONS)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Bridson, Fast Poisson disk sampling in arbitrary dimensions, 2007"
    candidates: int = 30

    def __post_init__(self) -> None:
        check_range("candidates", self.candidates, 1, MOST_CANDIDATES)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n or d is too large: every trial is held against all points near by.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        if reason := too_many_axes(d, MOST_DIMENSIONS, "for Bridson's method"):
            return reason
        near = 6.0**d * ball_volume(d) * (saturated_radius(1, d) / 2) ** d  # points within three radii
        tried = MOST_DISTANCES / (self.candidates * d)
        most = int(min(MOST_POINTS, max(math.sqrt(tried), tried / near)))
        return too_many(n, most, f"for Bridson's method with {self.candidates} candidates in d={d}")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        radius = START[min(d, len(START)) - 1] * saturated_radius(n, d)
        least = LEAST_RADIUS * radius
        for _ in range(RESTARTS):
            front = Front(n, rng.random(d), rng)
            front.spread(radius, self.candidates, told)
            if front.count == n and front.active:
                radius *= LARGER
            elif front.count < LEAST_SHARE * n - 1:
                radius *= (front.count / n) ** (1 / d)
            else:
                break
            if radius < least:
                raise RefusalError(
                    f"a front with candidates={self.candidates} dies out before it has filled the torus in "
                    f"d={d}; take more candidates"
                )
        while front.count < n:  # ends: any n points fit at some radius
            radius *= SMALLER
            front.active = list(range(front.count))
            front.spread(radius, self.candidates, told)
        return front.x


class Front:
    """The points so far and those that are still active.

    Parameters
    ----------
    n : int
        Points wanted.
    first : (d,) float64
        The first of them.
    rng : Generator
        Of the trials.
    """

    def __init__(self, n: int, first: FloatArray, rng: np.random.Generator) -> None:
        self.rng = rng
        self.x = np.empty((n, len(first)))
        self.x[0] = first
        self.count = 1
        self.active = [0]

    def spread(self, radius: float, candidates: int, told: Told) -> None:
        """Try points round active ones until there are n or none is active.

        Parameters
        ----------
        radius : float
            Least distance, in box sides.
        candidates : int
            Trials round an active point.
        told : callable
            Takes the share of the points that are there.
        """
        n, d = self.x.shape
        rng, active = self.rng, self.active
        while active and self.count < n:
            if self.count % TOLD == 0:
                told(self.count / n)
            place = int(rng.integers(len(active)))
            point = active[place]
            trials = self._shell(candidates, d, radius)
            offset = self.x[: self.count] - self.x[point]
            offset -= np.rint(offset)
            near = offset[np.einsum("ia,ia->i", offset, offset) < (3 * radius) ** 2]
            gaps = trials[:, None] - near
            gaps -= np.rint(gaps)
            free = np.einsum("tia,tia->ti", gaps, gaps).min(axis=1) >= radius * radius
            if free.any():
                self.x[self.count] = wrap(self.x[point] + trials[int(np.argmax(free))])
                active.append(self.count)
                self.count += 1
            else:
                active[place] = active[-1]
                active.pop()

    def _shell(self, count: int, d: int, radius: float) -> FloatArray:
        """Draw offsets uniformly between one and two radii, (count, d)."""
        way = self.rng.standard_normal((count, d))
        length = (1 + (2.0**d - 1) * self.rng.random(count)) ** (1 / d)
        shell: FloatArray = way * (radius * length / np.linalg.norm(way, axis=1))[:, None]
        return shell
