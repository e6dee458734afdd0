"""Toroidal Voronoi cells cut into simplices with an apex at the point: segments in 1D, tetrahedra in 3D."""

from __future__ import annotations

from itertools import chain

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.periodic_delaunay import voronoi_diagram, with_images
from gbnbench.core.torus import FloatArray

COINCIDENT = "x must hold distinct points for Voronoi cells; at least two coincide"


def segments(x: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
    """Cut cells in 1D into two segments each, from the point to either midpoint.

    Parameters
    ----------
    x : (n, 1) float64
        Points on the unit torus.

    Returns
    -------
    site : (2 n,) intp
        Index of the point at one end of each segment.
    rays : (2 n, 1, 1) float64
        The other end, from that point.

    Raises
    ------
    InputError
        If two points coincide.
    """
    order = np.argsort(x[:, 0])
    half = np.diff(x[order, 0], append=x[order[0], 0] + 1) / 2
    if not (half > 0).all():
        raise InputError(COINCIDENT)
    return np.concatenate([order, order]), np.concatenate([half, -np.roll(half, 1)])[:, None, None]


def face_fans(x: FloatArray, margin: float) -> tuple[NDArray[np.intp], FloatArray] | None:
    """Cut cells in 3D into a fan of tetrahedra over each face, the same for the points on both its sides.

    Parameters
    ----------
    x : (n, 3) float64
        Points on the unit torus.
    margin : float
        Width of the border of images.

    Returns
    -------
    (site, rays) or None
        The index of the point at the apex of each tetrahedron, (m,) intp, and its other corners from there,
        (m, 3, 3) float64; None where the border is too narrow to close every cell.
    """
    tiled, _ = with_images(x, margin)
    diagram = voronoi_diagram(tiled)
    if diagram is None:
        return None
    inner = np.flatnonzero(diagram.ridge_points.min(axis=1) < len(x))
    faces = [diagram.ridge_vertices[i] for i in inner]
    corners = np.fromiter(chain.from_iterable(faces), dtype=np.intp)
    if (corners < 0).any():
        return None
    count = np.array([len(face) for face in faces], dtype=np.intp)
    first = np.cumsum(count) - count
    face = np.repeat(np.arange(len(faces)), count - 2)
    start = np.cumsum(count - 2) - (count - 2)
    second = first[face] + 1 + np.arange(len(face)) - start[face]
    fan = diagram.vertices[np.stack([corners[first[face]], corners[second], corners[second + 1]], axis=1)]
    pair = diagram.ridge_points[inner[face]]
    site, fan = pair.T.reshape(-1).astype(np.intp), np.concatenate([fan, fan])
    own = site < len(x)
    site, fan = site[own], fan[own]
    if len(np.unique(site)) < len(x):
        return None
    return site, fan - x[site][:, None]
