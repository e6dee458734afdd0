"""Sixfold order and degrees of the neighbours in the plane, added up slab by slab for sets of any size.

A slab with its surroundings is closed to a torus of its own, whose first side is shorter, and triangulated as
any set is. Where the circles of all triangles at the slab's own points stay clear of the seam, no other point
of the true torus lies in them either: these triangles are those of the whole set.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spatial.bond_order import bond_sums, psi_of_points
from gbnbench.analysis.spatial.delaunay import Neighbours, neighbours
from gbnbench.analysis.spatial.slabs import WHOLE, WIDEST, Progress, Slab, slab, slabs
from gbnbench.core.errors import RefusalError
from gbnbench.core.periodic_delaunay import circumcentre
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray, spacing

AROUND = 12.0  # spacings around a slab at first


@dataclass(frozen=True)
class PlaneOrder:
    """Sums over the points of one set in the plane, of what its Delaunay neighbours are like.

    Attributes
    ----------
    points : int
        Points that were added up.
    bonds : int
        Their neighbours, over all points.
    bond : float
        Sum over points of |sum over neighbours of exp(6 i theta)|, theta being the direction of the edge from
        a neighbour to the next.
    psi : float
        Sum over points of |mean over neighbours of exp(6 i theta)|, theta being the neighbour's direction.
    degrees : (k,) int64
        Points of each degree, from 0 on.
    """

    points: int
    bonds: int
    bond: float
    psi: float
    degrees: NDArray[np.int64]

    @property
    def bond_order(self) -> float:
        """As ``bond_order.bond_order`` of the set."""
        return self.bond / self.bonds

    @property
    def psi6(self) -> float:
        """As ``bond_order.psi6`` of the set."""
        return self.psi / self.points

    @property
    def valence6(self) -> float:
        """Share of the points that have six neighbours."""
        return float(self.degrees[6]) / self.points if len(self.degrees) > 6 else 0.0


def plane_order(x: FloatArray, sides: Sides | None = None, progress: Progress | None = None) -> PlaneOrder:
    """Add up the order of the neighbours in one set, in memory that does not grow with it.

    Parameters
    ----------
    x : (n, 2) float64
        Checked points on the unit torus; may be mapped from a file.
    sides : tuple of 2 floats, optional
        As ``as_sides`` returns them; a square if not given.
    progress : callable, optional
        Called with the share done after each slab.

    Returns
    -------
    PlaneOrder

    Raises
    ------
    RefusalError
        If two points coincide or are too near for doubles, or an empty circle is so wide that a slab would
        have to hold more than ``slabs.WHOLE`` points.
    """
    n, d = x.shape
    total = PlaneOrder(0, 0, 0.0, 0.0, np.zeros(0, np.int64))
    for part in slabs(x, AROUND * spacing(n, d) / (sides or (1.0,))[0], progress):
        total = _added(total, _of_slab(x, part, sides))
    return total


def order_of(each: Neighbours, own: int | None = None) -> PlaneOrder:
    """Add up the order of neighbours that are known.

    Parameters
    ----------
    each : Neighbours
        Of one set in the plane.
    own : int, optional
        Of so many points from the first on; of all if not given.

    Returns
    -------
    PlaneOrder
    """
    of = slice(0, len(each.degree) if own is None else own)
    degree = each.degree[of]
    return PlaneOrder(
        len(degree),
        int(degree.sum()),
        float(bond_sums(each)[of].sum()),
        float(psi_of_points(each)[of].sum()),
        np.bincount(degree).astype(np.int64),
    )


def summed_shares(orders: Sequence[PlaneOrder]) -> FloatArray:
    """Sum over sets the shares of the points that have each degree.

    Parameters
    ----------
    orders : sequence of PlaneOrder
        One a set.

    Returns
    -------
    (2, k) float64
        The degrees from the least to the largest that occur, and the sums of their shares.
    """
    share = np.zeros(max(len(order.degrees) for order in orders))
    for order in orders:
        share[: len(order.degrees)] += order.degrees / order.points
    met = np.flatnonzero(share)
    degree = np.arange(met[0], met[-1] + 1)
    return np.stack([degree.astype(np.float64), share[degree]])


def _of_slab(x: FloatArray, part: Slab, sides: Sides | None) -> PlaneOrder:
    """Add up the order at the own points of a slab, with as much around it as proves their triangles."""
    while True:
        found = _in_torus_of_slab(part, sides)
        if found is not None:
            return found
        wider = 2 * part.around
        width = part.high - part.low + 2 * wider
        if width > WIDEST or width * len(x) > WHOLE:
            raise RefusalError(
                f"Delaunay neighbours of n={len(x)} points are found in slabs, and around this one, from "
                f"{part.low:.3g} to {part.high:.3g} of the first axis, lies too wide an empty space for that"
            )
        part = slab(x, part.low, part.high, wider)


def _in_torus_of_slab(part: Slab, sides: Sides | None) -> PlaneOrder | None:
    """Triangulate a slab closed to a torus; None where a circle at an own point reaches the seam."""
    own, begin = len(part.rows), part.low - part.around
    width = part.high - part.low + 2 * part.around
    across, along = sides or (1.0, 1.0)
    placed = part.points.copy()
    placed[:, 0] = np.clip((placed[:, 0] + part.turns - begin) / width, 0.0, np.nextafter(1, 0))
    (each,) = neighbours(placed, (width * across, along))
    unit = math.sqrt(width * across * along)  # of the vectors: their torus has area 1
    rows = int(each.indptr[own])
    following = np.arange(1, rows + 1)
    following[each.indptr[1 : own + 1] - 1] = each.indptr[:own]
    vector = each.vector[:rows]
    centre = circumcentre(vector, vector[following])
    radius = np.sqrt(np.sum(centre**2, axis=1))
    at = np.repeat(placed[:own, 0] * (width * across / unit), each.degree[:own]) + centre[:, 0]
    end = width * across / unit
    clear = (at - radius > 0) & (at + radius < end) & (radius < along / unit / 2)
    return order_of(each, own) if clear.all() else None


def _added(a: PlaneOrder, b: PlaneOrder) -> PlaneOrder:
    degrees = np.zeros(max(len(a.degrees), len(b.degrees)), np.int64)
    degrees[: len(a.degrees)] += a.degrees
    degrees[: len(b.degrees)] += b.degrees
    return PlaneOrder(a.points + b.points, a.bonds + b.bonds, a.bond + b.bond, a.psi + b.psi, degrees)
