"""Delaunay neighbours on the torus and their valence (the last row of Ahmed, Ren & Wonka 2022, Fig. 8)."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import Delaunay, QhullError

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray, as_realizations, spacing, with_images

if TYPE_CHECKING:
    import pandas as pd

IndexArray = NDArray[np.intp]

# A Voronoi edge, or the width of a Voronoi face, below this many spacings counts as none: above what rounding
# makes of cocircular points, below what a random set shows. Circumcentres of thin tetrahedra round more.
SHORTEST_EDGE = 1e-8
NARROWEST_FACE = 1e-6
# Volume of a tetrahedron, over its sides' product, below which it is flat.
FLATTEST = 1e-8
# The torus holds the integer lattice of each point, so no empty ball is wider than sqrt(3): two rings of
# images reach every neighbour of a point, whatever the set.
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
        cyclic order.
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


@dataclass(frozen=True)
class Valence:
    """Histogram of Delaunay degrees.

    Attributes
    ----------
    degree : (k,) intp
        Every degree from the smallest to the largest met.
    share : (k,) float64
        Share of the points that have it, mean over realizations; sums to 1.
    share_by_set : (realizations, k) float64
        The same for each set.
    """

    degree: IndexArray
    share: FloatArray
    share_by_set: FloatArray

    def of(self, degree: int) -> FloatArray:
        """Share of points of this degree in each set: (realizations,), 0 where none has it."""
        return np.asarray(self.share_by_set[:, self.degree == degree].sum(axis=1), dtype=np.float64)

    def to_frame(self) -> pd.DataFrame:
        """Columns degree, share."""
        import pandas as pd

        return pd.DataFrame({"degree": self.degree, "share": self.share})


def neighbours(x: ArrayLike) -> tuple[Neighbours, ...]:
    """Delaunay neighbours of each set, made once for valence, psi6 and bond order.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points on the unit torus, d = 2 or 3.

    Returns
    -------
    tuple of Neighbours
        One a realization.

    Raises
    ------
    RefusalError
        If d is not 2 or 3, or two points of a set coincide.

    Notes
    -----
    Two points are neighbours where their Voronoi cells on the torus share an edge (a face in 3D) that has
    length: this is the Delaunay triangulation wherever that is unique, so the mean degree in 2D is 6. Where
    more than three points lie on one empty circle the diagonals are arbitrary and none counts: a square grid
    has degree 4. One point may be the neighbour of another, or of itself, through several images, and each
    counts: a single point has four neighbours, its own images.

    The set is triangulated with a border of its images. The border is wide enough, and proven so, when the
    circumscribed ball of every triangle at a point of the set lies inside it: then no other image could
    change these triangles. Else it is widened and the set triangulated again.

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
    return tuple(_triangulate(points) for points in sets)


def as_neighbours(x: ArrayLike | Sequence[Neighbours]) -> Sequence[Neighbours]:
    """Return neighbours already made, or make those of points."""
    if isinstance(x, (tuple, list)) and x and all(isinstance(item, Neighbours) for item in x):
        return x
    return neighbours(x)  # type: ignore[arg-type]


def valence(x: ArrayLike | Sequence[Neighbours]) -> Valence:
    """Histogram of the Delaunay degrees on the torus, averaged over realizations.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64, or what ``neighbours`` returned
        Points on the unit torus, d = 2 or 3.

    Returns
    -------
    Valence
        ``valence(x).of(6)`` is the share v6 of each set.

    Raises
    ------
    RefusalError
        As ``neighbours``.
    """
    degrees = [each.degree for each in as_neighbours(x)]
    low, high = min(int(k.min()) for k in degrees), max(int(k.max()) for k in degrees)
    by_set = np.array([np.bincount(k - low, minlength=high - low + 1) / len(k) for k in degrees])
    return Valence(np.arange(low, high + 1, dtype=np.intp), by_set.mean(axis=0), by_set)


def valence6(x: ArrayLike | Sequence[Neighbours]) -> FloatArray:
    """Share of points with exactly six Delaunay neighbours in each set of the plane: (realizations,).

    Raises
    ------
    RefusalError
        If d is not 2 (six is the plane's mean), or two points of a set coincide.
    """
    return valence(plane_neighbours(x, "the share of degree six")).of(6)


def plane_neighbours(x: ArrayLike | Sequence[Neighbours], measure: str) -> Sequence[Neighbours]:
    """Neighbours for a measure of the plane, refused by name elsewhere."""
    made = as_neighbours(x)
    d = made[0].vector.shape[1]
    if d != 2:
        raise RefusalError(f"{measure} is defined in the plane; got d={d}")
    return made


