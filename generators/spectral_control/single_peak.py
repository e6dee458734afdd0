"""Single-peak blue noise: an empty band, one peak, a flat spectrum beyond (Heck, Schlömer & Deussen 2013)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_above, check_range
from gbnbench.generators.spectral_control.band import check_edge
from gbnbench.generators.spectral_control.named_profiles import MOST_POWER, PeakProfile, of_the_plane
from gbnbench.generators.spectral_control.ring_means import RingMeans

EDGE = 0.8  # in the plane
POWER = 0.21
WIDTH = 0.05


@dataclass(frozen=True)
class SinglePeak(RingMeans):
    """Random points moved until the ring means of the power are a blurred step with one peak at its edge.

    Parameters
    ----------
    edge : float or None
        nu of step and peak; by default 0.8 in the plane, elsewhere scaled as the widest step.
    power : float or None
        Of the peak, its integral over nu; by default 0.21 in the plane. 0 leaves a step.
    width : float or None
        Standard deviation of the blur along nu; by default 0.05 in the plane.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    P = G * (power delta(nu - edge) + H(nu - edge)), G being the Gaussian: the publication's family. The
    defaults are ours: the least peak, in steps of 0.01, whose pair correlation in the plane is nowhere below
    -0.01 at this edge and width. A wider edge needs a higher peak, and beyond 0.86 no peak will do; what no
    process can have is met as nearly as the points can, and ``target_fit`` says how nearly: 1,024 points in
    the plane within 0.05 dB, with 5e-6 where no power is asked; 1,000 in 3D and 1,024 in 4D within 0.001 dB,
    with 1e-10; on a line 1.1 dB off after 300 iterations, with 2e-3.

    References
    ----------
    Heck, Schlömer & Deussen, "Blue noise sampling with controlled aliasing", ACM Trans. Graph. 32(3), 2013.

    Examples
    --------
    >>> import numpy as np
    >>> SinglePeak()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "peak"
    summary: ClassVar[str] = "single-peak blue noise: an empty band, one peak, flat beyond (Heck et al. 2013)"
    family: ClassVar[Family] = "spectral"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Heck, Schlömer & Deussen, 2013"

    edge: float | None = None
    power: float | None = None
    width: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        check_edge(self.edge)
        if self.power is not None:
            check_range("power", self.power, 0, MOST_POWER)
        if self.width is not None:
            check_above("width", self.width, 0)

    def profile(self, d: int) -> PeakProfile:
        """Target power as a function of nu in d dimensions."""
        return PeakProfile(
            of_the_plane(EDGE, d) if self.edge is None else self.edge,
            of_the_plane(POWER, d) if self.power is None else self.power,
            of_the_plane(WIDTH, d) if self.width is None else self.width,
        )
