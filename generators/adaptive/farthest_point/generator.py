"""Farthest-point optimisation for a density (after Schlömer, Heck & Deussen 2011 and Yan et al. 2014)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.farthest_point.places import (
    CROWDED,
    crowding,
    number_of_places,
    void_places,
)
from gbnbench.generators.adaptive.farthest_point.relocation import AdaptiveSweeps
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.generators.adaptive.method import AdaptiveMethod, too_fine
from gbnbench.generators.adaptive.protocol import Told

WINDOW = 5  # sweeps over which the gain is judged
NEAR = 0.1  # quantile of the distances by which it is judged: the least one depends on a single pair
MOST_PLACES = 1 << 26


@dataclass(frozen=True)
class WeightedFarthestPoint(AdaptiveMethod):
    """Farthest-point optimisation: each point in turn moves to the largest void that the others leave.

    Parameters
    ----------
    smoothing : float
        The density is averaged over so many local spacings, by a Gaussian, to give these; 0.1 to 2.
    gain : float
        Stop once five sweeps together raise the tenth percentile of the distances to nearest neighbours by
        less than this, in local spacings, >= 0.
    sweeps : int
        At most so many, >= 0.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The local spacing s(x) is the side of a square in which the averaged density has one point. The distance
    of two places is |x - y| over the mean of s(x) and s(y); the void at a place is the distance to the
    nearest point, and in a box also to the place's mirror image beyond the border, so that points keep half a
    distance from there. Where the largest void on the ink is larger than the one at a point's own place, the
    point goes there; hence the least distance never falls. On a constant density on the torus this is the
    uniform method with its global strategy, and as good: the least distance is .91 of the densest at n =
    1,024 (the uniform method goes on to .925).

    What differs from the publications: Schlömer, Heck and Deussen define the method for uniform sets alone,
    and look for the largest void among all vertices of the Delaunay triangulation. Yan, Guo, Jia, Zhang and
    Wonka take a regular triangulation instead, whose vertices have weights by the density; which ones was not
    at hand, and the distance above is our own choice. A void with three points at its rim has its top where
    these have equal power by the weights (v s)^2, v being the void and s the mean of spacings: a vertex of
    such a triangulation. Tops may also lie at the border of the ink, where triangulations have no vertex. So
    voids are looked for among places on the ink, six along a local spacing, and the point climbs from the
    best place to the top. That void may be smaller than the largest, by an eighth of a spacing at most.

    In a box points line up along a border with much ink, half a distance from it. Cost: 12 to 17 CPU s for
    10,000 points on 512 x 512 pixels.

    References
    ----------
    Schlömer, Heck & Deussen, "Farthest-point optimized point sets with maximized minimum distance", HPG 2011.
    Yan, Guo, Jia, Zhang & Wonka, "Blue-noise remeshing with farthest point optimization", Comput. Graph.
    Forum 33(5), 2014.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> WeightedFarthestPoint(sweeps=2)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "fpo"
    summary: ClassVar[str] = "farthest-point optimisation (Schlömer, Heck & Deussen 2011) for a density"
    reference: ClassVar[str] = "Schlömer, Heck & Deussen, Farthest-point optimized point sets, 2011"
    smoothing: float = 0.25
    gain: float = 0.001
    sweeps: int = 200

    def __post_init__(self) -> None:
        if not 0.1 <= self.smoothing <= 2:
            raise InputError(f"smoothing must be from 0.1 to 2; got {self.smoothing}")
        if not self.gain >= 0:
            raise InputError(f"gain must be >= 0, in local spacings; got {self.gain}")
        if self.sweeps < 0:
            raise InputError(f"sweeps must be >= 0; got {self.sweeps}")

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why not: no image, too many points, or too uneven, as ``AdaptiveMethod.refusal`` does."""
        if density.d != 2:
            return f"fpo looks for voids in the plane; got {density.d} axes, not 2"
        if reason := too_fine(density, n, number_of_places(density, n), most=MOST_PLACES):
            return reason
        if (crowded := crowding(density, n)) > CROWDED:
            return (
                f"{n:,} points crowd on so little of the image that a cell of the grid, in which neighbours "
                f"are looked for, has {crowded:,.0f} of them, and {CROWDED:,} are the most: fewer points, or "
                "less white around the ink"
            )
        return None

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        x = hilbert_start(density, n, rng)[rng.permutation(n)]
        if not self.sweeps:
            return x
        work = AdaptiveSweeps(density, void_places(density, n, self.smoothing), x)
        near = [float(np.quantile(work.nearest(), NEAR))]
        for done in range(self.sweeps):
            moved = work.sweep()
            told(done + 1, self.sweeps, "sweeps of fpo; most sets need a tenth")
            near.append(float(np.quantile(work.nearest(), NEAR)))
            if moved == 0 or (len(near) > WINDOW and near[-1] - near[-1 - WINDOW] < self.gain):
                break
        return work.points()
