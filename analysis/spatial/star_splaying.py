"""Repair of a Delaunay triangulation of the torus, point by point in exact arithmetic, by star splaying.

Each point holds the triangles around it among the points that it knows, and begins with its own images, which
enclose it. Neighbours tell one another of the points beside them until nobody learns anything: all stars then
agree, but for cocircular points.

References
----------
Shewchuk, "Star splaying: an algorithm for repairing Delaunay triangulations and convex hulls", Symposium on
Computational Geometry, 2005.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from gbnbench.analysis.spatial.exact_plane import ExactPlane, Image
from gbnbench.analysis.spatial.plane_edges import image_of
from gbnbench.analysis.spatial.plane_rings import IndexArray, Rings


def splay(plane: ExactPlane, rings: Rings, start: Iterable[int]) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Make the stars of some points Delaunay's, and those of others that this reaches.

    Parameters
    ----------
    plane : ExactPlane
        The points as integers.
    rings : Rings
        What each point knows of its neighbours; nothing need hold for it.
    start : iterable of int
        Points whose stars are made anew.

    Returns
    -------
    point, index : (m,) intp
        Start and end of each edge, in no order.
    turn : (m, 2) intp
        Whole sides by which the end is moved.
    """
    stars = _Stars(plane, rings)
    stars.agree(start)
    point, index = rings.point, rings.index
    fresh = np.array([(p, *image) for p, star in stars.made.items() for image in star], dtype=np.intp)
    fresh = fresh.reshape(-1, 4)
    old = ~np.isin(point, np.fromiter(stars.made, dtype=np.intp, count=len(stars.made)))
    return (
        np.concatenate([point[old], fresh[:, 0]]),
        np.concatenate([index[old], fresh[:, 1]]),
        np.concatenate([rings.turn[old], fresh[:, 2:]]),
    )


class _Stars:
    """Counterclockwise stars of the points touched so far."""

    def __init__(self, plane: ExactPlane, rings: Rings) -> None:
        self.plane, self.rings = plane, rings
        self.made: dict[int, list[Image]] = {}
        self.known: dict[int, set[Image]] = {}
        self.waiting: dict[int, None] = {}

    def agree(self, start: Iterable[int]) -> None:
        """Let points tell their neighbours what they know until all agree."""
        self.waiting.update(dict.fromkeys(start))
        while self.waiting:
            point, _ = self.waiting.popitem()
            star = list(self._star(point))
            for k, image in enumerate(star):
                other = image[0]
                own, before, after = (
                    _seen(each, image) for each in ((point, 0, 0), star[k - 1], star[(k + 1) % len(star)])
                )
                for each in (own, before, after):
                    self._offer(other, each)
                if own not in self._star(other):
                    for each in list(self._star(other)):
                        self._offer(point, _moved(each, image))

    def _star(self, point: int) -> list[Image]:
        """Star of a point, made of what its ring knows when it is asked for first."""
        if point not in self.made:
            self.made[point] = [(point, 1, 0), (point, 0, 1), (point, -1, 0), (point, 0, -1)]
            self.known[point] = {(point, 0, 0), *self.made[point]}
            link = image_of(self.rings)
            rows = range(int(self.rings.indptr[point]), int(self.rings.indptr[point + 1]))
            ring = [link(row) for row in rows]
            for image in ring:
                self._insert(point, image)
            lost = set(ring) - set(self.made[point])
            if lost or len(ring) != len(self.made[point]):
                self._wait(point, lost)
        return self.made[point]

    def _offer(self, point: int, image: Image) -> None:
        """Tell a point of an image; where that changes its star, it has news for its neighbours."""
        self._star(point)
        lost = self._insert(point, image)
        if lost is not None:
            self._wait(point, lost)

    def _wait(self, point: int, lost: Iterable[Image]) -> None:
        for each in (point, *(image[0] for image in lost)):
            self.waiting[each] = None

    def _insert(self, point: int, image: Image) -> list[Image] | None:
        """Take an image into a star if it lies in the circle of a triangle: what it displaces, or None."""
        star = self.made[point]
        if image in self.known[point]:
            return None
        self.known[point].add(image)
        new = self.plane.vector(point, image)
        around = [self.plane.vector(point, each) for each in star]
        count = len(star)
        struck = [self.plane.outside(around[k - 1], around[k], new) < 0 for k in range(count)]
        if not any(struck):
            return None
        # The triangles whose circles hold the new point are consecutive, since all circles pass the centre.
        first = next(k for k in range(count) if struck[k] and not struck[k - 1])
        length = next(run for run in range(1, count) if not struck[(first + run) % count])
        turned = star[first:] + star[:first]
        self.made[point] = [image, *turned[length - 1 :]]
        return turned[: length - 1]


def _seen(image: Image, origin: Image) -> Image:
    """Return an image as the owner of another, at its own place, sees it."""
    return image[0], image[1] - origin[1], image[2] - origin[2]


def _moved(image: Image, by: Image) -> Image:
    return image[0], image[1] + by[1], image[2] + by[2]
