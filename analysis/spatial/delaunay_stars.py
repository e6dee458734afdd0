"""Delaunay edges at the points of a set within a tiling, checked to be those of the torus.

An edge counts where the Voronoi edge (a face in 3D) between its ends has a size: where more than d + 1 points
lie on one empty ball the diagonals are arbitrary, and their Voronoi edges are points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.periodic_delaunay import circumcentre, overhang
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray

IndexArray = NDArray[np.intp]

# A Voronoi edge, or the width of a Voronoi face, below this many spacings counts as none: above what rounding
# makes of cocircular points, below what a random set shows. Circumcentres of thin tetrahedra round more.
SHORTEST_EDGE = 1e-8
NARROWEST_FACE = 1e-6
# Volume of a tetrahedron, over its sides' product, below which it is flat.
FLATTEST = 1e-8


@dataclass(frozen=True)
class Star:
    """Directed Delaunay edges from the points of a set, sorted by point.

    Attributes
    ----------
    indptr : (n + 1,) intp
        Point i owns rows ``indptr[i]:indptr[i + 1]`` of the other two.
    point : (m,) intp
        Start of each edge, a point of the set.
    image : (m,) intp
        End of each edge, a row of the tiling.
    """

    indptr: IndexArray
    point: IndexArray
    image: IndexArray


def star_in_plane(
    tiled: FloatArray, simplices: IndexArray, n: int, h: float, margin: float, box: Sides | None = None
) -> Star | float:
    """Neighbours in the plane as closed cycles around each point, or the margin that is needed.

    Parameters
    ----------
    tiled : (m, d) float64
        The n points of the set, then images of them.
    simplices : (k, d + 1) intp
        Delaunay simplices of the tiling that have a corner among the first n points.
    n : int
        Points of the set.
    h : float
        Spacing n**(-1/d), the unit of the shortest edge.
    margin : float
        Width of the border of images.
    box : tuple of d floats, optional
        Sides of the box; a cube if not given.

    Returns
    -------
    Star or float
        The star; or the margin that is needed, 0 where the star is open and the margin not known.
    """
    corners = np.concatenate([simplices, simplices[:, [1, 2, 0]], simplices[:, [2, 0, 1]]])
    point, first, second = corners[corners[:, 0] < n].T
    a, b = tiled[first] - tiled[point], tiled[second] - tiled[point]
    # Neighbours surround their point, so the angle is the cyclic order and each triangle follows its edge.
    order = np.lexsort((np.arctan2(a[:, 1], a[:, 0]), point))
    point, first, second, a, b = point[order], first[order], second[order], a[order], b[order]
    degree = np.bincount(point, minlength=n)
    if (degree == 0).any():
        return 0.0
    indptr = np.concatenate([[0], np.cumsum(degree)]).astype(np.intp)
    following = np.arange(1, len(point) + 1, dtype=np.intp)
    following[indptr[1:] - 1] = indptr[:-1]
    area = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    if (first[following] != second).any() or (area <= 0).any():
        return 0.0
    centre = circumcentre(a, b)  # from the point
    lacking = overhang(tiled[point] + centre, np.sqrt(np.sum(centre**2, axis=1)), box or 1.0)
    if lacking > margin:
        return lacking
    preceding = np.empty_like(following)
    preceding[following] = np.arange(len(following))
    length = np.sqrt(np.sum((centre - centre[preceding]) ** 2, axis=1))
    return _star(point, first, length > SHORTEST_EDGE * h, n)


def star_in_space(
    tiled: FloatArray, simplices: IndexArray, n: int, h: float, margin: float, box: Sides | None = None
) -> Star | float:
    """Neighbours in space whose Voronoi faces have width, or the margin that is needed.

    Parameters
    ----------
    tiled : (m, d) float64
        The n points of the set, then images of them.
    simplices : (k, d + 1) intp
        Delaunay simplices of the tiling that have a corner among the first n points.
    n : int
        Points of the set.
    h : float
        Spacing n**(-1/d), the unit of the shortest edge.
    margin : float
        Width of the border of images.
    box : tuple of d floats, optional
        Sides of the box; a cube if not given.

    Returns
    -------
    Star or float
        The star; or the margin that is needed, 0 where the star is open and the margin not known.
    """
    if len(np.unique(simplices[simplices < n])) < n:
        return 0.0
    origin = tiled[simplices[:, 0]]
    sides = tiled[simplices[:, 1:]] - origin[:, None]
    # Flat tetrahedra come from points on one sphere; their centre is that of the tetrahedra beside them.
    solid = np.abs(np.linalg.det(sides)) > FLATTEST * np.prod(np.sqrt(np.sum(sides**2, axis=2)), axis=1)
    simplices, origin, sides = simplices[solid], origin[solid], sides[solid]
    centre = np.linalg.solve(2 * sides, np.sum(sides**2, axis=2)[..., None])[..., 0]
    lacking = overhang(origin + centre, np.sqrt(np.sum(centre**2, axis=1)), box or 1.0)
    if lacking > margin:
        return lacking
    pairs = np.array([(i, j) for i in range(4) for j in range(4) if i != j])
    point, image = simplices[:, pairs].reshape(-1, 2).T
    corner = np.repeat(origin + centre, len(pairs), axis=0)[point < n]
    point, image = point[point < n], image[point < n]
    order = np.lexsort((image, point))
    point, image, corner = point[order], image[order], corner[order]
    start = np.flatnonzero(np.r_[True, (np.diff(point) != 0) | (np.diff(image) != 0)])
    count = np.diff(np.r_[start, len(point)])
    corner = corner - np.repeat(np.add.reduceat(corner, start) / count[:, None], count, axis=0)
    moment = np.add.reduceat(corner[:, :, None] * corner[:, None, :], start)
    trace = np.trace(moment, axis1=1, axis2=2)
    # A flat face has two moments: this is their product, and over their sum it is the width squared.
    product = (trace**2 - np.sum(moment**2, axis=(1, 2))) / 2
    return _star(point[start], image[start], product > (NARROWEST_FACE * h) ** 2 * trace, n)


def _star(point: IndexArray, image: IndexArray, keep: NDArray[np.bool_], n: int) -> Star:
    """Drop the edges whose Voronoi edge or face has no size."""
    point, image = point[keep], image[keep]
    indptr = np.concatenate([[0], np.cumsum(np.bincount(point, minlength=n))]).astype(np.intp)
    return Star(indptr, point, image)
