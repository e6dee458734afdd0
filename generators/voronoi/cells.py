"""Volumes, centroids and energies of toroidal Voronoi cells, exact but for rounding (Du et al. 1999)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.periodic_delaunay import (
    circumcentre,
    overhang,
    triangulation,
    with_images,
)
from gbnbench.core.torus import FloatArray, spacing, wrap
from gbnbench.generators.voronoi.cell_simplices import COINCIDENT, face_fans, segments
from gbnbench.generators.voronoi.flags import cell_moments, circumcentres, flattest

FLAT = 1e-8  # d! volume / side**d of a simplex below which its circumcentre is not to be trusted


@dataclass(frozen=True)
class Cells:
    """Voronoi cells of n points on the unit torus.

    Attributes
    ----------
    volume : (n,) float64
        They sum to 1.
    offset : (n, d) float64
        Centroid of each cell, from its point; not wrapped.
    energy : (n,) float64
        Integral of |y - x|**2 over each cell; their sum is what Lloyd's method lowers.
    reach : float
        Width of the border whose images may touch the cells.
    """

    volume: FloatArray
    offset: FloatArray
    energy: FloatArray
    reach: float


def toroidal_cells(x: FloatArray, margin: float | None = None) -> Cells:
    """Voronoi cells of points on the torus, in one to four dimensions.

    Parameters
    ----------
    x : (n, d) float64
        Distinct points in [0, 1)^d, d <= 4.
    margin : float, optional
        First guess of the border of images, in units of length; the answer does not depend on it.

    Returns
    -------
    Cells
        Exact to rounding; in 4D to 1e-4 of a cell where Delaunay's simplices are flat, as in a lattice.

    Raises
    ------
    RefusalError
        If d > 4.
    InputError
        If two points coincide.

    Notes
    -----
    The points are surrounded by a border of their images. A cell is proven right if, for each of its
    vertices v at distance r from its point, the ball of radius r about v stays inside the tiled box, for
    then no image left out can be nearer to v (``gbnbench.core.periodic_delaunay``). Otherwise the border is
    widened; a border of 1 needs no check (Dolbilin & Huson 1997). Cells are cut into simplices with their
    apex at the point: in 2D a triangle for each side, from 3D on one for each flag of Delaunay's simplices
    (``gbnbench.generators.voronoi.flags``). Where some of these are flat, it is a fan over each face in 3D,
    and in 4D the flags after every point and image has been moved by some 1e-5 spacings.

    References
    ----------
    Du, Faber & Gunzburger, "Centroidal Voronoi tessellations", SIAM Review 41(4), 1999. Dolbilin & Huson,
    "Periodic Delone tilings", Periodica Mathematica Hungarica 34, 1997.

    Examples
    --------
    >>> toroidal_cells(np.array([[0.1], [0.3], [0.5]])).volume.round(12).tolist()
    [0.4, 0.2, 0.4]
    """
    n, d = x.shape
    if d > 4:
        raise RefusalError(f"d must be 1, 2, 3 or 4 for Voronoi cells; got d={d}")
    if d == 1:
        return _moments(x, *segments(x))
    margin = min(1.0, 4.0 * spacing(n, d) if margin is None else margin)
    noise = 0.0
    while True:
        try:
            cells = _by_triangles(x, margin) if d == 2 else _by_flags(x, margin, noise)
        except np.linalg.LinAlgError:  # flat simplices
            if len(np.unique(x, axis=0)) < n:
                raise InputError(COINCIDENT) from None
            if d == 4 and noise < 1e-3:
                noise = max(10 * noise, 1e-5)
                continue
            fans = face_fans(x, margin)
            cells = None if fans is None else _moments(x, *fans)
        if cells is None and margin >= 1:
            raise InputError(COINCIDENT)
        if cells is not None and (margin >= 1 or cells.reach <= margin):
            if not (cells.volume > 0).all():
                raise InputError(COINCIDENT)
            return cells
        margin, noise = min(1.0, 2 * margin if cells is None else 1.01 * cells.reach), 0.0


def _by_flags(x: FloatArray, margin: float, noise: float) -> Cells | None:
    """Sum over the flags of simplices, of points moved by so many spacings; LinAlgError where one is flat."""
    n, d = x.shape
    tiled, _ = with_images(x, margin)
    if noise > 0:
        tiled += noise * spacing(n, d) * np.random.default_rng(0).normal(size=tiled.shape)
    mesh = triangulation(tiled)
    if mesh is None:
        return None
    inner = mesh.simplices < n
    # A point of ours is open if a facet without a neighbour has it among its corners.
    ours = inner.sum(axis=1, keepdims=True)
    if ((mesh.neighbors < 0) & (ours > inner)).any():
        return None
    simplices = mesh.simplices[ours[:, 0] > 0].astype(np.intp)
    corners = tiled[simplices]
    if flattest(corners) < FLAT:
        raise np.linalg.LinAlgError("flat simplices")
    volume, first, second = cell_moments(tiled, simplices, n)
    centre = circumcentres(corners)
    reach = overhang(centre, np.sqrt(np.sum((centre - corners[:, 0]) ** 2, axis=1)))
    with np.errstate(divide="ignore", invalid="ignore"):
        return Cells(volume, first / volume[:, None], second, reach)


def _by_triangles(x: FloatArray, margin: float) -> Cells | None:
    """Cut cells in 2D into a triangle for each side, which joins the circumcentres beside a Delaunay edge."""
    n = len(x)
    tiled, _ = with_images(x, margin)
    mesh = triangulation(tiled)
    if mesh is None:
        return None
    corner = tiled[mesh.simplices]
    # A flat triangle on the tiling's rim has no centre, and bounds no cell.
    centre = corner[:, 0] + circumcentre(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    # Triangles run counterclockwise, so each edge a -> b is met once with its triangle on the left.
    own = np.flatnonzero(mesh.simplices[:, [1, 2, 0]] < n)
    left, opposite = np.divmod(own, 3)
    site, right = mesh.simplices[left, (opposite + 1) % 3].astype(np.intp), mesh.neighbors[left, opposite]
    if (right < 0).any() or not np.bincount(site, minlength=n).all():
        return None
    # The coordinates apart, as arrays of their own: sums over an axis of two are many times slower. The
    # area of a triangle is signed, so that a side whose Delaunay edge does not cross it counts right too.
    place = np.ascontiguousarray(x.T)
    px, py = (centre[right, k] - place[k, site] for k in range(2))
    qx, qy = (centre[left, k] - place[k, site] for k in range(2))
    area = (px * qy - py * qx) / 2
    tx, ty = px + qx, py + qy
    volume = np.asarray(np.bincount(site, area, n), dtype=np.float64)
    if not (volume > 0).all():
        raise InputError(COINCIDENT)
    first = np.stack([np.bincount(site, area * total, n) for total in (tx, ty)], axis=1) / 3
    radius = qx * qx + qy * qy
    squares = px * px + py * py + radius + tx * tx + ty * ty
    second: FloatArray = np.bincount(site, area * squares, n) / 12
    # Each vertex is the centre of a triangle on the left of a side, met from one of its points.
    reach = overhang(centre[left], np.sqrt(radius))
    return Cells(volume, first / volume[:, None], second, reach)


def _moments(x: FloatArray, site: NDArray[np.intp], rays: FloatArray) -> Cells:
    """Volumes, centroids and energies of cells from the simplices they were cut into.

    Parameters
    ----------
    x : (n, d) float64
        The points.
    site : (m,) intp
        Index of the point at the apex of each simplex.
    rays : (m, d, d) float64
        Other corners of each simplex, from its apex, in any order: convex cells hold their point.
    """
    n, d = x.shape
    volume: FloatArray = np.abs(np.linalg.det(rays)) / math.factorial(d)
    total = rays.sum(axis=1)
    squares = np.sum(rays * rays, axis=(1, 2)) + np.sum(total * total, axis=1)
    cell = np.asarray(np.bincount(site, volume, n), dtype=np.float64)
    first = np.stack([np.bincount(site, volume * total[:, k], n) for k in range(d)], axis=1) / (d + 1)
    second: FloatArray = np.bincount(site, volume * squares, n) / ((d + 1) * (d + 2))
    if not (cell > 0).all():
        raise InputError(COINCIDENT)
    radius = np.sqrt(np.sum(rays * rays, axis=2))
    return Cells(cell, first / cell[:, None], second, overhang(x[site][:, None] + rays, radius))


def move_to_centroids(x: FloatArray, cells: Cells) -> FloatArray:
    """Move each point to its cell's centroid, back on the torus: one step of Lloyd's method.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus.
    cells : Cells
        Their Voronoi cells.

    Returns
    -------
    (n, d) float64
        The centroids.
    """
    return wrap(x + cells.offset)
