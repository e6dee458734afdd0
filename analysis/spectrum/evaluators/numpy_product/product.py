"""The exact periodogram in plain numpy as one product of two tables, for machines without an OpenCL device.

exp(-2 pi i f.x) is a product over axes, which are divided in a leading and a trailing group. Cosines and
sines of each group's half space are tabulated for a chunk of points. One real matrix product gives four sums,
from which F(fa, fb) and F(fa, -fb) follow, and the other two quadrants by Hermitian symmetry. This takes two
flops for each frequency and point instead of eight.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.evaluators.numpy_product.phase_tables import (
    group_table,
    half_count,
    phasors,
    product_axes,
    real_type,
)
from gbnbench.core.torus import FloatArray, fixed_point

CHUNK = 256  # points that one product sums in the given precision; chunks are added up in double
TABLE_BYTES = 48 << 20  # of both groups' tables of a chunk, and of what is needed to make them
BLOCK_BYTES = 8 << 20  # of the sums of one product before they are added up
LISTED = 1 << 19  # phases that are evaluated at a time for listed frequencies


def numpy_power(
    x: FloatArray, fmax: int, precision: str = "double", weights: FloatArray | None = None
) -> FloatArray:
    """Power of one point set at every integer frequency with |f_a| <= fmax.

    Parameters
    ----------
    x : (n, d) float64
        Checked points of the unit torus.
    fmax : int
        Largest harmonic on each axis, cycles per unit length.
    precision : {"double", "float"}
        Precision of tables and of sums over 256 points; these sums are added up in double either way.
    weights : (n,) float64, optional
        A weight for each point, 1 without.

    Returns
    -------
    (2*fmax+1,)*d float64
        |sum_k w_k exp(-2 pi i f.x_k)|^2 / sum_k w_k^2, zero frequency at the centre.

    Raises
    ------
    InputError
        If precision is neither of the two.

    Notes
    -----
    It takes the memory of two cubes and some 64 MB. ``numpy_errors`` states its errors.

    Examples
    --------
    >>> numpy_power(np.array([[0.0], [0.5]]), 2)
    array([2., 0., 2., 0., 2.])
    """
    real = real_type(precision)
    d = x.shape[1]
    turns, fmaxes = product_axes(fixed_point(x, 64).T, fmax)
    scaled, squares = scaled_weights(weights, len(x))
    leading = len(fmaxes) // 2
    a, b = (half_count(group) for group in (fmaxes[:leading], fmaxes[leading:]))
    sums = np.zeros((2 * a, 2 * b))
    rows = 2 * max(1, BLOCK_BYTES // (4 * b * np.dtype(real).itemsize))
    product = np.empty((min(rows, 2 * a), 2 * b), real)
    for chunk in _chunks(len(x), bytes_per_point(fmaxes, real)):
        table_a = group_table(turns[:leading, chunk], fmaxes[:leading], real, axis=1)
        table_b = group_table(turns[leading:, chunk], fmaxes[leading:], real, axis=0)
        if scaled is not None:
            table_a *= scaled[chunk].astype(real)
        for row in range(0, 2 * a, rows):
            block = sums[row : row + rows]
            block += np.matmul(table_a[row : row + rows], table_b.T, out=product[: len(block)])
    cube = _cube_of(sums.reshape(a, 2, 2, b), squares)
    if d == 1:
        beyond = (cube.size - 1) // 2 - fmax
        cube = cube.ravel()[beyond : cube.size - beyond]
    return cube.reshape((2 * fmax + 1,) * d)


def numpy_listed_power(
    x: FloatArray,
    frequencies: NDArray[np.int64],
    precision: str = "double",
    weights: FloatArray | None = None,
) -> FloatArray:
    """Power of one point set at listed frequencies, by one sine and cosine for each point and frequency.

    Parameters
    ----------
    x : (n, d) float64
        Checked points of the unit torus.
    frequencies : (m, d) int64
        Any integers; phases wrap exactly.
    precision : {"double", "float"}
        Precision of sines and cosines; they are added up in double either way.
    weights : (n,) float64, optional
        A weight for each point, 1 without.

    Returns
    -------
    (m,) float64
        |sum_k w_k exp(-2 pi i f.x_k)|^2 / sum_k w_k^2.

    Raises
    ------
    InputError
        If precision is neither of the two.

    Examples
    --------
    >>> numpy_listed_power(np.array([[0.0], [0.5]]), np.array([[2**40], [2**40 + 1]]))
    array([2., 0.])
    """
    real = real_type(precision)
    turns = fixed_point(x, 64).T
    multiples = frequencies.astype(np.uint64)
    scaled, squares = scaled_weights(weights, len(x))
    width = min(len(x), LISTED)
    height = max(1, LISTED // width)
    amplitude = np.zeros(len(frequencies), np.complex128)
    for row in range(0, len(frequencies), height):
        block = multiples[row : row + height]
        for begin in range(0, len(x), width):
            chunk = slice(begin, begin + width)
            phase = block[:, :1] * turns[0, chunk]
            for axis in range(1, len(turns)):
                phase += block[:, axis : axis + 1] * turns[axis, chunk]
            wave = phasors(phase, real)
            if scaled is not None:
                wave *= scaled[chunk].astype(real)
            amplitude[row : row + height] += wave.sum(axis=1, dtype=np.complex128)
    power: FloatArray = (amplitude.real**2 + amplitude.imag**2) / squares
    return power


def scaled_weights(weights: FloatArray | None, n: int) -> tuple[FloatArray | None, float]:
    """Divide weights by the largest, so that nothing overflows in float, and sum their squares.

    Parameters
    ----------
    weights : (n,) float64 or None
        Weights of the points.
    n : int
        Number of points.

    Returns
    -------
    scaled : (n,) float64 or None
    squares : float
        Sum of the squares; n without weights.
    """
    if weights is None:
        return None, float(n)
    scaled = weights / np.abs(weights).max()
    return scaled, float(scaled @ scaled)


def bytes_per_point(fmaxes: list[int], real: type[np.floating[Any]]) -> int:
    """Size what a point needs: a group's complex table while it is made, and both real tables.

    Parameters
    ----------
    fmaxes : list of int
        Largest multiple on each axis.
    real : type
        float64 or float32.

    Returns
    -------
    int
        Bytes.
    """
    leading = len(fmaxes) // 2
    a, b = (half_count(group) for group in (fmaxes[:leading], fmaxes[leading:]))
    return (4 * max(a, b) + 2 * (a + b)) * np.dtype(real).itemsize


def chunk_points(per_point: int) -> int:
    """Choose how many points a chunk has, from the bytes that one point needs."""
    return min(CHUNK, max(1, TABLE_BYTES // per_point))


def _chunks(n: int, per_point: int) -> list[slice]:
    points = chunk_points(per_point)
    return [slice(begin, min(n, begin + points)) for begin in range(0, n, points)]


def _cube_of(sums: FloatArray, squares: float) -> FloatArray:
    """Compute all four quadrants of power from four sums: (a, 2, 2, b) -> (2 a - 1, 2 b - 1)."""
    a, b = sums.shape[0], sums.shape[3]
    cube = np.empty((2 * a - 1, 2 * b - 1))
    rows = max(1, BLOCK_BYTES // (32 * b))
    for row in range(0, a, rows):
        (cc, cs), (sc, ss) = np.moveaxis(sums[row : row + rows], 0, 2)
        half = cube[a - 1 + row : a - 1 + row + len(cc)]
        half[:, : b - 1] = ((cc + ss) ** 2 + (sc - cs) ** 2)[:, :0:-1]
        half[:, b - 1 :] = (cc - ss) ** 2 + (sc + cs) ** 2
        half /= squares
    cube[: a - 1] = cube[: a - 1 : -1, ::-1]
    return cube
