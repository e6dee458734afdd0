"""Neighbours on the torus by tiling the plane: the nearest point, and Delaunay's neighbours."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import Voronoi


def nearest_by_tiling(x: ArrayLike, probes: ArrayLike) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Nearest point on the torus to each probe, and its image's place, over all 3**d tiles: (p,), (p, d)."""
    points, at = np.asarray(x, dtype=float), np.asarray(probes, dtype=float)
    n, d = points.shape
    tiles = np.indices((3,) * d).reshape(d, -1).T - 1.0
    images = (points[None] + tiles[:, None]).reshape(-1, d)
    owner, place = np.empty(len(at), dtype=np.intp), np.empty_like(at)
    for start in range(0, len(at), 2000):
        block = slice(start, start + 2000)
        squares = sum((at[block, a, None] - images[None, :, a]) ** 2 for a in range(d))
        best = np.argmin(squares, axis=1)
        owner[block], place[block] = best % n, images[best]
    return owner, place


def rounded(vectors: np.ndarray) -> list[tuple[float, ...]]:
    return sorted(tuple(row) for row in np.round(vectors, 9) + 0.0)


def tiling(x: np.ndarray, rings: int) -> np.ndarray:
    shifts = sorted(itertools.product(range(-rings, rings + 1), repeat=x.shape[1]), key=lambda s: any(s))
    return np.concatenate([x + np.array(shift) for shift in shifts])


def by_voronoi(x: np.ndarray, rings: int) -> list[list[tuple[float, ...]]]:
    """Neighbours as pairs of cells with a common ridge in the Voronoi diagram of the whole tiling."""
    tiled = tiling(x, rings)
    found: list[list[np.ndarray]] = [[] for _ in x]
    for p, q in Voronoi(tiled).ridge_points:
        if p < len(x):
            found[p].append(tiled[q] - tiled[p])
        if q < len(x):
            found[q].append(tiled[p] - tiled[q])
    return [rounded(np.array(vectors)) for vectors in found]


def by_empty_circles(x: np.ndarray) -> list[list[tuple[float, ...]]]:
    """Neighbours from every triangle of the tiling whose circumscribed circle holds no point."""
    tiled = tiling(x, 2)
    found = []
    for p in x:
        rest = tiled[np.any(tiled != p, axis=1)] - p
        i, j = np.triu_indices(len(rest), 1)
        a, b = rest[i], rest[j]
        twice = 2 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        proper = np.abs(twice) > 1e-12
        a, b, i, j, twice = a[proper], b[proper], i[proper], j[proper], twice[proper]
        aa, bb = (a**2).sum(1), (b**2).sum(1)
        centre = np.column_stack([b[:, 1] * aa - a[:, 1] * bb, a[:, 0] * bb - b[:, 0] * aa]) / twice[:, None]
        gap = np.full(len(centre), np.inf)
        for q in rest:
            np.minimum(gap, ((q - centre) ** 2).sum(1) - (centre**2).sum(1), out=gap)
        empty = gap > -1e-12
        found.append(rounded(rest[np.unique(np.concatenate([i[empty], j[empty]]))]))
    return found


def valence_by_empty_circles(x: np.ndarray) -> np.ndarray:
    """Degrees from empty circles: every triangle of the 3 x 3 tiling whose circle holds no other point."""
    n = len(x)
    tiled = np.concatenate([x + np.array([i, j]) for i in (0, -1, 1) for j in (0, -1, 1)])
    joined: list[set[int]] = [set() for _ in range(n)]
    for i in range(n):
        others = np.delete(np.arange(len(tiled)), i)
        near = others[np.argsort(np.hypot(*(tiled[others] - x[i]).T))][:60]
        a, b = (t.ravel() for t in np.meshgrid(near, near, indexing="ij"))
        a, b = a[a < b], b[a < b]
        u, v = tiled[a] - x[i], tiled[b] - x[i]
        cross = 2 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
        use = np.abs(cross) > 1e-12
        a, b, u, v, cross = a[use], b[use], u[use], v[use], cross[use]
        uu, vv = (u**2).sum(1), (v**2).sum(1)
        centre = np.stack([v[:, 1] * uu - u[:, 1] * vv, u[:, 0] * vv - v[:, 0] * uu], 1) / cross[:, None]
        radius = np.hypot(*centre.T)
        distance = np.hypot(*((centre + x[i])[:, None, :] - tiled[None]).transpose(2, 0, 1))
        empty = np.all(distance > radius[:, None] * (1 - 1e-9), axis=1)
        joined[i] |= set(a[empty]) | set(b[empty])
    return np.sort([len(s) for s in joined])
