"""Radial power of published sets of blue noise through optimal transport (de Goes et al. 2012)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.torus import FloatArray

FIRST, LAST = 3, 48  # rings of the table: |f| rounds to them
PUBLISHED_POWER = (
    8.37e-6, 2.39e-5, 6.16e-5, 1.26e-4, 2.33e-4, 3.55e-4, 6.41e-4, 9.63e-4, 1.58e-3, 1.94e-3,
    3.01e-3, 5.39e-3, 5.91e-3, 7.95e-3, 1.06e-2, 1.70e-2, 2.06e-2, 2.49e-2, 3.64e-2, 5.23e-2,
    7.46e-2, 0.105, 0.162, 0.266, 0.481, 0.675, 0.994, 1.46, 1.85, 2.44,
    2.59, 2.85, 2.65, 2.52, 2.09, 1.64, 1.31, 1.07, 0.771, 0.642,
    0.560, 0.529, 0.490, 0.441, 0.424, 0.426,
)  # fmt: skip
"""Mean of the four sets of 1,024 points in ``tests/data/bnot-1024``, data of the deepsampling project."""


def ring_power(x: FloatArray) -> FloatArray:
    """Mean power of a set in the plane over the frequencies whose |f| rounds to 3, 4, ..., 48.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the torus.

    Returns
    -------
    (46,) float64
    """
    f = np.arange(-LAST, LAST + 1)
    ring = np.rint(np.hypot(f[:, None], f)).astype(np.int64).ravel()
    total = np.bincount(ring, periodogram(x, LAST).power.ravel())
    mean: FloatArray = (total / np.bincount(ring))[FIRST : LAST + 1]
    return mean


@dataclass(frozen=True)
class PowerOverPublished:
    """Mean over the named rings of a set's power over that of the published sets.

    Attributes
    ----------
    first, last : int
        The rings, both counted.
    """

    first: int
    last: int

    @property
    def __name__(self) -> str:
        """What lists of figures call it."""
        return f"power_over_published_from_{self.first}_to_{self.last}"

    def __call__(self, x: FloatArray) -> float:
        """Measure a set of 1,024 points in the plane, (1024, 2)."""
        rings = slice(self.first - FIRST, self.last - FIRST + 1)
        return float(np.mean((ring_power(x) / PUBLISHED_POWER)[rings]))
