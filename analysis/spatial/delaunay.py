"""Delaunay neighbours of every point of a set on the torus, in two and three dimensions."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.analysis.spatial.delaunay_plane import rescued, star_in_plane
from gbnbench.analysis.spatial.delaunay_space import star_in_space
from gbnbench.analysis.spatial.delaunay_tiling import Tiling
from gbnbench.analysis.spatial.plane_rings import IndexArray, Rings
from gbnbench.core.errors import RefusalError
from gbnbench.core.periodic_delaunay import copies, images_in_box, triangulation, with_images
from gbnbench.core.sides import Sides, as_sides, positions
from gbnbench.core.torus import FloatArray, as_realizations, spacing

# The torus holds the integer lattice of each point, so no empty ball is wider than sqrt(3): two rings of
# images reach every neighbour of a point, whatever the set. In a box it is the diagonal.
WIDEST_MARGIN = 2.0


@dataclass(frozen=True)
class Neighbours:
    """Delaunay neighbours of every point of one set on the torus.

    Attributes
    ----------
    indptr : (n + 1,) intp
        Point i owns rows ``indptr[i]:indptr[i + 1]`` of the other two.
    index : (m,) intp
        The neighbouring points; an image of the point itself carries its own index.
    vector : (m, d) float64
        From the point to that neighbour, the shortest way the triangulation takes; in 2D in counterclockwise
        cyclic order. In sides of the cube; where sides are unequal the box has volume 1.
    """

    indptr: IndexArray
    index: IndexArray
    vector: FloatArray

    @property
    def degree(self) -> IndexArray:
        """Number of neighbours of each point: (n,) intp."""
        return np.diff(self.indptr)

    def sum_over_points(self, values: NDArray[Any]) -> NDArray[Any]:
        """Sum per point of one value a neighbour: (m,) -> (n,)."""
        return np.add.reduceat(values, self.indptr[:-1])


def neighbours(x: ArrayLike, sides: ArrayLike | None = None) -> tuple[Neighbours, ...]:
    """Delaunay neighbours of each set; valence, psi6 and bond order share them.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, d = 2 or 3.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    tuple of Neighbours
        One a realization.

    Raises
    ------
    InputError
        If sides are not d lengths.
    RefusalError
        If d is not 2 or 3, or two points of a set coincide or are too near for Qhull's doubles.

    Notes
    -----
    Two points are neighbours where their Voronoi cells on the torus share an edge (a face in 3D) that has
    length: this is the Delaunay triangulation wherever that is unique, so the mean degree in 2D is 6. Where
    more than three points lie on one empty circle the diagonals are arbitrary and none counts: a square grid
    has degree 4. One point may be the neighbour of another, or of itself, through several images, and each
    counts: a single point has four neighbours, its own images.

    The set is triangulated with a border of its images. The border is proven wide enough where the
    circumscribed ball of every triangle at a point of the set lies inside it, for then no other image could
    change these triangles (``gbnbench.core.periodic_delaunay``). Else it is widened and the set triangulated
    again. In the plane every edge is then checked with a certain sign, and mended where Qhull's rounding made
    it wrong; in space such a set is refused.

    Examples
    --------
    >>> float(neighbours([[0.1, 0.2], [0.6, 0.3], [0.4, 0.8]])[0].degree.mean())
    6.0
    """
    sets = as_realizations(x)
    d = sets.shape[2]
    if d == 1:
        raise RefusalError("Delaunay neighbours say nothing in d = 1: every point has two; use d = 2 or 3")
    if d > 3:
        raise RefusalError(
            f"Delaunay neighbours are made in d = 2 and 3; got d={d}, where they grow too many"
        )
    lengths = as_sides(sides, d)
    return tuple(_triangulate(points, lengths) for points in sets)


def as_neighbours(
    x: ArrayLike | Sequence[Neighbours], sides: ArrayLike | None = None
) -> Sequence[Neighbours]:
    """Return neighbours as they are, and compute those of points.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64, or what ``neighbours`` returned
        Points on the unit torus.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, for points; a cube if not given.

    Returns
    -------
    sequence of Neighbours
        One a realization.
    """
    if isinstance(x, (tuple, list)) and x and all(isinstance(item, Neighbours) for item in x):
        return cast("Sequence[Neighbours]", x)
    return neighbours(x, sides)  # type: ignore[arg-type]


def plane_neighbours(
    x: ArrayLike | Sequence[Neighbours], measure: str, sides: ArrayLike | None = None
) -> Sequence[Neighbours]:
    """Neighbours for a measure of the plane, which is refused by name elsewhere.

    Parameters
    ----------
    x : (n, 2) or (realizations, n, 2) float64, or what ``neighbours`` returned
        Points on the unit torus.
    measure : str
        Name of the measure, for the message.
    sides : (2,) array_like, optional
        Lengths of the torus's sides, for points; a square if not given.

    Returns
    -------
    sequence of Neighbours
        One a realization.

    Raises
    ------
    RefusalError
        If d is not 2, or two points of a set coincide.
    """
    made = as_neighbours(x, sides)
    d = made[0].vector.shape[1]
    if d != 2:
        raise RefusalError(f"{measure} is defined in the plane; got d={d}")
    return made


def _triangulate(x: FloatArray, sides: Sides | None) -> Neighbours:
    n, d = x.shape
    h = spacing(n, d)
    order = np.lexsort(x.T)
    if (np.diff(x[order], axis=0) == 0).all(axis=1).any():
        raise RefusalError(f"Delaunay neighbours need distinct points; some of these n={n} coincide")
    placed, box = positions(x, sides), np.array(sides or (1.0,) * d)
    star_of = star_in_plane if d == 2 else star_in_space
    widest = most = 2 * math.hypot(*sides) if sides else WIDEST_MARGIN
    if sides is None:
        most = 1.0  # one ring of images
    margin = 3 * h if 3 * h < most else widest
    while True:
        place, owner = _tile(placed, margin) if sides is None else images_in_box(placed, sides, margin)
        simplices = _inner_simplices(place, n)
        star: Rings | float | None = 0.0
        if simplices is not None:
            tiling = Tiling(x, box, place, owner, margin, *simplices)
            star = star_of(tiling)
            if d == 2 and star == 0.0 and margin >= widest:
                star = rescued(tiling)
        if isinstance(star, Rings):
            return Neighbours(star.indptr, star.index, star.vector)
        if margin >= widest:
            raise RefusalError(
                f"Delaunay neighbours need points apart; some of these n={n} are too near for doubles"
            )
        wider = max(1.5 * margin, star or 0.0)
        margin = wider if wider < most else widest


def _tile(x: FloatArray, margin: float) -> tuple[FloatArray, IndexArray]:
    """Points and their images to margin; beyond one ring, all of two rings, the set itself first."""
    if margin <= 1:
        return with_images(x, margin)
    shifts = sorted(itertools.product((0, 1, -1, 2, -2), repeat=x.shape[1]), key=any)
    return copies(x, shifts)


def _inner_simplices(tiled: FloatArray, n: int) -> tuple[IndexArray, IndexArray] | None:
    """List the simplices at the first n points, with the corners beyond their facets.

    None where the tiling spans no space, and empty lists where one of the points lies on the hull or Qhull
    lost a point to rounding: more images are needed.
    """
    mesh = triangulation(tiled)
    if mesh is None:
        return None
    simplices = mesh.simplices.astype(np.intp)
    if len(mesh.coplanar):
        return simplices[:0], simplices[:0]
    for corner in range(simplices.shape[1]):
        outer = simplices[mesh.neighbors[:, corner] < 0]
        if (np.delete(outer, corner, axis=1) < n).any():
            return simplices[:0], simplices[:0]
    inner = (simplices < n).any(axis=1)
    # Simplices beside a facet share all rows but one each.
    total = simplices.sum(axis=1)
    beyond = total[mesh.neighbors[inner]] - total[inner][:, None] + simplices[inner]
    return simplices[inner], np.where(mesh.neighbors[inner] < 0, -1, beyond)
