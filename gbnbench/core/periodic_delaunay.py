"""Delaunay triangulations and Voronoi diagrams on the torus, by images of the points (Dolbilin & Huson 1997).

A set is tiled by images of its points as far as a margin round the unit box, and Qhull treats the tiling as
points of space. Triangles and cells are those of the torus if their empty balls lie inside the tiled box
(``overhang``), for then no image left out could change them. Where one does not, the caller widens the margin
and tries again.

References
----------
Dolbilin & Huson, "Periodic Delone tilings", Periodica Mathematica Hungarica 34, 1997. Caroli & Teillaud,
"Computing 3D periodic triangulations", European Symposium on Algorithms, 2009.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    from scipy.spatial import Delaunay, Voronoi


def with_images(x: FloatArray, margin: float) -> tuple[FloatArray, NDArray[np.intp]]:
    """Append to one point set the periodic images that lie within margin of the unit box.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    margin : float
        Width of the border, in (0, 1].

    Returns
    -------
    tiled : (m, d) float64
        The n points first, then their images in [-margin, 1 + margin)^d.
    owner : (m,) intp
        Index in x of which each row is an image.
    """
    tiled, owner = x, np.arange(len(x), dtype=np.intp)
    for axis in range(x.shape[1]):
        low, high = tiled[:, axis] < margin, tiled[:, axis] >= 1 - margin
        step = np.zeros(x.shape[1])
        step[axis] = 1.0
        tiled = np.concatenate([tiled, tiled[low] + step, tiled[high] - step])
        owner = np.concatenate([owner, owner[low], owner[high]])
    return tiled, owner


def images_in_box(x: FloatArray, sides: Sides, margin: float) -> tuple[FloatArray, NDArray[np.intp]]:
    """Append to one point set of a box the periodic images that lie within margin of it, however far.

    Parameters
    ----------
    x : (n, d) float64
        Positions in [0, s_a) on each axis.
    sides : tuple of d floats
        Sides of the box.
    margin : float
        Width of the border, in the unit of the sides.

    Returns
    -------
    tiled : (m, d) float64
        The n points first, then their images in [-margin, s_a + margin).
    owner : (m,) intp
        Index in x of which each row is an image.
    """
    tiled, owner = x, np.arange(len(x), dtype=np.intp)
    for axis, side in enumerate(sides):
        rows, owners = [tiled], [owner]
        for ring in range(1, math.ceil(margin / side) + 1):
            for shift in (ring * side, -ring * side):
                moved = tiled[:, axis] + shift
                near = (moved >= -margin) & (moved < side + margin)
                image = tiled[near]
                image[:, axis] = moved[near]
                rows.append(image)
                owners.append(owner[near])
        tiled, owner = np.concatenate(rows), np.concatenate(owners)
    return tiled, owner


def copies(x: FloatArray, shifts: Iterable[ArrayLike]) -> tuple[FloatArray, NDArray[np.intp]]:
    """Repeat a whole set at given shifts, as where a margin of 1 is not enough.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    shifts : iterable of (d,) array_like
        Whole numbers of boxes.

    Returns
    -------
    tiled : (shifts * n, d) float64
        One copy of the set after the other.
    owner : (shifts * n,) intp
        Index in x of which each row is an image.
    """
    tiled = np.concatenate([x + np.asarray(shift) for shift in shifts])
    return tiled, np.tile(np.arange(len(x), dtype=np.intp), len(tiled) // len(x))


def overhang(centre: FloatArray, radius: FloatArray, side: float | Sides = 1.0) -> float:
    """Distance by which balls stick out of the box from 0 to side: the margin that proves them empty.

    Parameters
    ----------
    centre : (..., d) float64
        Circumcentres, or Voronoi vertices.
    radius : (...) float64
        Their distances to the nearest points of the tiling.
    side : float or tuple of d floats
        Side of a cube, or sides of a box.

    Returns
    -------
    float
        Largest over all balls, negative where all lie well inside; -inf where there are none.
    """
    sides = np.broadcast_to(np.asarray(side, dtype=np.float64), centre.shape[-1:])
    along = [np.maximum(-centre[..., k], centre[..., k] - s) for k, s in enumerate(sides)]
    beyond = functools.reduce(np.maximum, along) + radius
    return float(beyond.max(initial=-np.inf))


def circumcentre(a: FloatArray, b: FloatArray) -> FloatArray:
    """Circumcentres of triangles, from their common corner: solves 2 a.c = |a|^2 and 2 b.c = |b|^2.

    Parameters
    ----------
    a, b : (m, 2) float64
        Sides from that corner to the other two.

    Returns
    -------
    (m, 2) float64
        Infinite or nan for flat triangles.
    """
    (ax, ay), (bx, by) = a.T, b.T
    aa, bb = ax * ax + ay * ay, bx * bx + by * by
    double_area = ax * by - ay * bx
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = 2 * double_area
        return np.stack([(by * aa - ay * bb) / factor, (ax * bb - bx * aa) / factor], axis=1)


def triangulation(tiled: FloatArray) -> Delaunay | None:
    """Delaunay triangulation by Qhull, None where the points do not span the space."""
    from scipy.spatial import Delaunay, QhullError

    try:
        return Delaunay(tiled)
    except QhullError:  # too few images, or all on one line or plane
        return None


def voronoi_diagram(tiled: FloatArray) -> Voronoi | None:
    """Voronoi diagram by Qhull, None where the points do not span the space."""
    from scipy.spatial import QhullError, Voronoi

    try:
        return Voronoi(tiled)
    except QhullError:  # too few images, or all on one line or plane
        return None
