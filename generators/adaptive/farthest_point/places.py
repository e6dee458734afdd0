"""The local spacing of a density, and places on its ink, dense by it, at which voids are looked for."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import interpolation_mode, pixels_of
from gbnbench.generators.adaptive.gbn.kernel_widths import kernel_widths

PER_SPACING = 6  # places along a local spacing, at least where pixels are cut for them
POINTS_A_CELL = 2.0  # of the grid, as a point meets them on average
MOST_CELLS = 1 << 22
CROWDED = 256  # points a cell, on average, above which a move takes too long


@dataclass(frozen=True)
class Places:
    """What is looked up while points move.

    Attributes
    ----------
    spacing : (rows, columns) float32
        Local spacing at the centres of pixels.
    cells : (2,) int
        Cells of the grid along each axis.
    widest : (cells) float32
        An upper bound of the spacing on each cell's ink.
    places : (m, 2) float32
        Places on the ink, sorted by cell.
    of_place : (m,) float32
        Spacing there.
    start : (number of cells + 1,) int32
        Where the places of each cell begin.
    """

    spacing: NDArray[np.float32]
    cells: tuple[int, int]
    widest: NDArray[np.float32]
    places: NDArray[np.float32]
    of_place: NDArray[np.float32]
    start: NDArray[np.int32]


def local_spacing(density: Density, n: int, smoothing: float) -> FloatArray:
    """Give the spacing of n points where they are: that of squares of one point's mass each.

    Parameters
    ----------
    density : Density
        The density, of an image.
    n : int
        Points.
    smoothing : float
        The density is averaged over so many spacings, by a Gaussian.

    Returns
    -------
    (rows, columns) float64
        At the centres of pixels, in pixels.
    """
    return np.asarray(np.exp(kernel_widths(density, n, math.sqrt(2), smoothing).log_width))


def grid_side(density: Density, n: int) -> float:
    """Choose the side of the grid's cells: as many points in one as is fit, where points are.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.

    Returns
    -------
    float
        In pixels.
    """
    rho = density.of_points(n)
    side = math.sqrt(POINTS_A_CELL * n / float((rho * rho).sum()))
    return max(side, math.sqrt(rho.size / MOST_CELLS))


def crowding(density: Density, n: int) -> float:
    """Tell how many points the cell of a point has, on average.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.

    Returns
    -------
    float
    """
    rho = density.of_points(n)
    return float((rho * rho).sum()) * grid_side(density, n) ** 2 / n


def number_of_places(density: Density, n: int) -> int:
    """Bound the number of places from above, before they are made.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.

    Returns
    -------
    int
    """
    rho = density.of_points(n)
    ink = rho[rho > 0]
    return int((np.ceil(PER_SPACING * np.sqrt(ink)) ** 2).sum())


def void_places(density: Density, n: int, smoothing: float) -> Places:
    """Lay out a density for farthest-point optimisation.

    Parameters
    ----------
    density : Density
        The density, of an image.
    n : int
        Points.
    smoothing : float
        As ``local_spacing`` takes it.

    Returns
    -------
    Places
        Pixels are cut into parts where a sixth of the spacing is finer than they are; where it is coarser,
        one pixel that has ink stands for the block of as many pixels.
    """
    spacing = local_spacing(density, n, smoothing)
    pixels = np.argwhere(density.values > 0)
    fine = spacing[tuple(pixels.T)] / PER_SPACING
    places = [_parts(pixels[fine < 1], fine[fine < 1]), _blocks(pixels[fine >= 1], fine[fine >= 1])]
    at = np.concatenate(places).astype(np.float32).astype(np.float64)
    at = np.minimum(at, np.nextafter(np.array(density.shape, np.float32), np.float32(0)).astype(np.float64))
    at = at[density.values[pixels_of(density, at)] > 0]
    side = grid_side(density, n)
    rows, columns = (max(1, math.floor(size / side)) for size in density.shape)
    cell_side = np.array(density.shape) / (rows, columns)
    cell = np.minimum((at / cell_side).astype(np.intp), (rows - 1, columns - 1)) @ (columns, 1)
    order = np.argsort(cell, kind="stable")
    mode = interpolation_mode(toroidal=density.toroidal)
    at = at[order]
    of_place = ndimage.map_coordinates(spacing, at.T - 0.5, order=1, mode=mode)
    return Places(
        spacing.astype(np.float32),
        (rows, columns),
        _widest(density, spacing, (rows, columns)),
        at.astype(np.float32),
        of_place.astype(np.float32),
        np.searchsorted(cell[order], np.arange(rows * columns + 1)).astype(np.int32),
    )


def _parts(pixels: NDArray[np.intp], fine: FloatArray) -> FloatArray:
    """Cut pixels into parts of at most a side."""
    parts = np.ceil(1 / fine).astype(np.intp)
    places = [np.empty((0, 2))]
    for count in np.unique(parts).tolist():
        within_pixel = (np.argwhere(np.ones((count, count))) + 0.5) / count
        places.append((pixels[parts == count][:, None] + within_pixel).reshape(-1, 2))
    return np.concatenate(places)


def _blocks(pixels: NDArray[np.intp], coarse: FloatArray) -> FloatArray:
    """Choose one of the pixels in each block of 2^k x 2^k pixels of about one spacing."""
    level = np.floor(np.log2(coarse)).astype(np.intp)
    places: list[NDArray[Any]] = [np.empty((0, 2))]
    for k in np.unique(level).tolist():
        here = pixels[level == k]
        block = here >> k
        first = np.unique(block[:, 0] * (block[:, 1].max() + 1) + block[:, 1], return_index=True)[1]
        places.append(here[first] + 0.5)
    return np.concatenate(places)


def _widest(density: Density, spacing: FloatArray, cells: tuple[int, int]) -> NDArray[np.float32]:
    """Bound the spacing on the ink of each cell: the largest of its inked pixels and of those around them."""
    around = ndimage.maximum_filter(spacing, 3, mode="wrap" if density.toroidal else "nearest")
    around = np.where(density.values > 0, around, 0.0)
    for a, count in enumerate(cells):
        size = density.shape[a]
        ends = np.arange(count + 1) * (size / count)
        first = np.minimum(np.floor(ends[:-1] + 1e-9).astype(np.intp), size - 1)
        last = np.minimum(np.maximum(np.ceil(ends[1:] - 1e-9).astype(np.intp), first + 1), size)
        slices = [np.maximum.reduce(np.take(around, np.arange(f, e), axis=a), axis=a)
                  for f, e in zip(first, last, strict=True)]  # fmt: skip
        around = np.stack(slices, axis=a)
    return (around * (1 + 1e-6)).astype(np.float32)
