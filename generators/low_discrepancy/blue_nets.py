"""BlueNets: (0, m, 2)-nets in base 2 optimised towards blue noise (Ahmed & Wonka 2021)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.low_discrepancy.dyadic_net import (
    GaussianEnergy,
    exchangeable_pairs,
    random_net,
)
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_range, outside_plane
from gbnbench.generators.set_by_set import SetBySet, Told
from gbnbench.generators.strata import placed_in_strata

MOST_BITS = 16
CHANCE = 0.5  # that an exchange which lowers the energy is made


@dataclass(frozen=True)
class BlueNets(SetBySet):
    """A (0, m, 2)-net whose points exchange coordinates as long as that lowers a Gaussian energy.

    Parameters
    ----------
    sigma : float
        Standard deviation of the Gaussian, in spacings, in [0.2, 2]: small ones keep points apart, large ones
        empty the low frequencies.
    iterations : int
        Most rounds through all exchanges, in [0, 1e6]; 0 leaves the random net.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The net is drawn among all by Netshuffle. Two points that share an elementary interval of area 2/n may
    exchange their y and leave a net (``exchangeable_pairs``): m exchanges for each point. Netoptimize makes
    those that lower the sum over pairs of exp(-distance**2 / (2 sigma**2)) on the torus, until none does.
    The paper judges them one by one; here the n/2 exchanges of a level are judged at once, and each that
    lowers the energy is made with chance 1/2, so that neighbours that each would be right alone seldom move
    together.
    Each point ends in a uniform place of its stratum of 1/n by 1/n, which no elementary interval sees.

    References
    ----------
    Ahmed & Wonka, "Optimizing dyadic nets", ACM TOG 40(4), 2021.

    Examples
    --------
    >>> x = BlueNets()(16, 2, np.random.default_rng(0))
    >>> np.sort(np.floor(x * [8, 2]) @ [2, 1]).astype(int).tolist()
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]
    """

    name: ClassVar[str] = "bluenets"
    summary: ClassVar[str] = "(0, m, 2)-nets optimised towards blue noise, n = 2**m (Ahmed & Wonka 2021)"
    family: ClassVar[Family] = "low-discrepancy"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 2)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Ahmed & Wonka, Optimizing dyadic nets, 2021"
    sigma: float = 0.5
    iterations: int = 200

    def __post_init__(self) -> None:
        check_range("sigma", self.sigma, 0.2, 2, "spacings")
        check_range("iterations", self.iterations, 0, 10**6)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why not: d is other than 2, or n no power of two.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        if reason := outside_plane(d, "bluenets are nets in the plane"):
            return reason
        low = 2 ** min(n.bit_length() - 1, MOST_BITS)
        if n == low:
            return None
        nearest = low if n - low <= 2 * low - n or low == 2**MOST_BITS else 2 * low
        return f"n must be 2**m, at most 2**{MOST_BITS}, for bluenets; got n={n}, nearest is {nearest}"

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        m = n.bit_length() - 1
        y = random_net(m, rng)
        if m:
            y = self.optimised(y, rng, told)
        return placed_in_strata(np.stack([np.arange(n), y], axis=1), rng.random((n, d)), n)

    def optimised(
        self, y: NDArray[np.int64], rng: np.random.Generator, told: Told | None = None
    ) -> NDArray[np.int64]:
        """Make exchanges that lower the energy.

        Parameters
        ----------
        y : (2**m,) int64
            A net, stratum of y by that of x, m >= 1.
        rng : Generator
            Of the order of levels and of the coins.
        told : callable, optional
            Takes the share that is done.

        Returns
        -------
        (2**m,) int64
            A net of lower energy.

        Notes
        -----
        An exchange is judged again only if a point within reach has moved since it was, or the coin fell
        against it.
        """
        y, n, m = y.copy(), len(y), len(y).bit_length() - 1
        energy = GaussianEnergy(m, self.sigma)
        moved_at, judged_at = np.zeros(n, dtype=np.int64), np.full(m, -1)
        time = 0
        for done in range(self.iterations):
            if told is not None:
                told(done / self.iterations)
            judged_better = False
            for level in rng.permutation(m):
                time += 1
                pairs = exchangeable_pairs(y, int(level))
                cells = energy.cell(pairs, y[pairs])
                pairs = pairs[(moved_at[cells] >= judged_at[level]).any(axis=1)]
                better = pairs[energy.change(y, pairs) < -1e-12]
                judged_better = judged_better or len(better) > 0
                made = better[rng.random(len(better)) < CHANCE]
                before = energy.cell(made, y[made])
                moved_at[energy.cell(better, y[better])] = time
                y[made] = y[made[:, ::-1]]
                after = energy.cell(made, y[made])
                moved_at[energy.around(np.concatenate([before, after]).reshape(-1))] = time
                judged_at[level] = time
            if not judged_better:
                break
        return y
