"""Latin hypercubes optimised for distance by exchanges (Morris & Mitchell 1995)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_range, too_many
from gbnbench.generators.set_by_set import SetBySet, Told
from gbnbench.generators.strata import placed_in_strata

PARTNERS = 24  # tried at a step
MOST_POINTS = 8192


@dataclass(frozen=True)
class LatinMaximin(SetBySet):
    """A Latin hypercube in which the most crowded point exchanges a coordinate as long as that helps.

    Parameters
    ----------
    power : int
        p of the criterion phi_p, in [2, 100]; the larger, the more it is the least distance.
    steps : float
        Most exchanges that are sought, for each point, in [0, 1000]; 0 leaves the random hypercube.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    phi_p = (sum over pairs of distance**-p)**(1/p) on the torus is to be low. A step takes the point with the
    largest share of the sum, on a random axis, and 24 random others, and makes the exchange of the two
    coordinates that lowers the sum most, if one does; a point that finds none is left alone for as many steps
    as there are points. Morris & Mitchell exchange random pairs and anneal; choosing the critical point is of
    Joseph & Hung (2008). All points have the same uniform place in their strata, so that distances are those
    of the strata.

    References
    ----------
    Morris & Mitchell, "Exploratory designs for computational experiments", J. Statistical Planning and
    Inference 43(3), 1995. Joseph & Hung, "Orthogonal-maximin Latin hypercube designs", Statistica Sinica 18,
    2008.

    Examples
    --------
    >>> x = LatinMaximin()(5, 2, np.random.default_rng(0))
    >>> np.sort(np.floor(5 * x), axis=0)[:, 1].tolist()
    [0.0, 1.0, 2.0, 3.0, 4.0]
    """

    name: ClassVar[str] = "latinmaximin"
    summary: ClassVar[str] = "Latin hypercube of large toroidal distances (Morris & Mitchell 1995)"
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Morris & Mitchell, 1995; Joseph & Hung, 2008"
    power: int = 16
    steps: float = 2.0

    def __post_init__(self) -> None:
        check_range("power", self.power, 2, 100)
        check_range("steps", self.steps, 0, 1000, "for each point")

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say why n is too large: every exchange is judged by all distances from its two points.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        return too_many(n, MOST_POINTS, "for latinmaximin, which judges each exchange by all distances")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        strata = rng.permuted(np.tile(np.arange(n), (d, 1)), axis=1)
        if d > 1 and n > 2:
            strata = self.optimised(strata, rng, told)
        return placed_in_strata(np.ascontiguousarray(strata.T), rng.random(d), n)

    def optimised(
        self, strata: NDArray[np.int64], rng: np.random.Generator, told: Told | None = None
    ) -> NDArray[np.int64]:
        """Make exchanges that lower phi_p.

        Parameters
        ----------
        strata : (d, n) int64
            A permutation of 0, ..., n - 1 an axis.
        rng : Generator
            Of axes and partners.
        told : callable, optional
            Takes the share that is done.

        Returns
        -------
        (d, n) int64
            A better one.
        """
        d, n = strata.shape
        strata = strata.copy()
        offset = np.arange(n)
        square = np.minimum(offset, n - offset).astype(np.float64) ** 2 / float(n) ** (2 - 2 / d)
        share = np.array([self._shares(strata, square, i).sum() for i in range(n)])
        rests_until = np.zeros(n)
        for step in range(int(self.steps * n)):
            if told is not None and step % n == 0:
                told(step / (self.steps * n))
            i = int(np.argmax(np.where(rests_until <= step, share, 0)))
            axis = int(rng.integers(d))
            partners = rng.integers(n - 1, size=min(PARTNERS, n - 1))
            partners += partners >= i
            values = strata[axis]
            others = np.delete(strata, axis, axis=0)
            rest_i = square[others[:, i, None] - others].sum(axis=0)
            rest_j = square[others[:, partners, None] - others[:, None]].sum(axis=0)
            new_i = self._power(rest_i + square[values[partners, None] - values])
            new_j = self._power(rest_j + square[values[i] - values])
            # the two points keep their distance from each other; every other sum excludes both
            row = np.arange(len(partners))
            new_i[:, i] = new_j[row, partners] = 0
            between = self._power(rest_i[partners] + square[values[i] - values[partners]])
            new_i[row, partners] = new_j[:, i] = between
            gain = share[i] + share[partners] - new_i.sum(axis=1) - new_j.sum(axis=1)
            best = int(np.argmax(gain))
            if gain[best] <= 1e-9 * share[i]:
                rests_until[i] = step + n
                continue
            j = int(partners[best])
            share += (
                new_i[best] + new_j[best] - self._shares(strata, square, i) - self._shares(strata, square, j)
            )
            share[i], share[j] = new_i[best].sum(), new_j[best].sum()
            strata[axis, i], strata[axis, j] = values[j], values[i]
        return strata

    def _power(self, square: FloatArray) -> FloatArray:
        """Raise squared distances to -p/2, infinite for none."""
        with np.errstate(divide="ignore"):
            factor = 1 / square
        exponent = self.power // 2
        result = np.sqrt(factor) if self.power % 2 else None
        while exponent:  # squares of squares, far quicker than a general power
            if exponent % 2:
                result = factor.copy() if result is None else result * factor
            exponent //= 2
            if exponent:
                factor *= factor
        return np.asarray(result)

    def _shares(self, strata: NDArray[np.int64], square: FloatArray, i: int) -> FloatArray:
        """Terms of the sum that a point takes part in, by the other point."""
        shares = self._power(square[strata[:, i, None] - strata].sum(axis=0))
        shares[i] = 0
        return shares
