"""Delaunay neighbours in the plane: Qhull's triangles, checked and where needed mended in exact arithmetic.

Qhull lifts points to a paraboloid, where a coordinate of size 1 is rounded to 1e-16: triangles of points that
lie 1e-6 apart are partly chance.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spatial.delaunay_tiling import Tiling
from gbnbench.analysis.spatial.plane_edges import EdgeCheck
from gbnbench.analysis.spatial.plane_rings import Rings, in_rings
from gbnbench.analysis.spatial.plane_tiling import tiles_once
from gbnbench.analysis.spatial.star_splaying import splay
from gbnbench.core.periodic_delaunay import circumcentre, overhang


def star_in_plane(tiling: Tiling) -> Rings | float:
    """Neighbours in the plane as closed rings around each point, or the margin that is needed.

    Parameters
    ----------
    tiling : Tiling
        Points of the plane with their border.

    Returns
    -------
    Rings or float
        Rings that are proven to be Delaunay's; or the margin that is needed, 0 where it is not known.
    """
    x, box, n = tiling.x, tiling.box, len(tiling.x)
    triangles = tiling.simplices
    corners = np.concatenate([triangles, triangles[:, [1, 2, 0]], triangles[:, [2, 0, 1]]])
    point, first, second = corners[corners[:, 0] < n].T
    if (np.bincount(point, minlength=n) == 0).any():
        return 0.0
    rings, order = in_rings(x, box, point, *tiling.images(first))
    check = EdgeCheck(x, box)
    # Neighbours surround their point, so the angle is the cyclic order and each triangle follows its edge.
    if (first[order][rings.following] != second[order]).any() or not check.corners_turn_left(rings):
        return 0.0
    centre = circumcentre(rings.vector, rings.vector[rings.following])  # from the point
    radius = np.sqrt(np.sum(centre**2, axis=1))
    lacking = overhang(tiling.place[rings.point] + centre, radius, tiling.sides)
    if lacking > tiling.margin:
        return lacking
    tie, wrong = check.edges(rings)
    kept = _proven(check, rings, tie, wrong)
    if kept is not None:
        return kept
    astray = wrong | (~tie & (rings.twin < 0))
    beside = (rings.point, rings.index, rings.index[rings.preceding], rings.index[rings.following])
    mended = _mended(check, rings, np.unique(np.concatenate([each[astray] for each in beside])).tolist())
    return 0.0 if mended is None else mended


def rescued(tiling: Tiling) -> Rings | None:
    """Neighbours in the plane where Qhull's triangles do not fit together.

    Parameters
    ----------
    tiling : Tiling
        Points of the plane with as wide a border as can be had.

    Returns
    -------
    Rings or None
        Rings that are proven to be Delaunay's; None where the triangles do not lead to them.
    """
    n, triangles = len(tiling.x), tiling.simplices
    pairs = np.concatenate([triangles[:, [i, j]] for i in range(3) for j in range(3) if i != j])
    point, image = np.unique(pairs[pairs[:, 0] < n], axis=0).T
    if len(np.unique(point)) < n:
        return None
    rings, _ = in_rings(tiling.x, tiling.box, point, *tiling.images(image))
    return _mended(EdgeCheck(tiling.x, tiling.box), rings, range(n))


def _mended(check: EdgeCheck, rings: Rings, start: list[int] | range) -> Rings | None:
    made, _ = in_rings(check.x, check.box, *splay(check.plane, rings, start))
    if not check.corners_turn_left(made):
        return None
    return _proven(check, made, *check.edges(made))


def _proven(check: EdgeCheck, rings: Rings, tie: NDArray[np.bool_], wrong: NDArray[np.bool_]) -> Rings | None:
    """Edges that have a length, if all are Delaunay's and tile the torus."""
    if wrong.any():
        return None
    if tie.any():
        if (np.bincount(rings.point[~tie], minlength=len(check.x)) == 0).any():
            return None
        rings = rings.of(~tie)
        if not check.corners_turn_left(rings):
            return None
    return rings if tiles_once(rings, check.box) else None
