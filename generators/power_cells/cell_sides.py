"""Sides of power cells in the plane, by the hull of lifted points (Aurenhammer 1987)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class CellSides:
    """Sides of the cells of the first n of some weighted points, counterclockwise about each.

    Attributes
    ----------
    site, other : (m,) intp
        The cell's own point, and the point of all behind the side.
    start, end : (m, 2) float64
        Ends of each side, from its own point.
    normal : (m, 2) float64
        Vector from the own point to the other.
    corner : (m, 2) float64
        The end, from the centre that the points were moved to.
    """

    site: NDArray[np.intp]
    other: NDArray[np.intp]
    start: FloatArray
    end: FloatArray
    normal: FloatArray
    corner: FloatArray


def cell_sides(points: FloatArray, weight: FloatArray, n: int) -> CellSides | None:
    """Find the sides of the cells of the first n points.

    Parameters
    ----------
    points : (m, 2) float64
        About the origin: small coordinates lose less in their squares.
    weight : (m,) float64
        Of each point.
    n : int
        How many cells are wanted; the other points are around them.

    Returns
    -------
    CellSides or None
        None where a cell is open, or Qhull finds no hull: too few points, or all on one plane.

    Notes
    -----
    The points (c, |c|**2 - w) are lifted; the lower facets of their convex hull are the triangles dual to the
    diagram, and a facet's normal gives the vertex where its three cells meet.
    """
    from scipy.spatial import ConvexHull, QhullError

    height = np.sum(points * points, axis=1) - weight
    try:
        hull = ConvexHull(np.column_stack([points, height - height.mean()]))
    except QhullError:
        return None
    facets, neighbours, plane = hull.simplices, hull.neighbors, hull.equations
    low = plane[:, 2] < 0
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = plane[:, :2] / (-2 * plane[:, 2:3])
    corner = points[facets]
    u, v = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    clockwise = u[:, 0] * v[:, 1] < u[:, 1] * v[:, 0]
    swap = np.where(clockwise[:, None], [0, 2, 1], [0, 1, 2])
    facets = np.take_along_axis(facets, swap, axis=1)
    neighbours = np.take_along_axis(neighbours, swap, axis=1)
    # Triangles run counterclockwise: the side a -> b opposite a corner has its own triangle on the left.
    a, b = np.roll(facets, -1, axis=1), np.roll(facets, -2, axis=1)
    own = low[:, None] & (a < n)
    site, other, right = a[own], b[own], neighbours[own]
    left = np.nonzero(own)[0]
    if not low[right].all():
        return None
    return CellSides(
        site=site.astype(np.intp),
        other=other.astype(np.intp),
        start=vertex[right] - points[site],
        end=vertex[left] - points[site],
        normal=points[other] - points[site],
        corner=vertex[left],
    )
