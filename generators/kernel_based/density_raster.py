"""The lack of density that a kernel estimate leaves on a toroidal raster, point by point (Fattal 2011)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

RESOLUTION = 4  # pixels a spacing
REACH = 1.19  # spacings at which the kernel is cut off, where it is exp(-pi 1.19**2) = 0.012


class DensityRaster:
    """Density that n points ought to have, less the sum of their kernels, at every pixel.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Attributes
    ----------
    side : int
        Pixels an axis.
    spacing : float
        n**(-1/d) in pixels.
    lack : (side**d,) float64
        1 less the sum of kernels exp(-pi r**2), r in spacings: each has unit mass, so that n of them make 1.
    """

    def __init__(self, n: int, d: int) -> None:
        self.n, self.d = n, d
        self.spacing = float(RESOLUTION)
        self.side = max(round(RESOLUTION * n ** (1 / d)), 1)
        self.spacing = self.side * n ** (-1 / d)
        self.lack = np.ones(self.side**d)
        reach = math.ceil(REACH * self.spacing)
        self._offsets = np.arange(-reach, reach + 1)
        self._least = math.exp(-math.pi * REACH**2)

    def kernels(self, x: FloatArray) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
        """Kernels of points on the pixels about them.

        Parameters
        ----------
        x : (points, d) float64
            In pixels, in or out of the raster.

        Returns
        -------
        pixels : (points, window) intp
            Flat indices.
        heights : (points, window) float64
            Of the kernel, 0 beyond its reach.
        away : (d, points, window) float64
            From the point to the pixel, in spacings.
        """
        count = len(x)
        index = np.floor(x).astype(np.intp)[:, :, None] + self._offsets  # (points, d, offsets)
        apart = (index - x[:, :, None]) / self.spacing
        index %= self.side
        heights = np.exp(-math.pi * apart**2)
        pixels, product = index[:, 0], heights[:, 0]
        for axis in range(1, self.d):
            pixels = (pixels[:, :, None] * self.side + index[:, axis, None, :]).reshape(count, -1)
            product = (product[:, :, None] * heights[:, axis, None, :]).reshape(count, -1)
        product[product < self._least] = 0.0
        window = (count, *(len(self._offsets),) * self.d)
        away = np.empty((self.d, *window))
        for axis in range(self.d):
            shape = [count, *(1,) * self.d]
            shape[axis + 1] = len(self._offsets)
            away[axis] = apart[:, axis].reshape(shape)
        return pixels, product, away.reshape(self.d, count, -1)

    def add(self, x: FloatArray) -> None:
        """Take the kernels of points, (points, d) in pixels, off the density that lacks."""
        pixels, heights, _ = self.kernels(x)
        np.subtract.at(self.lack, pixels.ravel(), heights.ravel())

    def apart(self, x: FloatArray) -> Iterator[NDArray[np.intp]]:
        """Divide points into groups whose kernels do not overlap within a group.

        Parameters
        ----------
        x : (n, d) float64
            In pixels.

        Yields
        ------
        (points,) intp
            Indices; all groups together hold each point once.

        Notes
        -----
        Cells as wide as a window are coloured like a chessboard, 2**d colours; a group takes one point of
        each cell of a colour. Its points can be moved together to the same result as one after another.
        """
        width = len(self._offsets) + 1
        cells = self.side // width // 2 * 2
        if cells < 2:
            yield from np.arange(len(x))[:, None]
            return
        cell = np.minimum((x * (cells / self.side)).astype(np.intp), cells - 1)
        flat = np.ravel_multi_index(tuple(cell.T), (cells,) * self.d)
        order = np.argsort(flat, kind="stable")
        held = np.bincount(flat, minlength=cells**self.d)
        rank = np.arange(len(x)) - np.repeat(np.cumsum(held) - held, held)
        colour = (cell[order] % 2) @ (1 << np.arange(self.d)[::-1])
        group = (rank << self.d) + colour
        by_group = np.argsort(group, kind="stable")
        ends = np.flatnonzero(np.diff(group[by_group])) + 1
        yield from np.split(order[by_group], ends)
