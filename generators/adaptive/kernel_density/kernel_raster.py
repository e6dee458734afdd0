"""The density that kernels of points leave over, on a raster: they are as wide as the density wants."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import interpolation_mode
from gbnbench.generators.kernel_based.density_raster import REACH

WIDEST = 32  # cells to which a kernel reaches at most, as in the author's program
LEAST = math.exp(-math.pi * REACH**2)


class KernelRaster:
    """What is left of a density when the kernels of points are taken off it.

    Parameters
    ----------
    density : Density
        Of an image.
    n : int
        Points that it is to have.
    cell : float
        Side of the raster's cells in pixels, or a little less.

    Attributes
    ----------
    lack : (cells,) float64
        Density less the sum of kernels, points a squared pixel.
    """

    def __init__(self, density: Density, n: int, cell: float) -> None:
        self.toroidal = density.toroidal
        self.shape = np.array(density.shape, np.float64)
        self._counts = np.maximum(np.ceil(self.shape / cell - 1e-9).astype(np.intp), 1)
        self._cell = self.shape / self._counts
        self.area = float(self._cell.prod())
        rho = density.of_points(n)
        for axis in range(2):
            rho = _resampled(rho, int(self._counts[axis]), axis)
        rho /= self.area
        self._rate = np.sqrt(rho)  # spacings a pixel
        self.lack = rho.ravel().copy()

    def spacings(self, x: FloatArray) -> FloatArray:
        """Wanted spacing at places, interpolated between cells.

        Parameters
        ----------
        x : (m, 2) float64
            Within the density, in pixels.

        Returns
        -------
        (m,) float64
            In pixels.
        """
        mode = interpolation_mode(toroidal=self.toroidal)
        rate = ndimage.map_coordinates(self._rate, (x / self._cell - 0.5).T, order=1, mode=mode)
        return np.asarray(1 / np.maximum(rate, 1e-12), np.float64)

    def centres(self, cells: NDArray[np.intp]) -> FloatArray:
        """Centres of cells by their flat indices, (m, 2) float64 in pixels."""
        index = np.stack(np.unravel_index(cells, tuple(self._counts.tolist())), axis=1)
        centre: FloatArray = (index + 0.5) * self._cell
        return centre

    def reaches(self, spacing: FloatArray) -> NDArray[np.intp]:
        """Cells to which kernels of a spacing reach from their own cell, (m,) intp."""
        return np.asarray(np.minimum(REACH * spacing / self._cell.min() + 0.5, WIDEST), np.intp)

    def kernels(
        self, x: FloatArray, spacing: FloatArray, reach: int
    ) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
        """Kernels of points on the cells around them.

        Parameters
        ----------
        x : (m, 2) float64
            Points, in pixels.
        spacing : (m,) float64
            Of the density there.
        reach : int
            Cells to either side.

        Returns
        -------
        cells : (m, window) intp
            Flat indices.
        heights : (m, window) float64
            exp(-pi r^2), r in spacings; in a box what would lie beyond its borders is mirrored at them, so
            that a kernel keeps its mass. 0 beyond the kernel's reach, and outside of a box.
        away : (2, m, window) float64
            From the point to the cell, in spacings; where a mirrored part is added, the mean of both weighted
            by their heights, a mirrored part counting backwards: it moves against its point.
        """
        own = np.floor(x / self._cell).astype(np.intp)
        index = own[:, :, None] + np.arange(-reach, reach + 1)  # (m, 2, offsets)
        apart = ((index + 0.5) * self._cell[:, None] - x[:, :, None]) / spacing[:, None, None]
        heights = np.exp(-math.pi * apart**2)
        if self.toroidal:
            index %= self._counts[:, None]
        else:
            inside = np.clip(index, 0, (self._counts - 1)[:, None])
            heights, apart = self._mirrored(heights, apart, x, spacing)
            heights[inside != index] = 0.0
            index = inside
        cells = index[:, 0, :, None] * self._counts[1] + index[:, 1, None, :]
        product = heights[:, 0, :, None] * heights[:, 1, None, :]
        product[product < LEAST] = 0.0
        away = np.empty((2, *product.shape))
        away[0], away[1] = apart[:, 0, :, None], apart[:, 1, None, :]
        return cells.reshape(len(x), -1), product.reshape(len(x), -1), away.reshape(2, len(x), -1)

    def _mirrored(
        self, heights: FloatArray, apart: FloatArray, x: FloatArray, spacing: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Add the images of points beyond the lower and the upper border, along each axis."""
        total = np.where(np.abs(apart) <= REACH, heights, 0.0)
        turned = total * apart
        for image in (-x, 2 * self.shape - x):
            beyond = apart + ((x - image) / spacing[:, None])[:, :, None]
            part = np.where(np.abs(beyond) <= REACH, np.exp(-math.pi * beyond**2), 0.0)
            total += part
            turned -= part * beyond
        return total, turned / np.maximum(total, 1e-300)

    def add(self, x: FloatArray) -> None:
        """Take the kernels of points, (m, 2) in pixels, off the density."""
        spacing = self.spacings(x)
        reach = self.reaches(spacing)
        for size in np.unique(reach).tolist():
            group = reach == size
            cells, heights, _ = self.kernels(x[group], spacing[group], size)
            np.subtract.at(self.lack, cells, heights / spacing[group, None] ** 2)

    def apart(self, x: FloatArray, reach: NDArray[np.intp]) -> Iterator[tuple[NDArray[np.intp], int]]:
        """Divide points into groups whose windows do not overlap within a group.

        Parameters
        ----------
        x : (n, 2) float64
            In pixels.
        reach : (n,) intp
            Cells to which their kernels reach.

        Yields
        ------
        group : (m,) intp
            Indices; all groups together hold each point once.
        reach : int
            Of the widest kernel in it.

        Notes
        -----
        Points of like reach are put into squares as wide as their windows, coloured like a chessboard of four
        colours; a group takes one point of each square of a colour. They can be moved together to the same
        result as one after another.
        """
        wide = np.array([reaching_class(r) for r in range(WIDEST + 1)])[reach]
        index = np.floor(x / self._cell).astype(np.intp)
        for size in np.unique(wide).tolist():
            members = np.flatnonzero(wide == size)
            window = 2 * size + 2
            if self.toroidal:
                squares = np.maximum(self._counts // window // 2 * 2, 1)
            else:
                squares = -(-self._counts // window)
            square = np.minimum(index[members] * squares // self._counts, squares - 1)
            flat = square[:, 0] * squares[1] + square[:, 1]
            order = np.argsort(flat, kind="stable")
            held = np.bincount(flat)
            rank = np.empty(len(members), np.intp)
            rank[order] = np.arange(len(members)) - np.repeat(np.cumsum(held) - held, held)
            group = 4 * rank + 2 * (square[:, 0] % 2) + square[:, 1] % 2
            order = np.argsort(group, kind="stable")
            for part in np.split(order, np.flatnonzero(np.diff(group[order])) + 1):
                yield members[part], size


def reaching_class(reach: int) -> int:
    """Round a reach up to one of a few: 1, 2, 3, 4, 6, 8, 10 and so on, a quarter or so apart.

    Parameters
    ----------
    reach : int
        Cells, at most ``WIDEST``.

    Returns
    -------
    int
    """
    size = 1
    while size < reach:
        size += max(1, size // 3)
    return min(size, WIDEST)


def _resampled(values: FloatArray, count: int, axis: int) -> FloatArray:
    """Share what pixels hold among so many equal cells along an axis."""
    values = np.moveaxis(values, axis, 0)
    at = np.linspace(0, len(values), count + 1)
    pixel = np.minimum(at.astype(np.intp), len(values) - 1)
    below = np.concatenate([np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)])
    until = below[pixel] + (at - pixel)[:, None] * values[pixel]
    return np.moveaxis(np.diff(until, axis=0), 0, axis)
