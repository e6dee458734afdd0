"""Ordered dithering with a void-and-cluster mask (Ulichney 1993)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.dithering.pixel_density import (
    centres,
    dithering_refusal,
    parts_for_dithering,
)
from gbnbench.generators.adaptive.method import AdaptiveMethod
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.kernel_based.void_and_cluster import initial_binary_pattern
from gbnbench.generators.ranges import check_above, check_range

INITIAL = 0.1  # share of ones in the initial binary pattern


@dataclass(frozen=True)
class VoidAndClusterDither(AdaptiveMethod):
    """The pixels whose density lies above the thresholds of a mask that is laid side by side.

    Parameters
    ----------
    side : int
        Pixels of the mask's side, 8 to 256.
    sigma : float
        Width of the mask's Gaussian in pixels, above 0 and at most 20; Ulichney's is 1.5.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    Exactly n pixels turn black: those in which density over threshold is largest.

    References
    ----------
    Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913, 1993.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> VoidAndClusterDither(side=16)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "voidcluster"
    summary: ClassVar[str] = "ordered dithering with a void-and-cluster mask (Ulichney 1993)"
    reference: ClassVar[str] = "Ulichney, The void-and-cluster method for dither array generation, 1993"
    side: int = 64
    sigma: float = 1.5

    def __post_init__(self) -> None:
        check_range("side", self.side, 8, 256, "pixels")
        check_above("sigma", self.sigma, 0, 20, "pixels")

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why a halftone has no n points, as ``AdaptiveMethod.refusal`` does."""
        return dithering_refusal(density, n)

    def one_set(
        self,
        density: Density,
        n: int,
        rng: np.random.Generator,
        told: Told,  # noqa: ARG002
    ) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        parts = parts_for_dithering(density, n)
        wanted = density.finer(parts).values
        ranks = mask_ranks(self.side, self.sigma, rng)
        laid = np.tile(ranks, [-(-size // self.side) for size in wanted.shape])
        threshold = (laid[: wanted.shape[0], : wanted.shape[1]] + 0.5) / ranks.size
        ratio = (wanted / threshold).ravel()
        black = np.zeros(wanted.size, bool)
        black[np.argsort(-ratio, kind="stable")[:n]] = True
        return centres(black.reshape(wanted.shape), parts)


def mask_ranks(side: int, sigma: float, rng: np.random.Generator) -> NDArray[np.int64]:
    """Give the pixels of a toroidal square an order in which the first ones are spread evenly.

    Parameters
    ----------
    side : int
        Pixels.
    sigma : float
        Width of the Gaussian in pixels.
    rng : numpy.random.Generator
        Draws the initial binary pattern.

    Returns
    -------
    (side, side) int64
        A permutation of 0 .. side^2 - 1.
    """
    state = rng.bit_generator.state
    pattern = initial_binary_pattern(side, 2, sigma, INITIAL, rng)
    ranks = np.empty(side**2, np.int64)
    first = pattern.count
    for rank in range(first - 1, -1, -1):
        pixel = pattern.tightest_cluster()
        pattern.remove(pixel)
        ranks[pixel] = rank
    rng.bit_generator.state = state  # the same pattern once more, to be filled
    pattern = initial_binary_pattern(side, 2, sigma, INITIAL, rng)
    for rank in range(first, side**2):
        pixel = pattern.largest_void()
        pattern.add(pixel)
        ranks[pixel] = rank
    return ranks.reshape(side, side)
