"""Balls of tetrahedra that hold a corner beyond a facet, told by signs that rounding does not turn."""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.spatial.delaunay_tiling import Tiling
from gbnbench.analysis.spatial.plane_rings import IndexArray, edge_vectors
from gbnbench.core.torus import FloatArray

ERROR = (
    64 * 2.0**-53
)  # of the sum of sizes of a determinant's terms, whose coordinates are rounded three times


def holds_a_corner(tiling: Tiling, simplices: IndexArray, beyond: IndexArray, unsure: FloatArray) -> bool:
    """Tell whether the ball of some tetrahedron certainly holds a corner beyond one of its facets.

    Parameters
    ----------
    tiling : Tiling
        Points of space with their border.
    simplices : (k, 4) intp
        Rows of the tiling, no four of them in a plane.
    beyond : (k, 4) intp
        Rows of the tiling, -1 where there is none.
    unsure : (k,) float64
        By how much rounding of the coordinates may move the centres.

    Returns
    -------
    bool
        True means that the tetrahedra are not Delaunay's: a lifted coordinate lost too many digits.
    """
    edges = np.stack([_between(tiling, simplices[:, 0], simplices[:, k]) for k in (1, 2, 3)], axis=1)
    square = np.sum(edges**2, axis=2)
    normal, size = np.empty_like(edges), np.empty_like(edges)
    for k in range(3):
        u, v = edges[:, (k + 1) % 3], edges[:, (k + 2) % 3]
        one, two = (np.roll(u, -s, axis=1) * np.roll(v, -t, axis=1) for s, t in ((1, 2), (2, 1)))
        normal[:, k], size[:, k] = one - two, np.abs(one) + np.abs(two)
    volume = np.sum(edges[:, 0] * normal[:, 0], axis=1)
    size_of_volume = np.sum(np.abs(edges[:, 0]) * size[:, 0], axis=1)
    slope, size_of_slope = (np.sum(square[:, :, None] * each, axis=1) for each in (normal, size))
    radius = np.sqrt(np.sum(slope**2, axis=1)) / np.abs(2 * volume)
    for facet in range(4):
        away = _between(tiling, simplices[:, 0], beyond[:, facet])
        far = np.sum(away**2, axis=1)
        inside = np.sign(volume) * (np.sum(away * slope, axis=1) - far * volume)
        error = ERROR * (np.sum(np.abs(away) * size_of_slope, axis=1) + far * size_of_volume)
        # The determinant is the volume times (radius^2 - distance^2), whose slope is 2 radius.
        deep = inside > error + 4 * radius * unsure * np.abs(volume)
        if (deep & (beyond[:, facet] >= 0)).any():
            return True
    return False


def _between(tiling: Tiling, rows: IndexArray, others: IndexArray) -> FloatArray:
    """Vectors from some rows of the tiling to others."""
    (point, from_turn), (index, to_turn) = tiling.images(rows), tiling.images(others)
    return edge_vectors(tiling.x, tiling.box, point, index, to_turn - from_turn)
