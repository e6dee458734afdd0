"""The pull on the points: the density, smoothed by part of the kernels' width, at several resolutions.

The energy is E = 1/2 integral of (A - T)^2, where A sums the points' Gaussians. T spreads each pixel's share
of points over a Gaussian of variance (t s)^2 + 1/12, s being the kernels' width there and 1/12 the variance
of a square pixel. At t = 1 a set that has the density leaves nothing to be gained (the method is faithful);
near 0 pixels are points, edges are sharpened, and points gather in clumps.

At the borders of a bounded density T falls off over max(t, .8) of the kernels' width: the density is
continued by its mirror image, spread, and multiplied by the share of a Gaussian of that width around each
place that lies inside. At t = 1 a constant density then is the uniform method's in a box (Eq. 24). Below,
the outermost points lie about half a spacing from the border, as they should, where at 1 they lie at a
third of it. Where T fell off much more steeply than the points' Gaussians can, they would line up along the
border.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import erf

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.gbn.kernel_widths import BORDER, LADDER, KernelWidths
from gbnbench.generators.adaptive.gbn.pixel_blocks import in_blocks, mean_over_blocks
from gbnbench.generators.adaptive.gbn.smoothing import ComplexArray, PaddedGrid, padded_grid

EDGE = 0.8  # width over which T falls off at a border, over that of the kernels, unless t is larger
PIXEL = 1 / 12  # variance of a pixel's square along an axis
LEAST_ROOM = 64  # pixels beyond the border that any image may have; larger ones up to half their longest side
BEYOND_INK = 1.5  # width of a kernel on ink over the largest at an inked pixel's centre, at most


@dataclass(frozen=True)
class Level:
    """T at one resolution.

    Attributes
    ----------
    cell : (d,) float64
        Sides of a cell, in pixels.
    variance : float
        By which T is smoothed already, in squared pixels.
    first : (d,) float64
        Position of the first cell's centre, in pixels.
    values : float32 or float64 array
        T at the cells' centres, points a squared pixel (or cubed).
    reached : int
        Cells to either side that the widest kernel of the level reaches.
    """

    cell: FloatArray
    variance: float
    first: FloatArray
    values: FloatArray
    reached: int


def attraction_levels(
    density: Density,
    n: int,
    widths: KernelWidths,
    part: float,
    resolution: float,
    reach: float,
    blocks: int = 1,
) -> tuple[Level, ...]:
    """Spread the density, and sample it at cells of 1, 2, 4 ... pixels.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.
    widths : KernelWidths
        The kernels' widths.
    part : float
        t.
    resolution : float
        Width of a kernel over the cells of its level, at least: a level's error is exp(-pi^2 resolution^2 /
        2).
    reach : float
        Standard deviations after which a Gaussian ends.
    blocks : int
        Pixels along the sides of blocks, on which the widths are and the levels shall be (``pixel_blocks``).

    Returns
    -------
    tuple of Level
        From the finest on: level j serves kernels of width resolution * 2^j up to twice that.
    """
    cells = in_blocks(density, blocks)
    inked = cells.values > 0
    on_ink = float(np.exp(widths.log_width[inked].max()))
    # The transform's ends meet: a kernel at one border must not see what is spread at the other one.
    apart = reach * on_ink * math.hypot(1, part)
    room = max(LEAST_ROOM // blocks, max(cells.shape) // 2)
    margin = 0 if density.toroidal else max(4, min(math.ceil(apart), room))
    grid = padded_grid(cells.shape, margin)
    most = math.inf if density.toroidal else margin / (reach * math.hypot(1, part))
    log_width = np.minimum(grid.reflected(widths.log_width), math.log(most))
    rho, of_mass = grid.reflected(cells.of_points(n)), log_width
    if blocks > 1:
        inner = tuple(slice(BORDER, -BORDER) for _ in cells.shape)
        mean = mean_over_blocks(density, cells, blocks, widths.coefficients[inner])
        of_mass = np.minimum(grid.reflected(mean), math.log(most))
    spectrum = _spread_spectrum(grid, rho, of_mass, part, PIXEL / blocks**2)
    if blocks > 1:
        spectrum = grid.without_blocks(spectrum)
    if margin:
        field = grid.sampled(spectrum, grid.padded) * _share_inside(grid, max(part, EDGE) * np.exp(log_width))
        spectrum = grid.transform(field * (n / field.sum()))
    largest = BEYOND_INK * on_ink
    levels: list[Level] = []
    while True:
        scale = 2.0 ** len(levels)
        last = resolution * 2 * scale > min(largest, most)
        counts = tuple(math.ceil(size / scale) for size in grid.padded)
        variance = scale**2 if levels else 0.0
        values = grid.sampled(grid.smoothed(spectrum, variance) if levels else spectrum, counts)
        cell = np.array(grid.padded) / counts
        widest = largest if last else resolution * 2 * scale
        # Around a point at the border, as far as the widest kernel of the level reaches.
        beyond = [math.ceil(reach * math.sqrt(widest**2 - variance) / c) + 2 for c in cell.tolist()]
        values = np.pad(values, [(b, b) for b in beyond], "wrap")
        levels.append(Level(cell, variance, (0.5 - np.array(beyond)) * cell - margin, values, max(beyond)))
        if last:
            return tuple(levels)


def _share_inside(grid: PaddedGrid, width: FloatArray) -> FloatArray:
    """Part of a Gaussian of that width around each padded pixel that lies over the domain."""
    share = np.ones(grid.padded)
    for a, (size, whole) in enumerate(zip(grid.shape, grid.padded, strict=True)):
        at = (np.arange(whole) + 0.5 - grid.margin).reshape([-1 if b == a else 1 for b in range(share.ndim)])
        scale = math.sqrt(2) * width
        share *= 0.5 * (erf(at / scale) + erf((size - at) / scale))
    return share


def _spread_spectrum(
    grid: PaddedGrid, rho: FloatArray, log_width: FloatArray, part: float, pixel: float
) -> ComplexArray:
    """Spectrum of T: a sum over a ladder of widths, among which each pixel's share is interpolated."""
    ink = np.flatnonzero(rho > 0)
    logs = log_width.ravel()[ink]
    least, step = float(logs.min()), math.log(LADDER)
    at = (logs - least) / step
    last = max(1, math.ceil(float(at.max()) - 1e-9))
    below = np.clip(np.floor(at), 0, last - 1).astype(np.int16)
    by_width = np.argsort(below, kind="stable")
    ink, below, at = ink[by_width], below[by_width], at[by_width]
    share_of_ink = rho.ravel()[ink]
    u = at - below
    # Cubic interpolation in the logarithm of the width.
    shares = {
        -1: -u * (u - 1) * (u - 2) / 6,
        0: (u + 1) * (u - 1) * (u - 2) / 2,
        1: -(u + 1) * u * (u - 2) / 2,
        2: (u + 1) * u * (u - 1) / 6,
    }
    total = None
    field = np.zeros(rho.size)
    for j in range(-1, last + 2):
        field.fill(0)
        for offset, values in shares.items():
            first, end = np.searchsorted(below, np.array([j - offset, j - offset + 1], np.int16))
            field[ink[first:end]] = share_of_ink[first:end] * values[first:end]
        if not field.any():
            continue
        width = part * math.exp(least + j * step)
        spread = grid.smoothed(grid.transform(field.reshape(rho.shape)), width**2 + pixel)
        if total is None:
            total = spread
        else:
            total += spread
    assert total is not None  # noqa: S101 - some pixel has ink
    return total
