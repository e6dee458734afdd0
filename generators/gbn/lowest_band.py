"""Preconditioner of the lowest band: its modes of displacement, divided by their own curvature.

A displacement u_k = q cos(q.x_k) changes the density at q alone, with the curvature lambda_q = |q|^2 w(q), w
being the kernel's transform. For a Gaussian it falls with |q|^2: in large sets the lowest modes need far more
steps than the middle band. Only nu <= 0.15 is treated; reaching nu >= 0.4 hurts.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft, sparse

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.step_sizes import Curvature

EDGE = 0.15  # in nu
STEP = 0.75  # of the grid, in spacings: the cubic spline's aliases are 3e-4 of the band
SLACK = 0.02  # moves in spacings over which a point keeps its weights: 2% of the band's fastest phase


class LowestBandPreconditioner:
    """Modes with 0 < nu <= 0.15 of a set of n points in d dimensions, by a grid: n log n.

    Points give their forces to a grid by cubic B-splines and take displacements from it by the same weights,
    so that the correction is a symmetric operator of the forces; single precision is more than it needs,
    since the forces that it reads vanish where it has done its work.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    curvature : callable
        lambda_q at |q|^2, q = 2 pi f n^(-1/d).
    """

    def __init__(self, n: int, d: int, curvature: Curvature) -> None:
        side = n ** (1 / d)
        self._n, self._d, self._side = n, d, side
        self._cells = fft.next_fast_len(max(4, math.ceil(side / STEP)), real=True)
        whole = fft.fftfreq(self._cells, 1 / self._cells)
        half = fft.rfftfreq(self._cells, 1 / self._cells)
        f = np.meshgrid(*[whole] * (d - 1), half, indexing="ij", sparse=True)
        q2 = sum((2 * math.pi / side * axis) ** 2 for axis in f)
        inside = (q2 > 0) & (q2 <= (2 * math.pi * EDGE) ** 2)
        q2 = np.where(inside, q2, 1.0)
        self._curvature = curvature(q2)
        spline = np.ones(())
        for axis in f:
            spline = spline * np.sinc(axis / self._cells) ** 4
        # Once for giving and once for taking; the inverse transform divides by the number of cells.
        self._weight = np.where(inside, self._cells**d / (self._n * spline**2), 0.0)
        self._direction = [2 * math.pi / side * axis / np.sqrt(q2) for axis in f]
        self.anchor: FloatArray | None = None

    def correction(self, x: FloatArray, gradient: FloatArray, size: float) -> FloatArray:
        """Return what to add to size * gradient so that each mode is divided by its own curvature.

        Parameters
        ----------
        x : (n, d) float64
            Points, box sides.
        gradient : (n, d) float64
            In spacings.
        size : float
            The step that the rest takes.

        Returns
        -------
        (n, d) float64
            sum over the band of (1 / lambda_q - size) times the gradient's projection on the mode.
        """
        if self.anchor is None or np.abs(x - self.anchor).max() > SLACK / self._side:
            self.place(x)
        shape = (self._cells,) * self._d
        given = self._splines.T @ gradient.astype(np.float32)
        along = np.zeros(self._weight.shape, np.complex64)
        for a, direction in enumerate(self._direction):
            along += direction.astype(np.float32) * fft.rfftn(given[:, a].reshape(shape))
        along *= (self._weight * (1 / self._curvature - size)).astype(np.float32)
        taken = np.empty((math.prod(shape), self._d), np.float32)
        for a, direction in enumerate(self._direction):
            taken[:, a] = fft.irfftn(direction.astype(np.float32) * along, shape).ravel()
        out: FloatArray = (self._splines @ taken).astype(np.float64)
        return out

    def place(self, x: FloatArray) -> None:
        """Find the weights of points (n, d), four on each axis."""
        self.anchor = x.copy()
        cell: NDArray[Any] = np.zeros((self._n, 1), np.int32)
        weight: NDArray[Any] = np.ones((self._n, 1), np.float32)
        for a in range(self._d):
            at = (x[:, a] - np.floor(x[:, a])) * self._cells
            first = np.floor(at)
            t = (at - first).astype(np.float32)
            back = 1 - t
            middle = (4 - 6 * t**2 + 3 * t**3, 4 - 6 * back**2 + 3 * back**3)
            four = np.stack([back**3, *middle, t**3], 1)
            near = (first.astype(np.int32)[:, None] + np.arange(-1, 3, dtype=np.int32)) % self._cells
            cell = (cell[:, :, None] * self._cells + near[:, None, :]).reshape(self._n, -1)
            weight = (weight[:, :, None] * (four / 6)[:, None, :]).reshape(self._n, -1)
        taps = cell.shape[1]
        ends = np.arange(0, taps * self._n + 1, taps, dtype=np.int32 if taps * self._n < 2**31 else np.int64)
        size = (self._n, self._cells**self._d)
        self._splines = sparse.csr_matrix((weight.ravel(), cell.ravel(), ends), shape=size)
