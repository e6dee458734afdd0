"""Kernels on a toroidal raster: Ulichney's Gaussian (1993), or one in space and one in time (Wolfe 2022).

A kernel is a sum of products over the axes; a change at a pixel touches only the pixels that it reaches.
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

REACH = 8.5  # sigmas: beyond, a Gaussian is below 2e-16 of its height


@dataclass(frozen=True, eq=False)
class SeparableKernel:
    """A product of functions of one axis each.

    Attributes
    ----------
    offsets : tuple of (m_a,) intp
        Of the pixels that it reaches along each axis, each once.
    values : (m_0 * m_1 * ...,) float64
        There, in C order.
    """

    offsets: tuple[NDArray[np.intp], ...]
    values: FloatArray


RasterKernel = tuple[SeparableKernel, ...]  # their sum


def gaussian(shape: Sequence[int], sigma: float) -> RasterKernel:
    """Give the Gaussian of one width on all axes.

    Parameters
    ----------
    shape : sequence of int
        Pixels on each axis.
    sigma : float
        Width in pixels.

    Returns
    -------
    RasterKernel
        Of height 1, all images of the torus included.
    """
    return (_product([_axis_gaussian(side, sigma) for side in shape]),)


def spatiotemporal(shape: Sequence[int], sigma: float, sigma_time: float) -> RasterKernel:
    """Give the kernel that joins pixels of one frame, and one pixel of all frames, and nothing else.

    Parameters
    ----------
    shape : sequence of int
        Frames first, then the pixels on each axis of a frame.
    sigma : float
        Width within a frame, in pixels.
    sigma_time : float
        Width along time, in frames.

    Returns
    -------
    RasterKernel
        The sum of both Gaussians. Where they meet, at the pixel itself, it is 2.

    Notes
    -----
    The energy of Wolfe, Morrical, Akenine-Moller & Ramamoorthi, "Spatiotemporal blue noise masks", 2022: with
    a Gaussian in three dimensions instead, the frames alone would not be blue.
    """
    space = [_NOWHERE_ELSE, *(_axis_gaussian(side, sigma) for side in shape[1:])]
    time = [_axis_gaussian(shape[0], sigma_time), *[_NOWHERE_ELSE] * (len(shape) - 1)]
    return _product(space), _product(time)


_NOWHERE_ELSE = (np.zeros(1, np.intp), np.ones(1))


def _product(axes: Sequence[tuple[NDArray[np.intp], FloatArray]]) -> SeparableKernel:
    values = functools.reduce(np.multiply.outer, [on_axis for _, on_axis in axes])
    return SeparableKernel(tuple(offsets for offsets, _ in axes), values.ravel())


def _axis_gaussian(side: int, sigma: float) -> tuple[NDArray[np.intp], FloatArray]:
    """Offsets that a Gaussian reaches on an axis, each once, and its sum over the torus there."""
    reach = int(np.ceil(REACH * sigma))
    offsets = np.arange(-reach, reach + 1) if 2 * reach < side else np.arange(side)
    turns = range(-(reach // side) - 1, reach // side + 2)
    return offsets, np.sum([np.exp(-((offsets + t * side) ** 2) / (2 * sigma**2)) for t in turns], axis=0)
