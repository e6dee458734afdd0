"""Proof that rings of neighbours tile the torus once with convex faces.

Rings whose corners turn left once around each point, and whose edges are seen from both ends, are a surface
without border; its faces turn once each if points - edges + faces = 0, and it covers the torus once if its
area is that of the torus. If all edges are Delaunay's then, no point lies in the circle of any face.
"""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.spatial.plane_rings import IndexArray, Rings
from gbnbench.core.periodic_delaunay import circumcentre
from gbnbench.core.torus import FloatArray

AREA_ERROR = 1e-3  # a second cover would add 1; kites of flat triangles cancel


def tiles_once(rings: Rings, box: FloatArray) -> bool:
    """Tell whether rings, whose corners turn left, tile the torus once.

    Parameters
    ----------
    rings : Rings
        Edges of the plane.
    box : (2,) float64
        Sides of the torus.

    Returns
    -------
    bool
        False also where an edge is seen from one end only.
    """
    if (rings.twin < 0).any():
        return False
    rows = np.arange(len(rings.point))
    after = rings.preceding[rings.twin]  # along the face to the left
    second = after[after]
    threefold = after[second] == rows
    once = np.flatnonzero(threefold & (rows < after) & (rows < second))
    if (rings.turn[once] + rings.turn[after[once]] + rings.turn[second[once]]).any():
        return False
    rest = np.flatnonzero(~threefold)
    others = _closed_faces(rings, rest, after)
    if others is None or 2 * (len(rings.indptr) - 1 + len(once) + others) != len(rows):
        return False
    a, b = rings.vector[once], rings.vector[rings.following[once]]
    area = np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    a, b = rings.vector[rest], rings.vector[rings.following[rest]]
    centre = circumcentre(a, b)
    # The share of a face that is nearest to this corner: a kite between the midpoints of its two edges.
    area += np.sum((a[:, 0] - b[:, 0]) * centre[:, 1] - (a[:, 1] - b[:, 1]) * centre[:, 0]) / 4
    return bool(abs(area / np.prod(box) - 1) < AREA_ERROR)


def _closed_faces(rings: Rings, rows: IndexArray, after: IndexArray) -> int | None:
    """Count the faces that are no triangles, from the rows of their edges; None where one does not close."""
    if not len(rows):
        return 0
    number = np.empty_like(after)
    number[rows] = np.arange(len(rows))
    count, label = _cycles(number[after[rows]])
    for axis in range(2):
        if np.bincount(label, rings.turn[rows, axis], minlength=count).any():
            return None
    return count


def _cycles(following: IndexArray) -> tuple[int, IndexArray]:
    """Count the cycles of a permutation, and say of which each entry is part."""
    least, ahead = np.arange(len(following)), following
    while (least != least[following]).any():  # each round sees twice as far along the cycles
        least, ahead = np.minimum(least, least[ahead]), ahead[ahead]
    first, label = np.unique(least, return_inverse=True)
    return len(first), label
