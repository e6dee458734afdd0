"""The frequencies at which sets are measured: a cube or box, or a listed ball, and their exact shells."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.ball_power import half_band
from gbnbench.analysis.spectrum.box_shells import box_shells, harmonics_within, listed_box_shells, pooled
from gbnbench.analysis.spectrum.listed_shells import half_ball
from gbnbench.analysis.spectrum.power_of_each import listed_power_of_each, power_of_each
from gbnbench.analysis.spectrum.shells import Shells, exact_shells, listed_shells, squared_radius
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import Sides, squared_lengths
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class FrequencyRegion:
    """Which frequencies.

    Attributes
    ----------
    shape : {"cube", "ball"}
        All with |f_a| <= reach, or the listed ones of half a ball. For unequal sides the box round the ball
        |k| <= reach, or that ball.
    reach : float
        Largest harmonic of a cube; largest |f|^2 of a ball; largest |k| for unequal sides.
    d : int
        Dimension.
    sides : tuple of d floats or None
        As ``as_sides`` returns them; None for equal ones.
    """

    shape: Literal["cube", "ball"]
    reach: float
    d: int
    sides: Sides | None = None

    @property
    def listed(self) -> bool:
        """Whether the frequencies are listed, and of f and -f only one is there."""
        return self.shape == "ball"

    @cached_property
    def most(self) -> float:
        """Largest |f|^2, or |k|^2 for unequal sides, of which every frequency is there."""
        if self.sides is not None:
            return float(self.reach) ** 2
        # Every |f|^2 up to this has all its frequencies within the cube.
        return self.reach if self.listed else (int(self.reach) + 1) ** 2 - 1

    @cached_property
    def _list(self) -> tuple[NDArray[np.int64], NDArray[np.int64] | FloatArray]:
        if self.sides is not None:
            return half_band((0.0, self.reach), self.sides)
        square, frequencies = half_ball(self.d, int(self.reach))
        return frequencies, square

    @property
    def frequencies(self) -> NDArray[np.int64] | None:
        """The listed frequencies, (m, d); None for a cube."""
        return self._list[0] if self.listed else None

    @cached_property
    def square(self) -> NDArray[np.int64] | FloatArray:
        """|f|^2 or |k|^2 of every frequency, in the order of a set's flattened powers."""
        if self.listed:
            return self._list[1]
        if self.sides is not None:
            return squared_lengths(harmonics_within(self.reach, self.sides), self.sides).ravel()
        return squared_radius(int(self.reach), self.d)

    @cached_property
    def shells(self) -> Shells:
        """Exact shells of these frequencies."""
        if self.sides is None:
            return listed_shells(self._list[1]) if self.listed else exact_shells(int(self.reach), self.d)  # type: ignore[arg-type]
        if self.listed:
            return listed_box_shells(self._list[1])  # type: ignore[arg-type]
        return box_shells(harmonics_within(self.reach, self.sides), self.sides, float(self.reach))

    @cached_property
    def full_shells(self) -> Shells:
        """Shells with frequencies enough for a mean and a spread: pooled ones where sides are unequal."""
        return self.shells if self.sides is None else pooled(self.shells, self.d)

    def powers(self, points: FloatArray) -> tuple[FloatArray, Spectrum]:
        """Evaluate the power of every set.

        Parameters
        ----------
        points : (sets, n, d) float64
            Checked points.

        Returns
        -------
        powers : (sets, ...) float64
            Cubes, or (m,) at listed frequencies.
        spectrum : Spectrum
            Of the first set; its errors hold for each of them.
        """
        if self.listed:
            return listed_power_of_each(points, self._list[0], sides=self.sides)
        if self.sides is None:
            return power_of_each(points, int(self.reach))
        return power_of_each(points, int(self.reach), sides=self.sides)


@lru_cache(maxsize=4)
def known_region(region: FrequencyRegion) -> FrequencyRegion:
    """Return an equal region whose shells may be made already: the pieces of a source share them."""
    return region
