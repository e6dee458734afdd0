"""Widths of kernels: a field of the density, in place of the paper's shaping factors.

The paper's Algorithm 2 gives each point a shaping factor from its neighbours' kernels, one step of a
fixed-point iteration a move, so that the energy which is descended changes on the way. Here the width s is a
field: s(x) is where the density, averaged over a Gaussian of width c s, would give uniform points just this
width,

    2 s^2 (rho * G_cs / 1 * G_cs)(x)^(2/d) = sigma^2,

1 being the domain. The left side grows with s, so there is one root, in empty regions too; at a constant
density s is that of the uniform method. Its slope enters the gradient.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy import ndimage

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.gbn.pixel_blocks import OVERHANG, block_sums, spline_spectrum
from gbnbench.generators.adaptive.gbn.smoothing import ComplexArray, PaddedGrid, padded_grid

LADDER = 2**0.25  # ratio of the widths that are tried
MARGIN = 0.25  # pixels around a bounded field over its longest side
WIDEST = 2.0  # over the longest side: a field that is empty but for a corner has its root below
BORDER = 2  # coefficients beyond each end, which a cubic spline reaches


@dataclass(frozen=True)
class KernelWidths:
    """The field of kernel widths.

    Attributes
    ----------
    log_width : (rows, columns[, ...]) float64
        log s at the centres of pixels, s in pixels.
    coefficients : float64
        Of the cubic spline through them, ``BORDER`` more on every side.
    """

    log_width: FloatArray
    coefficients: FloatArray


def kernel_widths(
    density: Density, n: int, sigma: float, smoothing: float, *, block: int = 1
) -> KernelWidths:
    """Find the width of kernels everywhere.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.
    sigma : float
        Kernel width of the uniform method, in spacings.
    smoothing : float
        c: the width of the average over s.
    block : int
        Pixels along the sides of blocks (``pixel_blocks``) that take the place of pixels.

    Returns
    -------
    KernelWidths
        On the blocks, in blocks.
    """
    d, shape = density.d, tuple(size // block for size in density.shape)
    scale = n / float(density.values.sum())
    longest = max(shape)
    margin = 0 if density.toroidal else max(8, math.ceil(MARGIN * longest))
    grid = padded_grid(shape, margin)
    spectrum = _spectrum(grid, density, scale, block)
    densest = float(density.values.max()) * scale * block**d
    width = 0.98 * sigma / (math.sqrt(2) * densest ** (1 / d))
    log_width = np.full(shape, math.nan)
    before = np.empty(0)
    while np.isnan(log_width).any():
        mean = grid.inside(grid.sampled(grid.smoothed(spectrum, (smoothing * width) ** 2), grid.padded))
        reached = mean / _share_inside(grid.shape, grid.padded, margin, smoothing * width, block)
        del mean  # images of many pixels are many bytes
        np.maximum(reached, 1e-300, out=reached)
        np.log(reached, out=reached)
        reached *= 2 / d
        reached += math.log(2 * width**2 / sigma**2)
        new = np.isnan(log_width) & (reached >= 0)
        if before.size == 0:
            log_width[new] = math.log(width) - reached[new] / 2
        else:  # the logarithm of the left side, a straight line between two widths
            part = before[new] / (before[new] - reached[new])
            log_width[new] = math.log(width) - (1 - part) * math.log(LADDER)
        before = reached
        if width > WIDEST * longest:
            log_width[np.isnan(log_width)] = math.log(width)
        width *= LADDER
    mode: Literal["grid-wrap", "mirror"] = "grid-wrap" if density.toroidal else "mirror"
    spline = log_width
    for a, size in enumerate(shape):
        if size > 1:
            spline = ndimage.spline_filter1d(spline, 3, axis=a, mode=mode)
    # NumPy reflects an axis of one pixel onto itself.
    return KernelWidths(log_width, np.pad(spline, BORDER, "wrap" if density.toroidal else "reflect"))


def _spectrum(grid: PaddedGrid, density: Density, scale: float, block: int) -> ComplexArray:
    """Transform a density, 0 beyond its borders, scaled to points."""
    if block == 1:
        return grid.spectrum(density.values * scale)
    beyond = 0 if density.toroidal else OVERHANG
    sums = block_sums(np.pad(density.values, beyond * block), block, toroidal=density.toroidal)
    whole = np.zeros(grid.padded)
    whole[tuple(slice(grid.margin - beyond, grid.margin - beyond + size) for size in sums.shape)] = (
        sums * scale
    )
    return grid.without_blocks(grid.transform(whole))


def _share_inside(
    shape: tuple[int, ...], padded: tuple[int, ...], margin: int, width: float, block: int
) -> FloatArray | float:
    """Part of a Gaussian around each pixel that lies over the domain."""
    if margin == 0:
        return 1.0
    share = np.ones(shape)
    for a, (size, whole) in enumerate(zip(shape, padded, strict=True)):
        line = padded_line(size, whole, width, block)
        share *= line.reshape([-1 if b == a else 1 for b in range(len(shape))])
    return share


def padded_line(size: int, whole: int, width: float, block: int = 1) -> FloatArray:
    """Smooth a row of ones on a longer row of zeros whose ends meet.

    Parameters
    ----------
    size, whole : int
        Ones, and the length of the row.
    width : float
        Of the Gaussian, in pixels.
    block : int
        Pixels of a block, where the row is one of blocks.

    Returns
    -------
    (size,) float64
        At the ones.
    """
    ones = np.zeros(whole)
    ones[:size] = 1
    k: FloatArray = np.fft.rfftfreq(whole).astype(np.float64, copy=False)
    spectrum = np.fft.rfft(ones)
    if block > 1:
        pixels = np.pad(np.ones(size * block), OVERHANG * block)
        ones[: size + 2 * OVERHANG] = block_sums(pixels, block, toroidal=False) / block
        spectrum = np.fft.rfft(np.roll(ones, -OVERHANG)) / spline_spectrum(k, 1)
    line: FloatArray = np.fft.irfft(spectrum * np.exp(-2 * (math.pi * width * k) ** 2), whole)
    return line[:size]
