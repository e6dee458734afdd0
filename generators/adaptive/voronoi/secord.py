"""Weighted Voronoi stippling (Secord 2002): points move to their cells' centroids, weighted with the ink."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy.spatial import cKDTree

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import pixels_of, within
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.generators.adaptive.method import AdaptiveMethod, too_fine
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.adaptive.voronoi.weighted_cells import CellParts, parts_of_pixels
from gbnbench.generators.ranges import check_least


@dataclass(frozen=True)
class WeightedVoronoi(AdaptiveMethod):
    """Lloyd's method for a density.

    Parameters
    ----------
    iterations : int
        At most so many moves of all points, >= 0.
    tolerance : float
        Stop once the root mean square move is below this part of the local spacing, >= 0.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    Cells are sums over parts of pixels, at least 48 for the smallest cell: on whole pixels small cells are a
    few pixels each and the method soon stands still, as Secord noted. Points start along a Hilbert curve, in
    place of a random start. A centroid may fall on a pixel without ink, where a cell bends around it; such a
    point takes the place of its cell's inked part that is nearest to the centroid at the end.

    References
    ----------
    Secord, "Weighted Voronoi stippling", NPAR 2002.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> WeightedVoronoi(iterations=5)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "secord"
    summary: ClassVar[str] = "weighted Voronoi stippling (Secord 2002)"
    reference: ClassVar[str] = "Secord, Weighted Voronoi stippling, 2002"
    iterations: int = 60
    tolerance: float = 0.002

    def __post_init__(self) -> None:
        check_least("iterations", self.iterations, 0)
        check_least("tolerance", self.tolerance, 0)

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why the pixels cannot be cut finely enough, as ``AdaptiveMethod.refusal`` does."""
        return parts_refusal(density, n)

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        x, parts = hilbert_start(density, n, rng), CellParts(density, n)
        for done in range(self.iterations):
            cells = parts.cells(x)
            x = within(density, x + cells.moves)
            told(done + 1, self.iterations, "moves of secord")
            rate = np.maximum(density.of_points(n)[pixels_of(density, x)], 1e-12) ** (1 / density.d)
            if np.sqrt(((cells.moves * rate[:, None]) ** 2).sum(axis=1).mean()) < self.tolerance:
                break
        return on_ink(density, parts, x)


def on_ink(density: Density, parts: CellParts, x: FloatArray) -> FloatArray:
    """Move points that lie on pixels without ink to the nearest part that has some.

    Parameters
    ----------
    density : Density
        The density.
    parts : CellParts
        Its parts.
    x : (n, d) float64
        Points, in pixels.

    Returns
    -------
    (n, d) float64
    """
    astray = density.values[pixels_of(density, x)] == 0
    if astray.any():
        x = x.copy()
        x[astray] = parts.places[cKDTree(parts.places).query(x[astray])[1]]
    return x


def parts_refusal(density: Density, n: int) -> str | None:
    """Say why a density cannot be cut finely enough for cells of n points.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.

    Returns
    -------
    str or None
        The reason.
    """
    pixels = int((parts_of_pixels(density.of_points(n), density.d).astype(float) ** density.d).sum())
    return too_fine(density, n, pixels)
