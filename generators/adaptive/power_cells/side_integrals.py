"""Exact integrals of a density over polygons, side by side: each pixel has one density (Green's theorem).

With G(u, v) the integral of the density rho along row u from 0 to v, the mass of a polygon is that of -G du
along its sides, counterclockwise. Within a pixel G is linear in v, so that a side is cut where it leaves a
pixel, and each part has a closed form. First and second moments are had alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density


@dataclass(frozen=True)
class SideIntegrals:
    """What each side contributes to the polygon on its left.

    Attributes
    ----------
    mass : (m,) float64
        To the integral of the density.
    moment : (m, 2) float64
        To that of the density times the position, from the origin.
    square : (m,) float64
        To that of the density times the squared distance from the origin.
    line : (m,) float64
        Integral of the density along the side.
    """

    mass: FloatArray
    moment: FloatArray
    square: FloatArray
    line: FloatArray


class DensityIntegral:
    """Sums of a density's pixels along rows, from which integrals along sides are had.

    Parameters
    ----------
    density : Density
        Of an image. Beyond its borders it is 0, or goes on as on the torus.
    background : float
        Part of the whole, added evenly over all pixels, >= 0.

    Attributes
    ----------
    values : (rows, columns) float64
        What is integrated, adding up to 1.
    """

    def __init__(self, density: Density, background: float = 0.0) -> None:
        values = density.of_points(1) + background / density.values.size
        self.values = values / values.sum()
        self._toroidal = density.toroidal
        column = np.arange(density.shape[1])
        # Moments of a pixel's row from j to j + 1: 1, v and v^2.
        powers = (1.0, column + 0.5, column * (column + 1.0) + 1 / 3)
        self._sums = [np.cumsum(self.values * power, axis=1) for power in powers]

    def along(self, start: FloatArray, end: FloatArray) -> SideIntegrals:
        """Integrate along sides.

        Parameters
        ----------
        start, end : (m, 2) float64
            Their ends, in pixels, beyond the borders or not.

        Returns
        -------
        SideIntegrals
        """
        side, begin, length = self._parts(start, end)
        way = (end - start)[side]
        middle = start[side] + (begin + length / 2)[:, None] * way
        half = 0.5 * length[:, None] * way
        u, v, across = middle[:, 0], middle[:, 1], half[:, 0] * half[:, 1] / 3
        rho, row, first, second = self._along_row(u, v)
        du = -2 * half[:, 0]
        by_u = u * row + across * rho
        by_v = first + rho * half[:, 1] ** 2 / 6
        squares = (
            (u**2 + half[:, 0] ** 2 / 3) * row + 2 * u * across * rho + second + rho * v * half[:, 1] ** 2 / 3
        )
        totals = [
            np.bincount(side, values, len(start)).astype(np.float64)
            for values in (du * row, du * by_u, du * by_v, du * squares, rho * length)
        ]
        return SideIntegrals(
            mass=totals[0],
            moment=np.stack(totals[1:3], axis=1),
            square=totals[3],
            line=totals[4] * np.linalg.norm(end - start, axis=1),
        )

    def _parts(self, start: FloatArray, end: FloatArray) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
        """Cut sides at the lines between pixels: the side of each part, where it begins, its length."""
        sides, cuts = [np.arange(len(start))], [np.zeros(len(start))]
        for a in range(2):
            low, high = np.minimum(start[:, a], end[:, a]), np.maximum(start[:, a], end[:, a])
            first, last = np.floor(low) + 1, np.ceil(high) - 1
            if not self._toroidal:
                first, last = np.maximum(first, 0), np.minimum(last, self.values.shape[a])
            count = np.maximum(last - first + 1, 0).astype(np.intp)
            side = np.repeat(np.arange(len(start)), count)
            line = first[side] + np.arange(len(side)) - np.repeat(np.cumsum(count) - count, count)
            sides.append(side)
            cuts.append((line - start[side, a]) / (end - start)[side, a])
        side, cut = np.concatenate(sides), np.clip(np.concatenate(cuts), 0, 1)
        order = np.argsort(side + 0.5 * cut, kind="stable")
        side, cut = side[order], cut[order]
        following = np.append(cut[1:], 1.0)
        following[np.append(side[1:] != side[:-1], True)] = 1.0
        return side, cut, np.maximum(following - cut, 0)

    def _along_row(
        self, u: FloatArray, v: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Density at (u, v), and integrals of it, of it times s and times s^2, along row u from 0 to v."""
        rows, columns = self.values.shape
        i, j = np.floor(u).astype(np.intp), np.floor(v).astype(np.intp)
        turns = j // columns if self._toroidal else np.zeros_like(j)
        i, j = (i % rows, j % columns) if self._toroidal else (i, j)
        inside = (i >= 0) & (i < rows)
        at, column = np.clip(i, 0, rows - 1), np.clip(j, 0, columns - 1)
        left = v - turns * columns
        reached = np.clip(left, 0, columns)
        rho = self.values[at, column] * inside
        totals = []
        for power, sums in enumerate(self._sums, 1):
            whole = sums[at, column] * inside
            totals.append(whole - rho * ((column + 1.0) ** power - reached**power) / power)
        zeroth, first, second = totals
        if self._toroidal and turns.any():
            r0, r1, r2 = (sums[at, -1] for sums in self._sums)
            k, w = turns.astype(np.float64), float(columns)
            pairs, squares = k * (k - 1) / 2, k * (k - 1) * (2 * k - 1) / 6
            second = second + 2 * k * w * first + (k * w) ** 2 * zeroth
            second += k * r2 + 2 * pairs * w * r1 + squares * w**2 * r0
            first = first + k * w * zeroth + k * r1 + pairs * w * r0
            zeroth = zeroth + k * r0
        outside = ~inside | (left < 0) | (left > columns)
        return np.where(outside, 0.0, rho), zeroth, first, second
