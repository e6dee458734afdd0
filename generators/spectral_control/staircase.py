"""Stair blue noise: an empty band, a stair of raised power, flat beyond (Kailkhura et al. 2016)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from gbnbench.core.errors import InputError
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_above
from gbnbench.generators.spectral_control.band import check_edge
from gbnbench.generators.spectral_control.named_profiles import MOST_POWER, StairProfile, of_the_plane
from gbnbench.generators.spectral_control.ring_means import RingMeans

EDGE = 0.775  # in the plane
END = 1.38


@dataclass(frozen=True)
class Staircase(RingMeans):
    """Random points moved until the ring means of the power are 0, then one raised level, then 1.

    Parameters
    ----------
    edge : float or None
        Where the stair begins, in nu; by default 0.775 in the plane, elsewhere scaled as the widest step.
    end : float or None
        Where it ends, in nu, above the edge; by default 1.38 in the plane.
    level : float
        Power of the stair, > 0.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    A stair lets the band be wider than the widest step. The defaults are read off two published sets of
    1,024 points, whose power is 1.3 between these two edges. No process has exactly that: its pair
    correlation would be -0.3 at 0.4 spacings. The published sets leave a power of 0.05 to 0.1 in the upper
    half of the band; ours leave 5e-4 in it, and a stair a twentieth higher: the publication's own optimiser,
    which matches an estimate of the pair correlation function, is not here. A process can have
    ``edge=0.68,end=1.23,level=1.2``.

    References
    ----------
    Kailkhura, Thiagarajan, Bremer & Varshney, "Stair blue noise sampling", ACM Trans. Graph. 35(6), 2016.

    Examples
    --------
    >>> import numpy as np
    >>> Staircase()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "staircase"
    summary: ClassVar[str] = (
        "stair blue noise: an empty band, a raised stair, flat beyond (Kailkhura et al. 2016)"
    )
    family: ClassVar[Family] = "spectral"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Kailkhura, Thiagarajan, Bremer & Varshney, 2016"

    edge: float | None = None
    end: float | None = None
    level: float = 1.3

    def __post_init__(self) -> None:
        super().__post_init__()
        check_edge(self.edge)
        if self.end is not None and not math.isfinite(self.end):
            raise InputError(f"end must be finite, in nu; got {self.end}")
        check_above("level", self.level, 0, MOST_POWER)
        plane = self.profile(2)
        if not plane.end > plane.edge:
            raise InputError(f"end must be above the edge, {plane.edge:.4g}; got {plane.end:.4g}")

    def profile(self, d: int) -> StairProfile:
        """Target power as a function of nu in d dimensions."""
        edge = of_the_plane(EDGE, d) if self.edge is None else self.edge
        return StairProfile(edge, of_the_plane(END, d) if self.end is None else self.end, self.level)
