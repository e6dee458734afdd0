"""A set of a torus with a border of its images, and the simplices at its points."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gbnbench.analysis.spatial.plane_rings import IndexArray
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Tiling:
    """Points, their images, and the Delaunay simplices that Qhull makes of them.

    Attributes
    ----------
    x : (n, d) float64
        Points on the unit torus.
    box : (d,) float64
        Sides of the torus.
    place : (m, d) float64
        The points in the box, then their images, rounded.
    owner : (m,) intp
        Of which point each row of ``place`` is an image.
    margin : float
        Width of the border of images.
    simplices : (k, d + 1) intp
        Rows of ``place``: the simplices that have a corner among the first n.
    beyond : (k, d + 1) intp
        Rows of ``place``: the corner beyond the facet that is opposite to each corner, where there is one.
    """

    x: FloatArray
    box: FloatArray
    place: FloatArray
    owner: IndexArray
    margin: float
    simplices: IndexArray
    beyond: IndexArray

    @property
    def sides(self) -> tuple[float, ...]:
        """Sides of the torus as numbers."""
        return tuple(self.box.tolist())

    @cached_property
    def turns(self) -> IndexArray:
        """Whole sides by which each row of the tiling is moved: (m, d)."""
        return np.rint((self.place - self.place[self.owner]) / self.box).astype(np.intp)

    def images(self, rows: IndexArray) -> tuple[IndexArray, IndexArray]:
        """Owners of rows of the tiling, and the whole sides by which these are moved: (k,), (k, d)."""
        return self.owner[rows], self.turns[rows]
