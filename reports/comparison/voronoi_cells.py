"""Voronoi cells of a periodic set in the plane, with their numbers of sides."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import RefusalError
from gbnbench.core.periodic_delaunay import (
    copies,
    images_in_box,
    overhang,
    voronoi_diagram,
    with_images,
)
from gbnbench.core.sides import Sides, positions
from gbnbench.core.torus import FloatArray, spacing

SHORTEST_EDGE = 1e-8  # spacings; a side below is none, as where four points lie on one circle
TWO_RINGS = np.mgrid[-2.0:3.0, -2.0:3.0].reshape(2, -1).T


def cells(
    x: FloatArray, side: float = 1.0, sides: Sides | None = None
) -> tuple[list[FloatArray], NDArray[np.intp]]:
    """Voronoi cells of the periodic set that touch the corner [0, side]^2, with their numbers of sides.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.
    side : float
        Share of each side of the torus that is drawn, a corner.
    sides : (float, float), optional
        Sides of the torus, of area 1; a square if not given.

    Returns
    -------
    polygons : list of (m, 2) float64
        Corners of each cell, in the unit of the sides; cells of images of a point repeat its degree.
    degrees : (cells,) intp
        Sides of each cell that have length: its neighbours as the table's valence counts them, so that a
        square grid has four.

    Notes
    -----
    A cell is the periodic one if every empty circle around its corners lies within the images that were
    added (``overhang``). Where a narrow border does not suffice a 5 x 5 tiling does: no empty circle is as
    wide.

    Raises
    ------
    RefusalError
        If the points span no plane.
    """
    unit = spacing(len(x), 2)
    near = min(2.5 * unit, 1.0)
    corner = side * np.array(sides or (1.0, 1.0))
    widest = 1.0 if sides is None else 2 * math.hypot(*sides)
    placed = positions(x, sides)
    for margin in sorted({min(8 * unit, widest), widest}):
        if sides is not None:
            tiled, _ = images_in_box(placed, sides, margin)
        else:
            tiled, _ = with_images(x, margin) if margin < 1.0 else copies(x, TWO_RINGS)
        if side < 1.0:
            tiled = tiled[np.all(tiled <= corner + margin, axis=1)]
        diagram = voronoi_diagram(tiled)
        if diagram is None:
            raise RefusalError("these points have no Voronoi diagram")
        near_box = np.flatnonzero(np.all((tiled >= -near) & (tiled <= corner + near), axis=1))
        near_box = near_box[diagram.point_region[near_box] >= 0]  # the twin of a coincident point has no cell
        regions = [diagram.regions[region] for region in diagram.point_region[near_box]]
        drawn = np.array([len(region) >= 3 and -1 not in region for region in regions])
        inside = np.all((tiled[near_box] >= 0) & (tiled[near_box] < corner), axis=1)
        closed = [region for region, good in zip(regions, drawn, strict=True) if good]
        corners_of = np.array([len(region) for region in closed], dtype=np.intp)
        start = np.concatenate([[0], np.cumsum(corners_of)[:-1]])
        corners = diagram.vertices[np.concatenate([np.array(region) for region in closed])]
        following = np.arange(1, len(corners) + 1)
        following[start + corners_of - 1] = start
        edge = np.hypot(*(corners - corners[following]).T)
        radius = np.hypot(*(corners - np.repeat(tiled[near_box[drawn]], corners_of, axis=0)).T)
        bounding = np.repeat(inside[drawn], corners_of)  # corners of the cells whose points lie in the square
        if (
            not np.any(inside & ~drawn)
            and overhang(corners[bounding], radius[bounding], tuple(corner.tolist())) <= margin
        ):
            break
    degrees = np.add.reduceat(np.asarray(edge > SHORTEST_EDGE * unit, dtype=np.intp), start)
    return np.split(corners, start[1:]), degrees
