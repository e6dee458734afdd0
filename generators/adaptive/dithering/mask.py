"""Ordered dithering with a void-and-cluster mask (Ulichney 1993)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.dithering.pixel_density import (
    centres,
    dithering_refusal,
    parts_for_dithering,
)
from gbnbench.generators.adaptive.method import AdaptiveMethod
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.kernel_based.dither_mask import mask_ranks
from gbnbench.generators.kernel_based.raster_kernel import gaussian
from gbnbench.generators.ranges import check_above, check_range


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
        shape = (self.side, self.side)
        ranks = mask_ranks(shape, gaussian(shape, self.sigma), rng)
        laid = np.tile(ranks, [-(-size // self.side) for size in wanted.shape])
        threshold = (laid[: wanted.shape[0], : wanted.shape[1]] + 0.5) / ranks.size
        ratio = (wanted / threshold).ravel()
        black = np.zeros(wanted.size, bool)
        black[np.argsort(-ratio, kind="stable")[:n]] = True
        return centres(black.reshape(wanted.shape), parts)
