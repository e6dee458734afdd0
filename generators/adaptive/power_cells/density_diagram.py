"""Power diagrams whose cells are measured by a density: masses, centroids and sides, exact on its pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.periodic_delaunay import images_in_box, overhang
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.power_cells.side_integrals import DensityIntegral
from gbnbench.generators.power_cells.cell_sides import CellSides, cell_sides
from gbnbench.generators.power_cells.measured_cells import MeasuredCells

BORDER = 3.5  # first guess of the border of images, in mean spacings
FAR = 4.0  # longest sides, from the centre to the corners that close the cells of a bounded density


class DensityDiagrams:
    """Power diagrams of points for one density.

    Parameters
    ----------
    density : Density
        Of an image.
    background : float
        Part of the whole, added evenly over all pixels.
    """

    def __init__(self, density: Density, background: float) -> None:
        self._integral = DensityIntegral(density, background)
        self._toroidal, self._shape = density.toroidal, np.array(density.shape, np.float64)
        self._unit = float(max(density.shape))

    def __call__(self, x: FloatArray, weight: FloatArray, near: MeasuredCells | None = None) -> MeasuredCells:
        """Cut the domain into power cells.

        Parameters
        ----------
        x : (n, 2) float64
            Points within the density, in pixels.
        weight : (n,) float64
            In squared pixels.
        near : MeasuredCells, optional
            One like it, whose border of images is tried first.

        Returns
        -------
        MeasuredCells
            Masses add up to 1; lengths are in pixels.

        Notes
        -----
        On the torus images are added as in ``power_diagram``. The cells of a bounded density are closed by
        four points so far away that their own cells are outside, where there is no density.
        """
        if not self._toroidal:
            return self._bounded(x, weight)
        sides = tuple((self._shape / self._unit).tolist())
        margin = min(1.0, BORDER / np.sqrt(len(x)) if near is None else near.reach / self._unit)
        while True:
            tiled, owner = images_in_box(x / self._unit, sides, margin)
            centre = 0.5 * self._shape / self._unit
            scaled = weight / self._unit**2
            found = cell_sides(tiled - centre, scaled[owner], len(x))
            reach = np.inf
            if found is not None:
                power = np.sum(found.end * found.end, axis=1) - scaled[found.site]
                radius = np.sqrt(np.maximum(power + scaled.max(), 0.0))
                reach = overhang(found.corner + centre, radius, sides)
                if margin >= 1 or reach <= margin:
                    return self._measured(x, found, owner[found.other], reach * self._unit)
            margin = min(1.0, 2 * margin if found is None else max(1.01 * reach, 1.2 * margin))

    def _bounded(self, x: FloatArray, weight: FloatArray) -> MeasuredCells:
        n, centre = len(x), 0.5 * self._shape
        corners = FAR * np.array([(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)])
        points = np.concatenate([(x - centre) / self._unit, corners])
        scaled = weight / self._unit**2
        found = cell_sides(points, np.append(scaled, np.full(4, scaled.min())), n)
        assert found is not None  # noqa: S101 - the corners span the plane and close all cells
        return self._measured(x, found, found.other, 0.0)

    def _measured(
        self, x: FloatArray, sides: CellSides, other: NDArray[np.intp], reach: float
    ) -> MeasuredCells:
        """Integrate over the cells; where there are no images, a side once for the cells on both sides."""
        n, unit = len(x), self._unit
        used = np.ones(len(other), bool) if self._toroidal else sides.site < other
        site, other = sides.site[used], other[used]
        start, end, normal = (unit * vectors[used] for vectors in (sides.start, sides.end, sides.normal))
        found = self._integral.along(x[site] + start, x[site] + end)

        def over_cells(of_side: FloatArray) -> FloatArray:
            total = np.bincount(site, of_side, n).astype(np.float64)
            return total if self._toroidal else total - np.bincount(other, of_side, n)[:n]

        mass, square = over_cells(found.mass), over_cells(found.square)
        total = np.stack([over_cells(along) for along in found.moment.T], axis=1)
        edges, conductance = (
            np.stack([site, other], axis=1),
            found.line / (2 * np.linalg.norm(normal, axis=1)),
        )
        if not self._toroidal:
            inner = other < n
            edges, conductance = edges[inner], conductance[inner]
            edges, conductance = np.concatenate([edges, edges[:, ::-1]]), np.concatenate([conductance] * 2)
        return MeasuredCells(
            mass=mass,
            moment=total - mass[:, None] * x,
            energy=square - 2 * np.sum(total * x, axis=1) + mass * np.sum(x * x, axis=1),
            edges=edges,
            conductance=conductance,
            reach=reach,
        )
