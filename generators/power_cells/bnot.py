"""Blue noise through optimal transport (de Goes, Breeden, Ostromoukhov & Desbrun 2012)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.power_cells.diagram import PowerDiagram, power_diagram
from gbnbench.generators.power_cells.equal_areas import equal_areas
from gbnbench.generators.power_cells.regularity import break_regions, irregularity
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_least, outside_plane
from gbnbench.generators.set_by_set import SetBySet, Told

AREAS = 1e-3  # relative error of each area while the points move: less changes nothing that can be measured
USUAL = 10  # alternations until the gradient is small, for progress


@dataclass(frozen=True)
class OptimalTransport(SetBySet):
    """Points at the centroids of power cells of equal area, on the way to an optimal transport plan.

    Parameters
    ----------
    gradient : float
        Points come to rest where the norm of the cost's gradient by their places is at most this, in units
        of 1/n, >= 0.
    alternations : int
        Most times that the weights are found and the points moved to the centroids, >= 0.
    breaks : int
        Most times that regular regions are broken up and the alternations done anew, >= 0.
    regularity : float
        Points count as regular whose cell's energy differs from its neighbours' by less than this in the
        mean, in units of 1/n**2, >= 0.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The weights of a power diagram are found by Newton's method so that every cell has the area 1/n
    (``gbnbench.generators.power_cells.equal_areas``); then every point moves to its cell's centroid, and so
    on. Each move lowers the cost of the transport from the uniform density to the points. Its gradient by
    point k is 2 m_k (x_k - c_k), m_k being the area and c_k the centroid of the cell.

    How small a gradient is small enough decides how ordered sets are. The default, 0.03 / n ("3e-5 for 1,000
    sites"), is that of the authors' program, whose line search tries the centroid first. It is reached
    after nine or ten alternations whatever n is, and gives sets as they were published: of the rings of the
    radial power from |f| = 3 to 48 none is told from the mean of four published sets, which is itself
    known to 16% at |f| = 3 and to 5% beyond 24. The most ordered of the published sets took twice as many
    alternations, a gradient of about 0.015; from about fifty on points crystallise.

    For long runs there is the publication's remedy, ``breaks``: where a cell's energy is nearly that of its
    neighbours, the point and its neighbours are jittered, some regular points are put elsewhere, and the
    alternations are done once more. Its threshold, 0.25/n in these units, is held at the value that it has
    for n = 1,024, so that it does not depend on n.

    References
    ----------
    de Goes, Breeden, Ostromoukhov & Desbrun, "Blue noise through optimal transport", ACM Trans. Graphics
    31(6), 2012.

    Examples
    --------
    >>> OptimalTransport(alternations=3)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "bnot"
    summary: ClassVar[str] = (
        "blue noise through optimal transport: centroids of power cells of equal area (de Goes et al. 2012)"
    )
    family: ClassVar[Family] = "cellular"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 2)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "de Goes, Breeden, Ostromoukhov & Desbrun, 2012"
    gradient: float = 0.03
    alternations: int = 1000
    breaks: int = 0
    regularity: float = 2.4e-4

    def __post_init__(self) -> None:
        for name in ("gradient", "alternations", "breaks", "regularity"):
            check_least(name, getattr(self, name), 0)

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say why not: d is other than 2.

        Parameters
        ----------
        n : int
            Points; any number will do.
        d : int
            Dimension.

        Returns
        -------
        str or None
            The reason; None for d = 2.
        """
        return outside_plane(d, "bnot cuts the plane into power cells")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        rounds = 1 + self.breaks
        x, diagram = self._alternate(rng.random((n, d)), lambda share: told(share / rounds))
        for k in range(self.breaks):
            told((k + 1) / rounds)
            if diagram is None or not (regular := irregularity(diagram) < self.regularity).any():
                break
            x, diagram = self._alternate(break_regions(x, diagram, regular, rng), lambda _: None)
        return x

    def _alternate(self, x: FloatArray, told: Told) -> tuple[FloatArray, PowerDiagram | None]:
        """Move points to the centroids until the gradient is small; with them their last diagram."""
        n, weight, diagram = len(x), np.zeros(len(x)), None
        for done in range(self.alternations):
            told(min(done / min(USUAL, self.alternations), 1.0))
            weight, equal = equal_areas(x, weight, AREAS, diagram)
            x = wrap(x + equal.offset)
            diagram = power_diagram(x, weight, equal.reach)
            if 2 * n * np.linalg.norm(diagram.moment) <= self.gradient:
                break
        return x, diagram
