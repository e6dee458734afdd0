"""The sum of Gaussians on the ones of a toroidal raster, kept up to date pixel by pixel (Ulichney 1993)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

REACH = 8.5  # sigmas: beyond, a Gaussian is below 2e-16 of its height
TIES = 1e-13  # height of the noise that lets chance decide between equal pixels


class RasterEnergy:
    """A binary pattern on the torus, with the Gaussian sum that its ones give at every pixel.

    Parameters
    ----------
    side, d : int
        Pixels an axis and dimension.
    sigma : float
        Width of the Gaussian in pixels.
    rng : numpy.random.Generator
        Decides between equal pixels.

    Attributes
    ----------
    ones : (side**d,) bool
        The pattern, flat in C order.
    """

    def __init__(self, side: int, d: int, sigma: float, rng: np.random.Generator) -> None:
        self.side, self.d = side, d
        self.ones = np.zeros(side**d, bool)
        # One copy has inf on the ones, to find voids, the other -inf on the zeros, to find clusters.
        self._voids = TIES * rng.random(side**d)
        self._clusters = np.full(side**d, -np.inf)
        offsets, values = _axis_kernel(side, sigma)
        self._offsets = offsets
        self._kernel = values
        for _ in range(d - 1):
            self._kernel = np.multiply.outer(self._kernel, values)
        self._kernel = self._kernel.ravel()

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
        """Gaussian sum at a pixel, its own included."""
        return float(self._clusters[pixel] if self.ones[pixel] else self._voids[pixel])

    def add(self, pixel: int) -> None:
        """Turn a zero into a one."""
        self.ones[pixel] = True
        self._clusters[pixel], self._voids[pixel] = self._voids[pixel], np.inf
        self._change(pixel, self._kernel)

    def remove(self, pixel: int) -> None:
        """Turn a one into a zero."""
        self.ones[pixel] = False
        self._voids[pixel], self._clusters[pixel] = self._clusters[pixel], -np.inf
        self._change(pixel, -self._kernel)

    def _change(self, pixel: int, kernel: FloatArray) -> None:
        near: NDArray[np.intp] = np.zeros(1, np.intp)
        for axis in reversed(range(self.d)):
            pixel, index = divmod(pixel, self.side)
            step = self.side ** (self.d - 1 - axis)
            near = np.add.outer((self._offsets + index) % self.side * step, near).ravel()
        self._voids[near] += kernel
        self._clusters[near] += kernel


def _axis_kernel(side: int, sigma: float) -> tuple[NDArray[np.intp], FloatArray]:
    """Offsets that a Gaussian reaches on an axis, each once, and its sum over the torus there."""
    reach = int(np.ceil(REACH * sigma))
    offsets = np.arange(-reach, reach + 1) if 2 * reach < side else np.arange(side)
    turns = range(-(reach // side) - 1, reach // side + 2)
    return offsets, np.sum([np.exp(-((offsets + t * side) ** 2) / (2 * sigma**2)) for t in turns], axis=0)


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
