"""Tapered sums over points, sum_j h_p(x_j) exp(-i k.x_j), at any wave vectors and on the grid of all allowed.

Any wave vectors are summed directly, a sine and a cosine for each point and wave vector, whatever the number
of tapers. The allowed ones, multiples of 2 pi / L_a, come from one fast Fourier transform a taper of points
carried to a grid by a Kaiser-Bessel window of 8 cells, in float; a sum is off by some 1e-6 sqrt(n), a power
by 1e-12 of that of Poisson points.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import OVERSAMPLING, window
from gbnbench.analysis.window.tapers import ComplexArray, IntArray
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress

CELLS, DEGREE = 8, 11  # of the window that carries points to the grid
BLOCK = 1 << 20  # phases, or points times nodes, at a time
GRIDS = 1 << 25  # nodes of the grids that are filled together, 128 MB
LARGEST_GRID = 1 << 24  # nodes, 64 MB


def direct_sums(
    u: FloatArray,
    values: FloatArray,
    steps: FloatArray,
    progress: Progress,
    precision: Literal["double", "float"] = "double",
) -> ComplexArray:
    """Sum values exp(-2 pi i steps.u) over points.

    Parameters
    ----------
    u : (n, d) float64
        Points.
    values : (tapers, n) float64
        Each taper at the points.
    steps : (m, d) float64
        Wave vectors, in turns a unit of u.
    progress : Progress
        Advances by one a wave vector.
    precision : {"double", "float"}
        Of sines and cosines, and of their sums over a block of points; phases are reduced in double.

    Returns
    -------
    (tapers, m) complex128

    Notes
    -----
    n m sines and cosines: about 40 ns each pair in double, 5 ns in float, whose sums are off by some 1e-7
    sqrt(n).
    """
    n, m = len(u), len(steps)
    real: Any = np.float64 if precision == "double" else np.float32
    width = min(n, 1 << 12)
    height = max(1, BLOCK // width)
    total = np.zeros((len(values), m), np.complex128)
    for row in range(0, m, height):
        rows = slice(row, row + height)
        for begin in range(0, n, width):
            chunk = slice(begin, begin + width)
            turns = sum(np.outer(steps[rows, axis], u[chunk, axis]) for axis in range(u.shape[1]))
            turns -= np.rint(turns)
            turns *= 2 * math.pi
            phase: NDArray[Any] = turns.astype(real, copy=False)
            weights: NDArray[Any] = values[:, chunk].astype(real)
            # No product of matrices: these are slim, and its threads would stand in each other's way.
            total.real[:, rows] += np.einsum("tn,mn->tm", weights, np.cos(phase))
            total.imag[:, rows] -= np.einsum("tn,mn->tm", weights, np.sin(phase))
        progress.advance("structure factor", len(phase))
    return total


def nodes_for(reach: IntArray) -> tuple[int, ...]:
    """Choose the nodes of each axis's grid, for wave numbers up to reach[a] times 2 pi / L_a."""
    least = [max(math.ceil(OVERSAMPLING * (2 * m + 1)), 3 * CELLS) for m in reach.tolist()]
    return tuple(int(fft.next_fast_len(nodes, real=True)) for nodes in least)


def griddable(reach: IntArray) -> bool:
    """Tell whether the grid of these wave numbers is small enough."""
    return math.prod(nodes_for(reach)) <= LARGEST_GRID


class GriddedSums:
    """Tapered sums at all multiples m of 2 pi / L_a with |m_a| <= reach[a].

    Parameters
    ----------
    u : (n, d) float64
        Points as fractions of the window's sides.
    reach : (d,) int64
        Largest multiple on each axis.
    """

    def __init__(self, u: FloatArray, reach: IntArray) -> None:
        self._nodes = nodes_for(reach)
        self._shape = window(CELLS, DEGREE)
        self._gains = [
            self._shape.transform(int(most), nodes) for most, nodes in zip(reach, self._nodes, strict=True)
        ]
        place = u * np.array(self._nodes)
        cell = np.floor(place).astype(np.intp)
        order = np.argsort(cell[:, 0], kind="stable")  # neighbours on the grid follow one another
        self._order, self._cell, self._place = order, cell[order], (place - cell)[order]

    def of(self, values: FloatArray, multiples: IntArray) -> Iterator[ComplexArray]:
        """Sum each taper's values times exp(-2 pi i m.u).

        Parameters
        ----------
        values : (tapers, n) float64
            Each taper at the points.
        multiples : (m, d) int64
            Wave vectors within reach, the last coordinate at least 0.

        Yields
        ------
        (m,) complex128
            Of one taper after another.
        """
        index = tuple(multiples[:, axis] % nodes for axis, nodes in enumerate(self._nodes))
        together = max(1, GRIDS // math.prod(self._nodes))
        for first in range(0, len(values), together):
            for grid in self._carry(values[first : first + together, self._order]):
                found = fft.rfftn(grid, overwrite_x=True, workers=-1)[index].astype(np.complex128)
                for axis, gains in enumerate(self._gains):
                    found /= gains[np.abs(multiples[:, axis])]
                yield found

    def _carry(self, values: FloatArray) -> NDArray[np.float32]:
        """Spread the values of several tapers over the nodes around each point."""
        d = len(self._nodes)
        grids = np.zeros((len(values), *self._nodes), np.float32)
        flat = grids.reshape(len(values), -1)
        around = np.arange(CELLS) - CELLS // 2 + 1
        step = max(1, BLOCK // CELLS**d)
        for begin in range(0, values.shape[1], step):
            chunk = slice(begin, begin + step)
            count = len(self._cell[chunk])
            weight, node = np.ones((count, 1)), np.zeros((count, 1), np.intp)
            for axis, nodes in enumerate(self._nodes):
                near = (self._cell[chunk, axis, None] + around) % nodes
                at = self._shape.values(self._place[chunk, axis])
                node = (node[:, :, None] * nodes + near[:, None, :]).reshape(count, -1)
                weight = (weight[:, :, None] * at[:, None, :]).reshape(count, -1)
            first, last = int(node.min()), int(node.max()) + 1
            index = (node - first).ravel()
            for row, taper in zip(flat, values[:, chunk], strict=True):
                row[first:last] += np.bincount(index, (weight * taper[:, None]).ravel(), last - first)
        return grids
