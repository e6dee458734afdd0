"""Preconditioner of the lowest band: its modes of displacement, divided by their own curvature.

A displacement u_k = q cos(q.x_k) changes the density at q alone, with the curvature
lambda_q = |q|^2 (2 pi)^(d/2) sigma^d exp(-sigma^2 |q|^2 / 2), which falls with |q|^2: in large sets the
lowest modes need far more steps than the middle band. Only nu <= 0.15 is treated; reaching nu >= 0.4 hurts.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.torus import FloatArray

EDGE = 0.15


class LowBand:
    """Modes with 0 < nu <= 0.15 of n points in d dimensions, as a grid of two groups of dimensions."""

    def __init__(self, n: int, d: int, sigma: float) -> None:
        side = n ** (1 / d)
        self._n = n
        self._leading = d // 2
        self._f = np.arange(-math.floor(EDGE * side), math.floor(EDGE * side) + 1)
        grid = np.stack(np.meshgrid(*[self._f] * d, indexing="ij"))  # (d, ...) frequencies
        q2 = (2 * math.pi / side) ** 2 * np.sum(grid**2, axis=0)
        inside = (q2 > 0) & (q2 <= (2 * math.pi * EDGE) ** 2)
        curvature = np.where(
            inside, q2 * (2 * math.pi) ** (d / 2) * sigma**d * np.exp(-(sigma**2) * q2 / 2), 1
        )
        self._inverse = np.where(inside, 1 / curvature, 0.0)
        self._inside = inside
        self._direction = np.where(inside, 2 * math.pi / side * grid / np.sqrt(np.maximum(q2, 1e-300)), 0.0)

    def _waves(self, x: FloatArray) -> NDArray[np.complex128]:
        """exp(-2 pi i f.x) over the grid of one group of dimensions: (n, modes)."""
        table = np.ones((len(x), 1), np.complex128)
        for coordinate in x.T:
            axis = np.exp(-2j * np.pi * coordinate[:, None] * self._f)
            table = (table[:, :, None] * axis[:, None, :]).reshape(len(x), -1)
        return table

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
        if not self._inside.any():
            return np.zeros_like(gradient)
        first, second = self._waves(x[:, : self._leading]), self._waves(x[:, self._leading :])
        shape = self._inverse.shape
        along = np.zeros(shape, np.complex128)
        for a in range(x.shape[1]):
            along += self._direction[a] * ((first * gradient[:, a : a + 1]).T @ second).reshape(shape)
        # f and -f stand both in the grid: together they are the cosine and the sine mode, each of
        # squared norm n/2.
        along *= np.where(self._inside, self._inverse - size, 0.0) / self._n
        out = np.empty_like(gradient)
        for a in range(x.shape[1]):
            coefficient = (self._direction[a] * along).reshape(first.shape[1], second.shape[1])
            out[:, a] = np.einsum("km,km->k", first.conj(), second.conj() @ coefficient.T).real
        return out
