"""Energies sum over f of w(f) |F(f)|**2 and their gradients through a mesh, in n log n (non-uniform FFT)."""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

WINDOW = 10  # mesh points an axis that a point is spread over
SHAPE = 2.3 * WINDOW  # of exp(SHAPE (sqrt(1 - z**2) - 1)), for a mesh twice as fine as the frequencies need


class MeshEnergy:
    """The energy (1/2n) sum over f of w(f) |F(f)|**2 on a mesh, w even in every component.

    Parameters
    ----------
    weights : (fmax + 1,) * d float64
        w at f >= 0; its own at f = 0 counts for nothing.
    n : int
        Points.

    Notes
    -----
    Points are spread over a mesh by the exponential of a semicircle (Barnett, Magland & af Klinteberg 2019),
    10 mesh points wide, and the gradient is the exact derivative of what the mesh sums up. The error of F is
    some 1e-9 sqrt(n).
    """

    def __init__(self, weights: FloatArray, n: int) -> None:
        from scipy.fft import next_fast_len

        self.n, self.d = n, weights.ndim
        fmax = weights.shape[0] - 1
        self.mesh = int(next_fast_len(max(4 * fmax + 2, 2 * WINDOW), real=True))
        window = _transform(fmax, self.mesh)
        full = np.zeros((self.mesh,) * (self.d - 1) + (self.mesh // 2 + 1,))
        scaled = weights / functools.reduce(np.multiply.outer, [window**2] * self.d)
        scaled[(0,) * self.d] = 0.0
        both = np.r_[0 : fmax + 1, -fmax:0]
        full[np.ix_(*[both] * (self.d - 1), np.arange(fmax + 1))] = scaled[
            np.ix_(*[np.abs(both)] * (self.d - 1), np.arange(fmax + 1))
        ]
        self._weights = full * (self.mesh**self.d / n)

    def __call__(self, x: FloatArray) -> tuple[float, FloatArray]:
        """Evaluate.

        Parameters
        ----------
        x : (n, d) float64
            Points in [0, 1).

        Returns
        -------
        energy : float
        gradient : (n, d) float64
            By the coordinates in spacings.
        """
        from scipy.fft import irfftn, rfftn

        place = x * self.mesh
        first = np.floor(place).astype(np.intp) - (WINDOW // 2 - 1)
        z = (first[:, :, None] + np.arange(WINDOW) - place[:, :, None]) / (WINDOW / 2)
        root = np.sqrt(np.maximum(1 - z**2, 1e-6))  # the slope has a pole at the window's very end
        value = np.exp(SHAPE * (root - 1))
        slope = SHAPE * z / root * value * (self.mesh / (WINDOW / 2))  # by x, hence the sign
        index = (first[:, :, None] + np.arange(WINDOW)) % self.mesh
        flat = index[:, 0]
        for axis in range(1, self.d):
            flat = (flat[:, :, None] * self.mesh + index[:, axis, None, :]).reshape(len(x), -1)
        spread = np.bincount(flat.ravel(), _product(value).ravel(), self.mesh**self.d)
        spread = spread.reshape((self.mesh,) * self.d)
        potential = irfftn(rfftn(spread) * self._weights, s=spread.shape)
        near = potential.ravel()[flat]
        gradient = np.empty_like(x)
        for axis in range(self.d):
            factors = value.copy()
            factors[:, axis] = slope[:, axis]
            gradient[:, axis] = np.einsum("nw,nw->n", near, _product(factors))
        return 0.5 * float(np.vdot(spread, potential)), gradient / len(x) ** (1 / self.d)


def _product(factors: FloatArray) -> FloatArray:
    """Outer product over the axes of each point, (n, WINDOW**d) from (n, d, WINDOW)."""
    product = factors[:, 0]
    for axis in range(1, factors.shape[1]):
        product = (product[:, :, None] * factors[:, axis, None, :]).reshape(len(factors), -1)
    return product


def _transform(fmax: int, mesh: int) -> FloatArray:
    """Fourier transform of the window at f = 0 to fmax, in mesh points."""
    nodes, node_weights = np.polynomial.legendre.leggauss(64)
    window: NDArray[np.float64] = np.exp(SHAPE * (np.sqrt(1 - nodes**2) - 1))
    phase = np.cos(np.pi * WINDOW / mesh * np.outer(np.arange(fmax + 1), nodes))
    return np.asarray(phase @ (node_weights * window) * (WINDOW / 2))
