"""Delaunay triangulation on the flat 2-torus as half-edges, and the farthest point from a set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.periodic_delaunay import circumcentre, triangulation, with_images
from gbnbench.core.torus import FloatArray, wrap

if TYPE_CHECKING:
    from scipy.spatial import Delaunay

# If every circumradius is below this, triangles of the unit torus have distinct corners and distinct
# edges (Caroli & Teillaud 2009), and corners are less than 1/2 apart, so that the nearest image is right.
WIDEST = 0.25


@dataclass(frozen=True)
class Triangulation:
    """A periodic Delaunay triangulation as half-edges; triangle t owns 4 t, 4 t + 1 and 4 t + 2.

    Attributes
    ----------
    origin : (8 n,) int32
        Vertex that each half-edge leaves, counter-clockwise in its triangle; -1 in every fourth place.
    twin : (8 n,) int32
        The same edge seen from the other triangle; -1 in every fourth place.
    leaving : (n,) int32
        A half-edge that leaves each vertex.
    centre : (2 n, 2) float64
        Circumcentres on the torus.
    squared_radius : (2 n,) float64
        Squared circumradii.
    """

    origin: NDArray[np.int32]
    twin: NDArray[np.int32]
    leaving: NDArray[np.int32]
    centre: FloatArray
    squared_radius: FloatArray


def circumcircles(a: FloatArray, b: FloatArray, c: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Circumcircles of triangles.

    Parameters
    ----------
    a, b, c : (m, 2) float64
        Their corners.

    Returns
    -------
    centre : (m, 2) float64
        Circumcentres, not brought back on the torus.
    squared : (m,) float64
        Squared radii; infinite for flat triangles.
    """
    offset = circumcentre(b - a, c - a)
    squared = np.sum(offset * offset, axis=1)
    return a + offset, np.where(np.isfinite(squared), squared, np.inf)


def farthest_point(x: FloatArray) -> tuple[FloatArray, float]:
    """Centre and radius of the largest empty circle on the torus, from a fresh Delaunay triangulation.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus, n >= 1.

    Returns
    -------
    centre : (2,) float64
        The point of the torus farthest from x, in [0, 1).
    radius : float
        Its distance to x.
    """
    # Images within a narrow margin suffice where nothing in the box is farther from them than that margin. No
    # circle is larger than sqrt(1/2), so a margin of 1 always does.
    for margin in (min(1.0, 4 / np.sqrt(len(x))), 1.0):
        tiled, _ = with_images(x, margin)
        mesh = triangulation(tiled)
        if mesh is None:  # the points of a narrow margin may all lie on one line
            continue
        triangles = tiled[mesh.simplices]
        centre, squared = circumcircles(*np.moveaxis(triangles, 1, 0))
        if margin == 1 or _covers_box(mesh, triangles, squared, margin):
            break
    in_box = np.all((centre >= -1e-9) & (centre < 1 + 1e-9), axis=1) & (squared < 0.75)
    best = int(np.argmax(np.where(in_box, squared, -1.0)))
    return wrap(centre[best]), float(np.sqrt(squared[best]))


def _covers_box(mesh: Delaunay, triangles: FloatArray, squared: FloatArray, margin: float) -> bool:
    """Tell whether triangles cover the unit box, and none that touches it has a radius beyond the margin.

    A point of a triangle is never farther from its nearest corner than the circumradius.
    """
    touches = np.all((triangles.min(axis=1) <= 1) & (triangles.max(axis=1) >= 0), axis=1)
    if np.any(squared[touches] > margin * margin):
        return False
    tiled = mesh.points
    start, end = tiled[mesh.convex_hull[:, 0]], tiled[mesh.convex_hull[:, 1]]
    normal = (end - start)[:, ::-1] * (1, -1)
    normal *= np.sign(np.sum((start - tiled.mean(axis=0)) * normal, axis=1))[:, None]  # outwards
    box = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]])
    return bool(np.all(normal @ box.T <= np.sum(normal * start, axis=1)[:, None]))


def triangulate(x: FloatArray) -> Triangulation | None:
    """Triangulate a set whose empty circles are small, or return None.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.

    Returns
    -------
    Triangulation or None
        None where a circumradius reaches ``WIDEST``, as for n < 7 and wherever gaps are large, or where
        cocircular points were split differently in two images.
    """
    n = len(x)
    margin = min(2 * WIDEST, 8 / np.sqrt(n))  # twice the largest radius, so that kept triangles are whole
    tiled, owner = with_images(x, margin)
    mesh = triangulation(tiled)
    if mesh is None:
        return None
    corners = np.asarray(mesh.simplices, dtype=np.intp)
    a, b, c = (tiled[corners[:, k]] for k in range(3))
    ab, ac = b - a, c - a
    clockwise = ab[:, 0] * ac[:, 1] < ab[:, 1] * ac[:, 0]
    corners[clockwise] = corners[clockwise][:, [0, 2, 1]]
    # Of the images of a triangle, keep the one whose corner of lowest owner is no image.
    lowest = corners[np.arange(len(corners)), np.argmin(owner[corners], axis=1)]
    corners = corners[lowest < n]
    centre, squared = circumcircles(*(tiled[corners[:, k]] for k in range(3)))
    if len(corners) != 2 * n or not np.all(squared < (margin / 2) ** 2):
        return None
    vertex = owner[corners]
    forward = (vertex * n + np.roll(vertex, -1, axis=1)).ravel()
    backward = (np.roll(vertex, -1, axis=1) * n + vertex).ravel()
    order = np.argsort(forward)
    match = order[np.minimum(np.searchsorted(forward, backward, sorter=order), len(order) - 1)]
    if not np.array_equal(forward[match], backward):
        return None
    half_edge = 4 * (np.arange(6 * n) // 3) + np.arange(6 * n) % 3
    origin, twin = (np.full(8 * n, -1, dtype=np.int32) for _ in range(2))
    origin[half_edge] = vertex.ravel()
    twin[half_edge] = half_edge[match]
    leaving = np.empty(n, dtype=np.int32)
    leaving[vertex.ravel()] = half_edge
    return Triangulation(origin, twin, leaving, wrap(centre), squared)
