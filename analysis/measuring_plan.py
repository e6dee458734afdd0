"""The plan of measuring a source, decided by the number and size of its sets before there are any."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from gbnbench.analysis.affordable_powers import farther_region, near_region
from gbnbench.analysis.frequency_region import FrequencyRegion, known_region
from gbnbench.analysis.realization_pieces import group_size, pieces
from gbnbench.core.sides import Sides


@dataclass(frozen=True)
class MeasuringPlan:
    """The request from which every piece of a source, and their merger, draw the same conclusions.

    Attributes
    ----------
    n, d, realizations : int
        Points of a set, dimension, and number of sets of the whole source.
    fmax : int or None
        Largest harmonic on each axis, or |k| for unequal sides; None for as far as nu = 2, or as affordable
        (``default_fmax``).
    sides : tuple of d floats or None
        As ``as_sides`` returns them; None for a cube.
    curves : bool
        Whether g(r) and the zone plate are wanted beside the scalars.
    """

    n: int
    d: int
    realizations: int
    fmax: int | None = None
    sides: Sides | None = None
    curves: bool = True

    @cached_property
    def near(self) -> FrequencyRegion:
        """The frequencies that are measured in any case."""
        return known_region(near_region(self.n, self.d, self.realizations, self.fmax, self.sides))

    @cached_property
    def far(self) -> FrequencyRegion | None:
        """Shells beyond the end of a default cube, listed; None where none are affordable."""
        region = farther_region(self.n, self.realizations, self.near) if self.fmax is None else None
        return None if region is None else known_region(region)

    @property
    def group(self) -> int:
        """Sets whose power is kept together at every frequency."""
        return group_size(self.realizations)

    @property
    def pieces(self) -> list[tuple[int, int]]:
        """The first realization of each piece, and how many it has."""
        return pieces(self.n, self.realizations)
