"""Independent points in proportion to a density: the reference that has no structure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.method import AdaptiveMethod
from gbnbench.generators.adaptive.protocol import Told


@dataclass(frozen=True)
class Rejection(AdaptiveMethod):
    """Independent points, each in a pixel drawn in proportion to its density and uniform within it.

    Notes
    -----
    The distribution is that of throwing points anywhere and rejecting them with the complement of the
    density, without the throws that are lost.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> x = Rejection()(as_density([[0, 1], [0, 0]]), 5, np.random.default_rng(0))
    >>> np.floor(x).max(axis=0).tolist()
    [0.0, 1.0]
    """

    name: ClassVar[str] = "rejection"
    summary: ClassVar[str] = "independent points in proportion to the density"
    reference: ClassVar[str] = ""

    def one_set(  # told is not: this is done at once
        self,
        density: Density,
        n: int,
        rng: np.random.Generator,
        told: Told,  # noqa: ARG002
    ) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        share = np.cumsum(density.values.ravel())
        last = int(np.flatnonzero(density.values.ravel())[-1])
        pixel = np.minimum(np.searchsorted(share, rng.random(n) * share[-1], side="right"), last)
        corner = np.stack(np.unravel_index(pixel, density.shape), axis=1)
        return corner + rng.random((n, density.d))