def _triangulate(x: FloatArray) -> Neighbours:
    n, d = x.shape
    h = spacing(n, d)
    if len(np.unique(x, axis=0)) < n:
        raise RefusalError(f"Delaunay neighbours need distinct points; some of these n={n} coincide")
    star = _star2 if d == 2 else _star3
    margin = 3 * h if 3 * h < 1 else WIDEST_MARGIN
    while True:
        tiled, owner = _tile(x, margin)
        try:
            found = star(tiled, _inner_simplices(tiled, n), n, h, margin)
        except QhullError:  # too few images to span the space
            found = 0.0
        if isinstance(found, _Star):
            return Neighbours(found.indptr, owner[found.image], tiled[found.image] - x[found.point])
        if margin >= WIDEST_MARGIN:
            raise RefusalError(
                f"Delaunay neighbours need points apart; some of these n={n} are too near for doubles"
            )
        wanted = max(1.5 * margin, found)
        margin = wanted if wanted < 1 else WIDEST_MARGIN


def _tile(x: FloatArray, margin: float) -> tuple[FloatArray, IndexArray]:
    """Points and their images to margin; beyond one ring, all of two rings."""
    if margin <= 1:
        return with_images(x, margin)
    shifts = sorted(itertools.product((0, 1, -1, 2, -2), repeat=x.shape[1]), key=any)  # the set itself first
    return np.concatenate([x + np.array(s) for s in shifts]), np.tile(
        np.arange(len(x), dtype=np.intp), len(shifts)
    )


def _inner_simplices(tiled: FloatArray, n: int) -> IndexArray:
    """Simplices at the first n points; none where one of those lies on the hull, or rounding lost a point."""
    mesh = Delaunay(tiled)
    simplices = mesh.simplices.astype(np.intp)
    if len(mesh.coplanar):
        return simplices[:0]
    for corner in range(simplices.shape[1]):
        outer = simplices[mesh.neighbors[:, corner] < 0]
        if (np.delete(outer, corner, axis=1) < n).any():
            return simplices[:0]
    return simplices[(simplices < n).any(axis=1)]


@dataclass(frozen=True)
class _Star:
    """Directed edges (point, image), sorted by point: the verified neighbours."""

    indptr: IndexArray
    point: IndexArray
    image: IndexArray


def _star2(tiled: FloatArray, simplices: IndexArray, n: int, h: float, margin: float) -> _Star | float:
    """Find closed cycles of neighbours in the plane, or the margin that is lacking (0: a star is open)."""
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
    aa, bb = np.sum(a * a, axis=1), np.sum(b * b, axis=1)
    # Circumcentre relative to the point: solves 2 a.c = |a|^2, 2 b.c = |b|^2.
    centre = np.column_stack([b[:, 1] * aa - a[:, 1] * bb, a[:, 0] * bb - b[:, 0] * aa]) / (2 * area)[:, None]
    lacking = _reach(tiled[point] + centre, np.sqrt(np.sum(centre**2, axis=1)))
    if lacking > margin:
        return lacking
    preceding = np.empty_like(following)
    preceding[following] = np.arange(len(following))
    length = np.sqrt(np.sum((centre - centre[preceding]) ** 2, axis=1))
    return _kept(point, first, length > SHORTEST_EDGE * h, n)


def _star3(tiled: FloatArray, simplices: IndexArray, n: int, h: float, margin: float) -> _Star | float:
    """Find neighbours in space whose Voronoi faces have area, or the margin that is lacking (0: unknown)."""
    if len(np.unique(simplices[simplices < n])) < n:
        return 0.0
    origin = tiled[simplices[:, 0]]
    sides = tiled[simplices[:, 1:]] - origin[:, None]
    # Flat tetrahedra come from points on one sphere; their centre is that of the tetrahedra beside them.
    solid = np.abs(np.linalg.det(sides)) > FLATTEST * np.prod(np.sqrt(np.sum(sides**2, axis=2)), axis=1)
    simplices, origin, sides = simplices[solid], origin[solid], sides[solid]
    centre = np.linalg.solve(2 * sides, np.sum(sides**2, axis=2)[..., None])[..., 0]
    lacking = _reach(origin + centre, np.sqrt(np.sum(centre**2, axis=1)))
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
    return _kept(point[start], image[start], product > (NARROWEST_FACE * h) ** 2 * trace, n)


def _reach(centre: FloatArray, radius: FloatArray) -> float:
    """How far beyond the unit box the balls reach."""
    return float(max(np.max(radius[:, None] - centre), np.max(centre + radius[:, None]) - 1))


def _kept(point: IndexArray, image: IndexArray, keep: NDArray[np.bool_], n: int) -> _Star:
    point, image = point[keep], image[keep]
    indptr = np.concatenate([[0], np.cumsum(np.bincount(point, minlength=n))]).astype(np.intp)
    return _Star(indptr, point, image)
