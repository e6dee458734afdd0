"""Delaunay neighbours in space at the points of a set within a tiling, checked to be those of the torus.

An edge counts where the Voronoi face between its ends has width: where more than four points lie on one empty
ball the diagonals are arbitrary, and their Voronoi faces are points or lines.
"""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.spatial.delaunay_tiling import Tiling
from gbnbench.analysis.spatial.empty_balls import holds_a_corner
from gbnbench.analysis.spatial.plane_rings import IndexArray, Rings, edge_vectors, starts
from gbnbench.core.periodic_delaunay import overhang
from gbnbench.core.torus import FloatArray

# A Voronoi face of less width, over the distance from either end to its nearest neighbour, counts as none.
NARROWEST_FACE = 1e-6
# Rounding of the tiling's coordinates, in sides; what it moves a circumcentre by is no width either.
ROUNDED = 2.0**-51
ROUNDINGS = 64.0
# A tetrahedron of less height, over its shortest edge from the first corner, is flat.
FLATTEST = 1e-8


def star_in_space(tiling: Tiling) -> Rings | float:
    """Neighbours in space whose Voronoi faces have width, or the margin that is needed.

    Parameters
    ----------
    tiling : Tiling
        Points of space with their border.

    Returns
    -------
    Rings or float
        Edges in no cyclic order; or the margin that is needed, 0 where it is not known: the star is open, or
        a ball is not empty.
    """
    simplices, n = tiling.simplices, len(tiling.x)
    if len(np.unique(simplices[simplices < n])) < n:
        return 0.0
    origin = tiling.place[simplices[:, 0]]
    edges = tiling.place[simplices[:, 1:]] - origin[:, None]
    square = np.sum(edges**2, axis=2)
    normal = np.stack([np.cross(edges[:, i], edges[:, j]) for i, j in ((1, 2), (2, 0), (0, 1))], axis=1)
    volume = np.sum(edges[:, 0] * normal[:, 0], axis=1)
    faces = np.concatenate([normal, normal.sum(axis=1, keepdims=True)], axis=1)  # opposite to each corner
    widest = np.sqrt(np.sum(faces**2, axis=2).max(axis=1))
    rounding = ROUNDED * tiling.box.max()
    # Flat tetrahedra come from points on one sphere; their centre is that of the tetrahedra beside them.
    least = np.maximum(FLATTEST * np.sqrt(square.min(axis=1)), rounding)
    solid = np.abs(volume) > least * widest
    simplices, origin, square, normal = simplices[solid], origin[solid], square[solid], normal[solid]
    volume, widest = volume[solid], widest[solid]
    centre = np.sum(square[:, :, None] * normal, axis=1) / (2 * volume[:, None])
    radius = np.sqrt(np.sum(centre**2, axis=1))
    lacking = overhang(origin + centre, radius, tiling.sides)
    if lacking > tiling.margin:
        return lacking
    # Corners moved by the rounding move the centre by about radius / height times as much.
    unsure = ROUNDINGS * rounding * radius * widest / np.abs(volume)
    if holds_a_corner(tiling, simplices, tiling.beyond[solid], unsure):
        return 0.0
    pairs = np.array([(i, j) for i in range(4) for j in range(4) if i != j])
    point, image = simplices[:, pairs].reshape(-1, 2).T
    corner, unsure = (np.repeat(each, len(pairs), axis=0)[point < n] for each in (origin + centre, unsure))
    point, image = point[point < n], image[point < n]
    order = np.lexsort((image, point))
    point, image, corner, unsure = point[order], image[order], corner[order], unsure[order]
    start = np.flatnonzero(np.r_[True, (np.diff(point) != 0) | (np.diff(image) != 0)])
    count = np.diff(np.r_[start, len(point)])
    wide = _widths(corner, start, count)
    point, image = point[start], image[start]
    index, turn = tiling.images(image)
    vector = edge_vectors(tiling.x, tiling.box, point, index, turn)
    rings = Rings(starts(np.bincount(point, minlength=n)), point, index, turn, vector)
    near = NARROWEST_FACE * np.minimum(rings.nearest[point], rings.nearest[index])
    narrowest = np.maximum(near, np.maximum.reduceat(unsure, start))
    return rings.of(wide > narrowest)


def _widths(corner: FloatArray, start: IndexArray, count: IndexArray) -> FloatArray:
    """Widths of faces, from the longest line through their first corner: (faces,).

    Second moments would say so too, but those of a needle differ in digits that squares have lost.
    """
    face = np.repeat(np.arange(len(start)), count)
    away = corner - corner[start][face]
    far = np.empty_like(start)
    square = np.sum(away**2, axis=1)
    farthest = np.flatnonzero(square == np.maximum.reduceat(square, start)[face])
    far[face[farthest]] = farthest
    area = np.sum(np.cross(away, away[far][face]) ** 2, axis=1)
    with np.errstate(invalid="ignore"):
        wide: FloatArray = np.sqrt(np.maximum.reduceat(area, start) / square[far])
    return wide
