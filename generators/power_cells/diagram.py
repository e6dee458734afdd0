"""Power diagrams of weighted points on the torus in 2D, by the hull of lifted points (Aurenhammer 1987)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.periodic_delaunay import overhang, with_images
from gbnbench.core.torus import FloatArray, spacing
from gbnbench.generators.power_cells.cell_sides import cell_sides
from gbnbench.generators.power_cells.measured_cells import MeasuredCells

BORDER = 3.5  # first guess of the border of images, in spacings


@dataclass(frozen=True)
class PowerDiagram(MeasuredCells):
    """Power cells of n weighted points on the unit torus, with their areas for masses.

    Attributes
    ----------
    normal : (m, 2) float64
        Vector from a to b of each edge, its image that the side belongs to.
    ends : (m, 2, 2) float64
        Ends of each side from a, counterclockwise about it.
    """

    normal: FloatArray
    ends: FloatArray


def power_diagram(
    x: FloatArray, weight: FloatArray | None = None, margin: float | None = None
) -> PowerDiagram:
    """Cut the torus into power cells: y belongs to the point with the least |y - x|**2 - weight.

    Parameters
    ----------
    x : (n, 2) float64
        Points in [0, 1)^2.
    weight : (n,) float64, optional
        In units of squared length; without it all are equal, and the cells are Voronoi cells.
    margin : float, optional
        First guess of the border of images, in units of length; the answer does not depend on it.

    Returns
    -------
    PowerDiagram
        Exact to rounding.

    Raises
    ------
    InputError
        If x is not (n, 2), or weight not (n,) or not finite.

    Notes
    -----
    The sides are those of the points and a border of images (``cell_sides``). A vertex v is proven right if
    the ball about it of squared radius p + max w stays inside the tiled box, p being the power of v, for then
    no image left out can be nearer; else the border is widened. A border of 1 needs no
    check: a cell lies within half a side of its point on each axis, so that cells that touch belong to points
    no more than a side apart.

    Cost: 5 ms for 1,024 points, nearly all of it Qhull's.

    References
    ----------
    Aurenhammer, "Power diagrams: properties, algorithms and applications", SIAM J. Computing 16(1), 1987.

    Examples
    --------
    >>> diagram = power_diagram(np.array([[0.25, 0.5], [0.75, 0.5]]), np.array([0.05, 0.0]))
    >>> diagram.mass.round(12).tolist()
    [0.6, 0.4]
    """
    if x.ndim != 2 or x.shape[1] != 2:
        raise InputError(f"x must be (n, 2) for a power diagram; got shape {x.shape}")
    weight = np.zeros(len(x)) if weight is None else weight
    if weight.shape != x.shape[:1] or not np.isfinite(weight).all():
        raise InputError(f"weight must be ({len(x)},) and finite for {len(x)} points; got {weight.shape}")
    margin = min(1.0, BORDER * spacing(len(x), 2) if margin is None else margin)
    while True:
        diagram = _bordered(x, weight, margin)
        if diagram is not None and (margin >= 1 or diagram.reach <= margin):
            return diagram
        margin = min(1.0, 2 * margin if diagram is None else max(1.01 * diagram.reach, 1.2 * margin))


def _bordered(x: FloatArray, weight: FloatArray, margin: float) -> PowerDiagram | None:
    """Cells among the points and the images in a border, None where a cell is open or Qhull finds no hull."""
    n = len(x)
    tiled, owner = with_images(x, margin)
    sides = cell_sides(tiled - 0.5, weight[owner], n)
    if sides is None:
        return None
    site, start, end, normal = sides.site, sides.start, sides.end, sides.normal
    area = (start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]) / 2
    total = start + end
    squares = np.sum(start * start + end * end + total * total, axis=1)
    side = end - start
    moment = np.stack([np.bincount(site, area * total[:, k], n) for k in range(2)], axis=1) / 3
    length = normal[:, 0] * side[:, 1] - normal[:, 1] * side[:, 0]
    power = np.sum(end * end, axis=1) - weight[site]
    radius = np.sqrt(np.maximum(power + weight.max(), 0.0))
    return PowerDiagram(
        mass=np.asarray(np.bincount(site, area, n), dtype=np.float64),
        moment=moment,
        energy=np.asarray(np.bincount(site, area * squares, n), dtype=np.float64) / 12,
        edges=np.stack([site, owner[sides.other]], axis=1),
        conductance=length / (2 * np.sum(normal * normal, axis=1)),
        normal=normal,
        ends=np.stack([start, end], axis=1),
        reach=overhang(sides.corner + 0.5, radius),
    )
