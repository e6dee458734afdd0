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

EDGE = 0.15  # in nu


class LowBand:
    """Modes with 0 < nu <= 0.15 of n points in d dimensions, in single precision: 1e-3 would do.

    The modes are a grid over two groups of dimensions; f and -f being one mode, the first axis takes f >= 0.
    """

    def __init__(self, n: int, d: int, sigma: float) -> None:
        side = math.pow(n, 1 / d)
        self._reach = math.floor(EDGE * side)
        self._leading = max(1, d // 2)
        axes = [np.arange(0 if a == 0 else -self._reach, self._reach + 1) for a in range(d)]
        q = 2 * math.pi / side * np.stack(np.meshgrid(*axes, indexing="ij"))  # (d, modes of each axis...)
        q2 = np.sum(q**2, axis=0)
        inside = (q2 > 0) & (q2 <= (2 * math.pi * EDGE) ** 2)
        # A mode on the plane f_0 = 0 stands there twice, as f and as -f.
        self._weight = np.where(inside, np.where(q[0] > 0, 2.0, 1.0), 0.0) / n
        q2[~inside] = 1.0
        self._inverse = 1 / (q2 * (2 * math.pi) ** (d / 2) * sigma**d * np.exp(-(sigma**2) * q2 / 2))
        self._direction = q / np.sqrt(q2)

    def _waves(self, x: FloatArray, first: bool) -> NDArray[np.complex64]:
        """exp(-2 pi i f.x) over the grid of one group of dimensions: (n, modes)."""
        table = np.ones((len(x), 1), np.complex64)
        for a, coordinate in enumerate(x.T):
            powers = np.ones((len(x), self._reach + 1), np.complex64)
            powers[:, 1:] = np.exp(-2j * np.pi * coordinate)[:, None]
            axis = np.cumprod(powers, axis=1)
            if not (first and a == 0):
                axis = np.concatenate([axis[:, :0:-1].conj(), axis], axis=1)
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
        out = np.zeros_like(gradient)
        if not self._weight.any():
            return out
        first = self._waves(x[:, : self._leading], first=True)
        second = self._waves(x[:, self._leading :], first=False)
        shape = self._inverse.shape
        force = gradient.astype(np.float32)
        along = np.zeros(shape, np.complex128)
        for a, direction in enumerate(self._direction):
            along += direction * (first.T @ (second * force[:, a : a + 1])).reshape(shape)
        along *= self._weight * (self._inverse - size)
        backward = second.conj()
        for a, direction in enumerate(self._direction):
            coefficient = (direction * along).astype(np.complex64).reshape(first.shape[1], second.shape[1])
            # Re(conj(first) (backward @ coefficient.T)), summed over the first group's modes
            wave = backward @ coefficient.T
            out[:, a] = np.einsum("km,km->k", first.real, wave.real) + np.einsum(
                "km,km->k", first.imag, wave.imag
            )
        return out
