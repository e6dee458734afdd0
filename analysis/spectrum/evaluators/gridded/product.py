"""Power of a cube with its first axis carried to a grid by a window, and its other axes summed exactly.

With M nodes, F(f_0, g) = sum_m exp(-2 pi i f_0 m / M) G_m(g) / W(f_0). Here W is the transform of the window,
and G_m(g) is the sum of exp(-2 pi i g.x') times the window over the few points near node m. The two-group
product thus runs over M nodes, five for each f_0 >= 0, in place of n points. Carrying a point takes 16
multiply-adds for each g. Phases and places in a cell are exact, and in double the error of the window is less
than rounding, so no digit is lost.
"""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.precision import SUM_POINTS, Precision
from gbnbench.analysis.spectrum.coordinate_rounding import BITS, Coordinates, coordinates
from gbnbench.analysis.spectrum.digits import Division, whole_axes
from gbnbench.analysis.spectrum.error_model import UNIT, Errors, sum_errors
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.cube_writer import CubeWriter
from gbnbench.analysis.spectrum.evaluators.gridded.cells import sorted_by_cell
from gbnbench.analysis.spectrum.evaluators.gridded.grid import DEGREE, WIDTH, Grid, window_transform
from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import nodes_for, window
from gbnbench.analysis.spectrum.evaluators.two_group_product import norms_of
from gbnbench.core.torus import FloatArray

PLAIN_FROM = 4096  # with more points, frequencies along the first axis are evaluated by the plain product
KEPT_FROM = 1 << 12  # the rounding of sums at nodes is kept if more points than this reach one


def gridded_powers(
    p: Precision,
    x: FloatArray,
    fmax: int,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
) -> tuple[FloatArray, Errors]:
    """Evaluate the power at all frequencies with |f_a| <= fmax.

    Parameters and returns are those of ``cube_product.cube_powers``; d is at least 2.
    """
    sets, n, d = x.shape
    grid = Grid(p, n, d, sets, fmax)
    norms, axes = norms_of(weights, sets, n), whole_axes(d, fmax)
    gains = window_transform(p, fmax) ** 2
    divided = Division(axes[:1], axes[1:], 0, 0)
    writer = CubeWriter(p, divided, fmax, sets, d, half=half, mean=mean, gains=gains)
    over = p.runtime.upload(norms.astype(p.sum))
    crowd = 0
    for first in range(0, sets, grid.sets):
        some = slice(first, first + grid.sets)
        held = sorted_by_cell(x[some], grid.nodes, BITS[p.name])
        crowd = max(crowd, held.crowd(grid.window.width))
        grid.carry(
            held, weights if weights is None or len(weights) == 1 else weights[some], crowd > KEPT_FROM
        )
        grid.multiply(len(held.x))
        writer.add(grid.program, grid.amplitude, 1, over, first, len(held.x), 0, fmax + 1)
    power = writer.result()
    errors = gridded_errors(p, fmax, x.shape[-2], crowd, coordinates(x, p.name, weights))
    at = (2 * fmax + 1) ** (d - 1) // 2
    if n <= PLAIN_FROM:
        totals = np.full(sets, float(n)) if weights is None else weights.sum(axis=1) ** 2 / norms
        flat = power.reshape(*power.shape[:-d], -1)
        flat[..., (0 if half else fmax) * (2 * at + 1) + at] = totals.mean() if mean else totals
        return power, errors
    # At g = 0 all terms are positive, and their rounding, about 0.2 sqrt(n) units, would stand out.
    line, plain = cube_powers(p, x[..., :1], fmax, weights, half, mean)
    power.reshape(*line.shape, -1)[..., at] = line
    return power, Errors(max(errors.rms, plain.rms), max(errors.bound, plain.bound))


def gridded_errors(p: Precision, fmax: int, n: int, crowd: int, at: Coordinates) -> Errors:
    """State the errors of sqrt(power).

    Parameters
    ----------
    p : Precision
        Precision on the device.
    fmax : int
        Largest harmonic on each axis.
    n : int
        Points of a set.
    crowd : int
        Points that reach the node which most of them reach.
    at : Coordinates
        Rounding of the coordinates.

    Returns
    -------
    Errors
    """
    shape = window(WIDTH[p.name], DEGREE[p.name])
    nodes = nodes_for(fmax, p.lanes)
    transform = window_transform(p, fmax)
    magnified = float(transform[0] / transform.min())
    runs = -(-crowd // p.sum_points)
    in_run = min(crowd, p.sum_points)
    beyond = 2 if crowd > KEPT_FROM else runs
    # First the points' table and the window, then the nodes' table and the sum over nodes.
    sums = "double" if p.sum is np.float64 else "float"
    to_nodes = sum_errors(p.name, p.name, Coordinates(0, 0, at.share), 0, 2, in_run, beyond)
    at_nodes = Coordinates(0, 0, at.share)
    steps, blocks = min(SUM_POINTS, nodes // 2 + 1), -(-(nodes // 2 + 1) // SUM_POINTS)
    from_nodes = sum_errors(p.name, sums, at_nodes, 0, 2, steps, blocks)
    # Nodes that no point reaches hold zero, and to add a zero rounds nothing.
    filled = n * (WIDTH[p.name] + p.lanes)
    worst = sum_errors(p.name, sums, at_nodes, 0, 2, min(steps, filled), min(blocks, filled)).bound
    rounded = 2 * math.pi * fmax
    bound = magnified * (to_nodes.bound + worst) + at.share * (2 * shape.left_out)
    typical = math.hypot(to_nodes.rms, from_nodes.rms, UNIT[p.name] * math.sqrt(0.2 * runs))
    typical *= math.sqrt(magnified) / 2
    return Errors(math.hypot(typical, rounded / math.sqrt(6) * at.scattered), bound + rounded * at.coherent)


def least_gridded(precision: str) -> int:
    """Find the smallest fmax whose grid is wide enough for the window of a precision."""
    f = 1
    while not griddable(2, f, precision):
        f += 1
    return f


def griddable(d: int, fmax: int, precision: str) -> bool:
    """Tell whether there are two axes or more, and whether a grid is wide enough for the window.

    Parameters
    ----------
    d, fmax : int
        Dimension, and largest harmonic on each axis.
    precision : {"double", "float"}
        Precision of the arithmetic.

    Returns
    -------
    bool
    """
    return d >= 2 and nodes_for(fmax, 1) >= 3 * WIDTH[precision]
