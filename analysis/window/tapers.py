"""Orthogonal sine tapers of a box, their transforms and their overlaps, all in closed form.

On the unit interval h_p(u) = sqrt(2) sin(pi p u), p = 1, 2, ... (Riedel & Sidorenko 1995); on a box, products
of these over the axes (Rajala, Olhede, Grainger & Murrell 2023). They vanish at the border, so that little of
the power at one wave vector leaks to others far away.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

ComplexArray = NDArray[np.complex128]
IntArray = NDArray[np.int64]

MOST_TAPERS = 16  # of a box, as chosen by ``default_counts``
LOBES = 1 << 14  # half steps of pi / L over which a taper's energy is summed


def default_counts(sides: FloatArray) -> tuple[int, ...]:
    """Choose how many tapers each axis gets: four in 1D, two in 2D to 4D, one beyond; more on long sides.

    Parameters
    ----------
    sides : (d,) float64
        Lengths of the window's sides.

    Returns
    -------
    tuple of int
        Their product is at most 16.
    """
    d = len(sides)
    counts = [4] if d == 1 else [2 if d <= 4 else 1] * d
    if d <= 3:  # as many on a long side as give it the bandwidth of the shortest
        for axis in np.argsort(-sides, kind="stable").tolist():
            wanted = max(counts[axis], int(counts[axis] * sides[axis] / sides.min()))
            others = math.prod(counts) // counts[axis]
            counts[axis] = max(counts[axis], min(wanted, MOST_TAPERS // others))
    return tuple(counts)


@dataclass(frozen=True)
class SineTapers:
    """Sine tapers of the unit cube, for a window whose sides have these lengths.

    Attributes
    ----------
    sides : (d,) float64
        Lengths of the window's sides, in the points' unit.
    counts : tuple of int
        Tapers of each axis: orders 1 .. counts[a].

    Examples
    --------
    >>> tapers = SineTapers(np.array([2.0, 1.0]), (2, 1))
    >>> tapers.orders.tolist()
    [[1, 1], [2, 1]]
    >>> tapers.values(np.array([[0.5, 0.5]])).round(12).tolist()
    [[2.0], [0.0]]
    """

    sides: FloatArray
    counts: tuple[int, ...]

    @cached_property
    def orders(self) -> IntArray:
        """Order p on each axis: (tapers, d)."""
        grid = np.meshgrid(*(np.arange(1, count + 1) for count in self.counts), indexing="ij")
        return np.stack([axis.ravel() for axis in grid], axis=1)

    @cached_property
    def squared_bandwidths(self) -> FloatArray:
        """Mean square of the wave number under each taper, sum over a of (pi p_a / L_a)^2: (tapers,)."""
        squares: FloatArray = ((math.pi * self.orders / self.sides) ** 2).sum(axis=1)
        return squares

    @property
    def bandwidth(self) -> float:
        """Root mean square wave number under all tapers: what the window resolves, in radians a length."""
        return math.sqrt(float(self.squared_bandwidths.mean()))

    @property
    def correlation(self) -> float:
        """Factor by which the variance of a wide average exceeds that of as many independent powers.

        It is the integral of the square of the mean squared taper: the product of 1 + 1/(2 counts[a]).
        """
        return math.prod(1 + 0.5 / count for count in self.counts)

    def values(self, u: FloatArray) -> FloatArray:
        """Evaluate the tapers at fractions of the sides: (n, d) -> (tapers, n)."""
        return self._product(u, lambda p, at: math.sqrt(2) * np.sin(math.pi * p * at)).real

    def transforms(self, k: FloatArray) -> ComplexArray:
        """Integrate each taper times exp(-i k.x) over the window, x from its lower corner.

        Parameters
        ----------
        k : (m, d) float64
            Wave vectors, in radians a length.

        Returns
        -------
        (tapers, m) complex128
            In units of the window's volume.
        """
        return self._product(k * self.sides, _transform)

    def overlaps(self, k: FloatArray) -> ComplexArray:
        """Integrate each taper times the first times exp(-i k.x) over the window: (m, d) -> (tapers, m)."""
        return self._product(k * self.sides, lambda p, kappa: _overlap(p, 1, kappa))

    @cached_property
    def first_mean(self) -> float:
        """Integral of the first taper over the unit cube."""
        return float(self.transforms(np.zeros((1, len(self.sides))))[0, 0].real)

    def squared_overlaps(self, axis: int, steps: IntArray | FloatArray) -> FloatArray:
        """Sum over the pairs of an axis's tapers of the squared overlap, 2 pi steps / L_a apart.

        Parameters
        ----------
        axis : int
            The axis.
        steps : (m,) int64 or float64
            Differences of wave numbers in units of 2 pi / L_a.

        Returns
        -------
        (m,) float64
            ``counts[axis]`` at 0.
        """
        kappa = 2 * math.pi * np.asarray(steps, dtype=np.float64)
        orders = range(1, self.counts[axis] + 1)
        total = np.zeros(len(kappa))
        for p in orders:
            for q in orders:
                total += np.abs(_overlap(p, q, kappa)) ** 2
        return total

    def energy_beyond(self, axis: int, away: FloatArray) -> FloatArray:
        """Sum the energy of an axis's tapers, 1 in all, at wave numbers farther than ``away`` from 0.

        Parameters
        ----------
        axis : int
            The axis.
        away : (m,) float64
            Wave numbers, in radians a length, at least 0.

        Returns
        -------
        (m,) float64
            Mean over the axis's tapers. It falls as (L_a away)^-3.
        """
        kappa = math.pi * np.arange(float(LOBES))
        energy = np.mean([np.abs(_transform(p, kappa)) ** 2 for p in range(1, self.counts[axis] + 1)], axis=0)
        beyond = np.cumsum(energy[::-1])[::-1]  # every pi / L_a: exact, of both signs together
        first = np.ceil(away * self.sides[axis] / math.pi).astype(np.intp)
        found: FloatArray = beyond[np.minimum(first, LOBES - 1)]
        return found

    def _product(self, at: FloatArray, factor: Callable[[int, FloatArray], NDArray[Any]]) -> ComplexArray:
        """Multiply a factor of (order, coordinate) over the axes, tabulated at the distinct coordinates."""
        total = np.ones((len(self.orders), len(at)), np.complex128)
        for axis, count in enumerate(self.counts):
            distinct, place = np.unique(at[:, axis], return_inverse=True)
            table = [factor(p, distinct)[place.ravel()] for p in range(1, count + 1)]
            for row, p in zip(total, self.orders[:, axis].tolist(), strict=True):
                row *= table[p - 1]
        return total


def _mean_wave(y: FloatArray) -> ComplexArray:
    """Integrate exp(i y u) over the unit interval."""
    return np.asarray(np.exp(0.5j * y) * np.sinc(y / (2 * math.pi)), np.complex128)


def _transform(p: int, kappa: FloatArray) -> ComplexArray:
    return (_mean_wave(math.pi * p - kappa) - _mean_wave(-math.pi * p - kappa)) / (1j * math.sqrt(2))


def _overlap(p: int, q: int, kappa: FloatArray) -> ComplexArray:
    """Integrate 2 sin(pi p u) sin(pi q u) exp(-i kappa u) over the unit interval."""
    parts: Sequence[ComplexArray] = [
        sign * (_mean_wave(math.pi * s - kappa) + _mean_wave(-math.pi * s - kappa))
        for sign, s in ((0.5, p - q), (-0.5, p + q))
    ]
    return parts[0] + parts[1]
