"""Independent uniform points, the white noise that every other set is measured against."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family


@dataclass(frozen=True)
class Uniform:
    """Independent uniform points.

    Notes
    -----
    E[P(f)] = 1 for every f != 0.

    Examples
    --------
    >>> Uniform()(3, 2, np.random.default_rng(0)).shape
    (3, 2)
    """

    name: ClassVar[str] = "random"
    summary: ClassVar[str] = "independent uniform points: white noise"
    family: ClassVar[Family] = "direct"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = ""

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say that any n and d can be made: there is no refusal.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        None
        """
        return None

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64."""
        return rng.random((n, d))
