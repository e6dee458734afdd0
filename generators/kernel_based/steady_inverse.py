"""Inverses of positive definite matrices by tiles (Cholesky), the same bits on any number of threads."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.wave_sums import TILE, steady_product


def steady_inverse(a: FloatArray) -> FloatArray:
    """Invert a symmetric positive definite matrix to the same bits whatever the number of threads.

    Parameters
    ----------
    a : (n, n) float64
        Symmetric and positive definite.

    Returns
    -------
    (n, n) float64

    Notes
    -----
    LAPACK parts large matrices in ways that depend on the threads of BLAS; of 64**2 it does not.

    Examples
    --------
    >>> steady_inverse(np.array([[4.0, 2.0], [2.0, 2.0]]))
    array([[ 0.5, -0.5],
           [-0.5,  1. ]])
    """
    root = _inverse_of_triangle(_cholesky(a))
    return steady_product(np.ascontiguousarray(root.T), root)


def _cholesky(a: FloatArray) -> FloatArray:
    """Lower triangle L of a = L L', a tile of columns after another."""
    lower = np.zeros_like(a)
    for start in range(0, len(a), TILE):
        end = start + TILE
        column = a[start:, start:end]
        if start:
            column = column - steady_product(
                lower[start:, :start], np.ascontiguousarray(lower[start:end, :start].T)
            )
        corner = np.linalg.cholesky(column[:TILE])
        lower[start:end, start:end] = corner
        if end < len(a):
            lower[end:, start:end] = steady_product(
                column[TILE:], np.ascontiguousarray(np.linalg.inv(corner).T)
            )
    return lower


def _inverse_of_triangle(lower: FloatArray) -> FloatArray:
    """Inverse of a lower triangle by halves."""
    n = len(lower)
    if n <= TILE:
        return np.asarray(np.linalg.inv(lower), np.float64)
    half = n // (2 * TILE) * TILE or TILE
    inverse = np.zeros_like(lower)
    inverse[:half, :half] = _inverse_of_triangle(lower[:half, :half])
    inverse[half:, half:] = _inverse_of_triangle(lower[half:, half:])
    beside = steady_product(lower[half:, :half], inverse[:half, :half])
    inverse[half:, :half] = -steady_product(inverse[half:, half:], beside)
    return inverse
