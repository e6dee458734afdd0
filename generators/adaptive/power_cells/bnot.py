"""Blue noise through optimal transport, for a density (de Goes, Breeden, Ostromoukhov & Desbrun 2012)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import to_ink, within
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.generators.adaptive.islands import islands
from gbnbench.generators.adaptive.method import AdaptiveMethod
from gbnbench.generators.adaptive.power_cells.density_diagram import DensityDiagrams
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.power_cells.equal_areas import equal_masses
from gbnbench.generators.ranges import check_least

MASSES = 1e-3  # relative error of each cell's mass while the points move
STEPS = 20  # Newton's in one alternation, at most; from the third on two are enough
BACKGROUNDS = (1.0, 0.1, 0.01, 1e-3)  # points' mass spread over the whole domain, by alternations
HIDDEN = 0.02  # of 1 / n: where a cell has less mass, weights begin at 0 again
USUAL = 10  # alternations until the gradient is small, for progress


@dataclass(frozen=True)
class WeightedOptimalTransport(AdaptiveMethod):
    """Points at the centroids of power cells that have equal shares of the density.

    Parameters
    ----------
    gradient : float
        Points come to rest where the norm of the cost's gradient by their places is at most this, in units
        of 1/n and of the domain's area and the density's whole being 1, >= 0; each island has its own.
    alternations : int
        Most times that the weights are found and the points moved to the centroids, >= 0.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    As the uniform method (``gbnbench.generators.power_cells.bnot``): Newton's steps give every power cell the
    mass 1/n, to a thousandth of it, then every point moves to its cell's centroid. Each move lowers the cost
    of the transport from the density to the points. Masses, centroids and the masses along sides, of which
    the Hessian is made, are exact for pixels of one density each (``side_integrals``).

    What differs from the publication: points start along a Hilbert curve in place of independently, a move
    goes to the centroid without a line search, and regular regions are not broken up, which is for runs that
    are longer than these. Islands of ink in white (``islands``) are drawn one by one: each gets the whole
    number of points next to its share, and its cells have equal masses among themselves. One cell for two
    islands would have its centroid in the white between, and masses hardly change while its sides move
    through it: Newton's steps were halved some fifteen times each, and the points did not come to rest.

    So that cells on what hangs together loosely have neighbours, one point's mass is spread over all pixels
    in the first alternation, a tenth of it in the next, and a thousandth from the fourth on; where twenty
    steps do not make masses equal, the points move all the same.
    A centroid may lie on a pixel without ink; such a point goes to the nearest one that has some at the end.

    Cost: 6 to 9 CPU s for 10,000 points on 512 x 512 pixels, half a second for 1,500 on twelve islands.

    References
    ----------
    de Goes, Breeden, Ostromoukhov & Desbrun, "Blue noise through optimal transport", ACM Trans. Graphics
    31(6), 2012.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> WeightedOptimalTransport(alternations=3)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "bnot"
    summary: ClassVar[str] = "blue noise through optimal transport (de Goes et al. 2012)"
    reference: ClassVar[str] = "de Goes, Breeden, Ostromoukhov & Desbrun, 2012"
    gradient: float = 0.03
    alternations: int = 1000

    def __post_init__(self) -> None:
        for name in ("gradient", "alternations"):
            check_least(name, getattr(self, name), 0)

    def refusal(self, density: Density, n: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say why not: the density is none of the plane, as ``AdaptiveMethod.refusal`` does."""
        return (
            None if density.d == 2 else f"bnot cuts the plane into power cells; got {density.d} axes, not 2"
        )

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it: each island by itself."""
        parts, steps = islands(density, n), min(USUAL, self.alternations)
        found = []
        for k, island in enumerate(parts):

            def heard(done: int, of: int, doing: str, before: int = k * steps) -> None:
                told(before + min(done, of), len(parts) * steps, doing)

            found.append(island.corner + self._one_island(island.density, island.n, rng, heard))
        return to_ink(density, within(density, np.concatenate(found)))

    def _one_island(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw the points of an island."""
        x, weight = hilbert_start(density, n, rng), np.zeros(n)
        diagrams = DensityDiagrams(density, BACKGROUNDS[0] / n)
        cells, steps = diagrams(x, weight), min(USUAL, self.alternations)
        for done in range(self.alternations):
            told(min(done, steps), steps, "alternations of bnot")
            if 0 < done < len(BACKGROUNDS):
                diagrams = DensityDiagrams(density, BACKGROUNDS[done] / n)
                cells = diagrams(x, weight)
            if cells.mass.min() < HIDDEN / n:
                weight = np.zeros(n)
                cells = diagrams(x, weight)
            weight, cells = equal_masses(partial(diagrams, x), weight, cells, MASSES, STEPS)
            x = within(density, x + np.where(cells.mass[:, None] > 0, cells.offset, 0.0))
            cells = diagrams(x, weight, cells)
            slope = 2 * n * np.linalg.norm(cells.moment) / np.sqrt(density.values.size)
            if slope <= self.gradient and done >= len(BACKGROUNDS) - 1:
                break
        return to_ink(density, x)
