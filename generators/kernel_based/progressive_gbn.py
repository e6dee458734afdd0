"""Gaussian Blue Noise whose points come in a progressive order: every prefix is blue noise too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.kernel_based.progressive_order import progressive_order
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_range, too_many
from gbnbench.generators.set_by_set import SetBySet, Told

MOST = 20_000


@dataclass(frozen=True)
class ProgressiveGaussianBlueNoise(SetBySet):
    """A Gaussian Blue Noise set, ordered so that its first m points are spread evenly for every m.

    Parameters
    ----------
    sigma : float
        Of the set's energy, as for ``gbn``.
    gradients : int
        Of the set's optimiser, as for ``gbn``.
    prefix_sigma : float
        Width of the Gaussian on the points of a prefix, in its spacings, 0.2 to 2.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The set is that of ``gbn`` of the same seed; ``gbnbench.generators.kernel_based.progressive_order`` orders
    it. In 2D the noise floor of a prefix is some 5e-3 at half, a quarter, an eighth of the points, and
    at most 2e-2 between; half of a set in random order has 0.5.

    References
    ----------
    Ahmed, Ren & Wonka, "Gaussian Blue Noise", ACM Trans. Graphics 41(6), 2022; the ranks are those of
    Ulichney, "The void-and-cluster method for dither array generation", 1993.

    Examples
    --------
    >>> ProgressiveGaussianBlueNoise(gradients=5)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "progressivegbn"
    summary: ClassVar[str] = "Gaussian Blue Noise in an order of which every prefix is blue noise"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Ahmed, Ren & Wonka, Gaussian Blue Noise, 2022; Ulichney, 1993"
    sigma: float = 1.0
    gradients: int = 320
    prefix_sigma: float = 1.0

    def __post_init__(self) -> None:
        check_range("prefix_sigma", self.prefix_sigma, 0.2, 2, "spacings")
        self._unordered()  # refuses settings that are wrong

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the set cannot be had or ordered.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason.
        """
        return self._unordered().refusal(n, d) or too_many(n, MOST, "to be ordered, in n**2")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        monitor = Monitor(lambda done, most, _: told(done / most / 2))
        x = self._unordered().draw(n, d, [rng], monitor)[0]
        return np.ascontiguousarray(
            x[progressive_order(x, self.prefix_sigma, lambda share: told((1 + share) / 2))]
        )

    def _unordered(self) -> GaussianBlueNoise:
        return GaussianBlueNoise(sigma=self.sigma, gradients=self.gradients)
