"""The sum of kernels on the ones of a toroidal raster, kept up to date pixel by pixel (Ulichney 1993)."""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.kernel_based.raster_kernel import RasterKernel

TIES = 1e-13  # height of the noise that lets chance decide between equal pixels


class RasterEnergy:
    """A binary pattern on the torus, with the sum of kernels that its ones give at every pixel.

    Parameters
    ----------
    shape : sequence of int
        Pixels on each axis.
    kernel : RasterKernel
        What a one gives to the pixels around it.
    rng : numpy.random.Generator
        Decides between equal pixels.

    Attributes
    ----------
    ones : (pixels,) bool
        The pattern, flat in C order.
    """

    def __init__(self, shape: Sequence[int], kernel: RasterKernel, rng: np.random.Generator) -> None:
        self.shape, self.kernel = tuple(shape), kernel
        pixels = math.prod(shape)
        self.ones = np.zeros(pixels, bool)
        # One copy has inf on the ones, to find voids, the other -inf on the zeros, to find clusters.
        self._voids = TIES * rng.random(pixels)
        self._clusters = np.full(pixels, -np.inf)

    def copy(self) -> RasterEnergy:
        """Return the same pattern, to be changed apart from this one."""
        other = copy.copy(self)
        other.ones, other._voids, other._clusters = (
            array.copy() for array in (self.ones, self._voids, self._clusters)
        )
        return other

    @property
    def count(self) -> int:
        """Ones in the pattern."""
        return int(np.count_nonzero(self.ones))

    def largest_void(self) -> int:
        """Flat index of the zero at which the sum is least."""
        return int(self._voids.argmin())

    def tightest_cluster(self) -> int:
        """Flat index of the one at which the sum is largest."""
        return int(self._clusters.argmax())

    def at(self, pixel: int) -> float:
        """Sum at a pixel, its own included."""
        return float(self._clusters[pixel] if self.ones[pixel] else self._voids[pixel])

    def add(self, pixel: int) -> None:
        """Turn a zero into a one."""
        self.ones[pixel] = True
        self._clusters[pixel], self._voids[pixel] = self._voids[pixel], np.inf
        self._change(pixel, np.add)

    def remove(self, pixel: int) -> None:
        """Turn a one into a zero."""
        self.ones[pixel] = False
        self._voids[pixel], self._clusters[pixel] = self._clusters[pixel], -np.inf
        self._change(pixel, np.subtract)

    def _change(self, pixel: int, change: np.ufunc) -> None:
        index = np.unravel_index(pixel, self.shape)
        for part in self.kernel:
            near: NDArray[np.intp] = np.zeros(1, np.intp)
            step = 1
            for side, at, offsets in zip(
                reversed(self.shape), reversed(index), reversed(part.offsets), strict=True
            ):
                near = np.add.outer((offsets + at) % side * step, near).ravel()
                step *= side
            self._voids[near] = change(self._voids[near], part.values)
            self._clusters[near] = change(self._clusters[near], part.values)


def pixel_centres(pixels: NDArray[np.intp], side: int, d: int) -> FloatArray:
    """Centres of pixels.

    Parameters
    ----------
    pixels : (n,) intp
        Flat indices in C order.
    side, d : int
        Pixels an axis and dimension.

    Returns
    -------
    (n, d) float64
        On the unit torus.
    """
    return (np.stack(np.unravel_index(pixels, (side,) * d), axis=1) + 0.5) / side
