"""Sums over points of the waves of listed frequencies, exact to rounding, as products of two tables.

The axes part in a leading and a trailing group. With c + i s = exp(2 pi i f.x) of each group, a frequency
(f, +-g) needs the four sums of cc, cs, sc and ss over the points: one real matrix product of the two tables.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.integer_frequencies import IntArray
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.axis_waves import ComplexArray, axis_waves, rising_waves
from gbnbench.generators.gauss_newton.distinct_frequencies import distinct_frequencies

BLOCK = 2**20  # entries of the two tables of one block of points
HELD = 2**25  # entries kept from one product to the next where all blocks fit
TILE = 64  # side of what BLAS multiplies at once


class WaveSums:
    """The waves exp(2 pi i f.x) of listed frequencies at the points x.

    Parameters
    ----------
    x : (n, d) float64
        Points, box sides.
    f : (m, d) int64
        Frequencies, the first component that is not 0 being positive; |f_a| < 2**27.
    single : bool
        Multiply the tables in single precision: half the time, 1e-6 of sqrt(n).

    Notes
    -----
    In double a sum's error is about 5e-16 sqrt(n), at any frequency: phases are reduced to a part of a turn
    exactly, the coordinate being split so that its product with f does not round.
    """

    def __init__(self, x: FloatArray, f: IntArray, *, single: bool = False) -> None:
        self.x = x
        self.lead = math.ceil(x.shape[1] / 2)
        self._kind: type[Any] = np.complex64 if single else np.complex128
        self._real: type[Any] = np.float32 if single else np.float64
        self._first, self._row = distinct_frequencies(f[:, : self.lead])
        trailing = f[:, self.lead :]
        self._sign = _signs(trailing)
        self._second, self._column = distinct_frequencies(trailing * self._sign[:, None])
        self.shape = 2 * len(self._first), 2 * len(self._second)
        width = len(self._first) + len(self._second)
        self._size = max(64, BLOCK // width)
        self._kept: list[tuple[slice, NDArray[Any], NDArray[Any]]] | None = None
        self._keeps = len(x) * width <= HELD

    def amplitudes(self) -> ComplexArray:
        """Return F_f = sum_k exp(-2 pi i f.x_k), (m,) complex128."""
        sums = np.zeros(self.shape)
        for _, first, second in self._blocks():
            sums += steady_product(first.view(self._real).T, second.view(self._real))
        return self._gather(sums, self._sign)

    def gradient(self, y: ComplexArray, side: float) -> FloatArray:
        """Return the gradient at each point of sum_f Re(y_f exp(i q.u)), u being x in spacings.

        Parameters
        ----------
        y : (m,) complex128
            Weights of the waves.
        side : float
            Of the box, in spacings.

        Returns
        -------
        (n, d) float64
            Per spacing.
        """
        weights = np.zeros(self.shape)
        for sign in (1, -1):  # within one sign no place comes twice
            some = self._sign == sign
            row, column, value = 2 * self._row[some], 2 * self._column[some], y[some]
            weights[row, column] += value.real
            weights[row + 1, column + 1] -= sign * value.real
            weights[row + 1, column] -= value.imag
            weights[row, column + 1] -= sign * value.imag
        weights = weights.astype(self._real)
        out = np.empty(self.x.shape)
        turn = 2 * math.pi / side
        for block, first, second in self._blocks():
            beside = steady_product(second.view(self._real), weights.T).view(self._kind)
            out[block, : self.lead] = _combine(np.imag(np.conj(first) * beside), turn * self._first)
            if self.lead < self.x.shape[1]:
                beside = steady_product(first.view(self._real), weights).view(self._kind)
                out[block, self.lead :] = _combine(np.imag(np.conj(second) * beside), turn * self._second)
        return out

    def divergence(self, move: FloatArray, side: float) -> ComplexArray:
        """Return sum_k (q.move_k) exp(-i q.u_k), the transpose of ``gradient``.

        Parameters
        ----------
        move : (n, d) float64
            Displacements, in spacings.
        side : float
            Of the box, in spacings.

        Returns
        -------
        (m,) complex128
        """
        leading, trailing = np.zeros(self.shape), np.zeros(self.shape)
        turn = 2 * math.pi / side
        for block, first, second in self._blocks():
            weight = _combine(move[block, : self.lead], turn * self._first.T)
            weighted = (first * weight).astype(self._kind)
            leading += steady_product(weighted.view(self._real).T, second.view(self._real))
            if self.lead < self.x.shape[1]:
                weight = _combine(move[block, self.lead :], turn * self._second.T)
                weighted = (second * weight).astype(self._kind)
                trailing += steady_product(first.view(self._real).T, weighted.view(self._real))
        return self._gather(leading, self._sign) + self._sign * self._gather(trailing, self._sign)

    def _gather(self, sums: FloatArray, sign: IntArray) -> ComplexArray:
        """Turn sums of products of cosines and sines into those of exp(-i (first + sign second))."""
        row, column = 2 * self._row, 2 * self._column
        out = np.empty(len(row), np.complex128)
        out.real = sums[row, column] - sign * sums[row + 1, column + 1]
        out.imag = -(sums[row + 1, column] + sign * sums[row, column + 1])
        return out

    def _blocks(self) -> Iterator[tuple[slice, NDArray[Any], NDArray[Any]]]:
        """Blocks of points with exp(2 pi i f.x) of both groups."""
        if self._kept is not None:
            yield from self._kept
            return
        kept = []
        for start in range(0, len(self.x), self._size):
            block = slice(start, start + self._size)
            x = self.x[block]
            first = self._table(x[:, : self.lead], self._first)
            second = self._table(x[:, self.lead :], self._second)
            if self._keeps:
                kept.append((block, first, second))
            yield block, first, second
        if self._keeps:
            self._kept = kept

    def _table(self, x: FloatArray, f: IntArray) -> NDArray[Any]:
        """Multiply the waves of each axis: (points, m)."""
        table: ComplexArray | None = None
        for a in range(x.shape[1]):
            fmax = int(np.abs(f[:, a]).max())
            # A negative frequency indexes from the end. The first axis of a half space has none.
            axis = axis_waves(x[:, a], fmax) if f[:, a].min() < 0 else rising_waves(x[:, a], fmax)
            waves = np.take(axis, f[:, a], axis=1)
            table = waves if table is None else np.multiply(table, waves, out=table)
        return (np.ones((len(x), len(f))) if table is None else table).astype(self._kind, copy=False)


def steady_product(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """Multiply matrices to the same bits whatever the number of threads.

    Parameters
    ----------
    a : (k, m)
        Any numbers.
    b : (m, l)
        Of the same type.

    Returns
    -------
    (k, l)

    Notes
    -----
    BLAS parts a large product in ways that depend on its threads, and adds in another order; tiles of 64**3
    are below what OpenBLAS parts at all, and cost a few percent.
    """
    whole = a.shape[1] // TILE * TILE
    out = np.empty((a.shape[0], b.shape[1]), a.dtype)
    for i in range(0, a.shape[0], TILE):
        left = a[i : i + TILE]
        layers = left[:, :whole].reshape(len(left), -1, TILE).transpose(1, 0, 2)
        for j in range(0, b.shape[1], TILE):
            right = b[:, j : j + TILE]
            tile = left[:, whole:] @ right[whole:]
            if whole:
                tile += np.matmul(layers, right[:whole].reshape(-1, TILE, right.shape[1])).sum(axis=0)
            out[i : i + TILE, j : j + TILE] = tile
    return out


def _combine(a: NDArray[Any], b: NDArray[Any]) -> FloatArray:
    """Multiply a thin matrix without BLAS, for the same reason."""
    product: FloatArray = np.einsum("ij,jk->ik", a, b)
    return product


def _signs(f: IntArray) -> IntArray:
    """Return -1 where the first component that is not 0 is negative, else 1: (m,)."""
    if f.shape[1] == 0:
        return np.ones(len(f), np.int64)
    leading = f[np.arange(len(f)), np.argmax(f != 0, axis=1)]
    return np.where(leading < 0, -1, 1)
