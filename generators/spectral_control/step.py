"""Step blue noise: no power below an edge, a flat spectrum above (Heck, Schlömer & Deussen 2013)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gbnbench.generators.protocol import Family
from gbnbench.generators.spectral_control.band import check_edge
from gbnbench.generators.spectral_control.named_profiles import StepProfile, widest_step
from gbnbench.generators.spectral_control.ring_means import RingMeans


@dataclass(frozen=True)
class Step(RingMeans):
    """Random points moved until no power is below the edge and every ring above has a mean power of 1.

    Parameters
    ----------
    edge : float or None
        In nu; by default the widest that a process can have, V_d edge**d = 1: 0.564 in the plane, 0.620 in
        3D. In 1D that would leave lattices alone, and 0.3 is taken.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The publication descends by the pair correlation function, as ``method=correlation`` does step by step:
    sets with its figures, the noise floor of their band between 5e-3 and 1.7e-2 (published 6e-3 to 7e-3) and
    oscillations of .09 to .19 (.11 to .15), in eight times the time. The mean floor, 1e-2, misses
    the published: it stands at |f| = 2, 4 and 6, since forces end at 0.49 of the box, and neither a slower
    nor a longer cooling lowers it. By default the ring means of
    the power themselves are met, by limited-memory BFGS, which is another method with the same aim: the band
    holds less than 1e-9, and rings are at 1 within 0.001 dB; that its floor lies below
    the published one says nothing of how the publication's method does. ``stealthy`` empties the same band
    without asking for anything beyond it.

    References
    ----------
    Heck, Schlömer & Deussen, "Blue noise sampling with controlled aliasing", ACM Trans. Graph. 32(3), 2013.

    Examples
    --------
    >>> import numpy as np
    >>> Step()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "step"
    summary: ClassVar[str] = "step blue noise: no power below an edge, flat above (Heck et al. 2013)"
    family: ClassVar[Family] = "spectral"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Heck, Schlömer & Deussen, 2013"

    edge: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        check_edge(self.edge)

    def profile(self, d: int) -> StepProfile:
        """Target power as a function of nu in d dimensions."""
        return StepProfile(widest_step(d) if self.edge is None else self.edge)
