"""Choices among given points with a low energy: clusters taken out, then exchanged with voids nearby."""

from __future__ import annotations

import heapq
import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

REACH = 4.5  # standard deviations after which a pair counts nothing: exp(-reach^2 / 2) is 4e-5
SWEEPS = 20  # over the chosen points, of exchanges with points left out
LEAST_GAIN = 1e-6  # of an exchange, over a kernel's own energy


class PrefixChoice:
    """Given points, the sum of Gaussians over the chosen ones at each, and what the density pulls there.

    Parameters
    ----------
    x : (n, d) float64
        Points, in pixels.
    widths : (n,) float64
        Of their kernels, as few points as are to be chosen have them.
    pulls : (n,) float64
        Of the density scaled to so many points: above 0.
    torus : tuple of int or None
        Its sides; None where there is a border.

    Attributes
    ----------
    inside : (n,) bool
        Which points are chosen: at first all.
    """

    def __init__(
        self, x: FloatArray, widths: FloatArray, pulls: FloatArray, torus: tuple[int, ...] | None
    ) -> None:
        self.inside = np.ones(len(x), np.bool_)
        self._pulls = np.maximum(pulls, np.finfo(np.float64).tiny)
        self._own = (4 * math.pi * widths**2) ** (-x.shape[1] / 2)
        self._starts, self._near, self._gaussians = _neighbours(x, widths, torus)
        self._sums = self._own + np.array([self._gaussians[self._row(k)].sum() for k in range(len(x))])

    def _row(self, k: int) -> slice:
        return slice(self._starts[k], self._starts[k + 1])

    def _take(self, k: int, sign: int) -> None:
        """Take a point in (1) or out (-1)."""
        row = self._row(k)
        self.inside[k] = sign > 0
        self._sums[k] += sign * self._own[k]
        self._sums[self._near[row]] += sign * self._gaussians[row]

    def energy(self) -> float:
        """Energy of the chosen points, up to a constant."""
        return float((0.5 * self._sums - self._pulls)[self.inside].sum())

    def take_out_clusters(self, size: int) -> None:
        """Take out the point that is most crowded for its density, until so many are left."""
        crowds = [(-crowd, k) for k, crowd in enumerate(((self._sums - self._own) / self._pulls).tolist())]
        heapq.heapify(crowds)
        left = len(crowds)
        while left > size:
            was, k = crowds[0]
            now = -(self._sums[k] - self._own[k]) / self._pulls[k]  # which only rises
            if now > was:
                heapq.heapreplace(crowds, (now, k))
            else:
                heapq.heappop(crowds)
                self._take(k, -1)
                left -= 1

    def exchange(self) -> None:
        """Exchange chosen points for neighbours left out wherever the energy falls."""
        for _ in range(SWEEPS):
            exchanged = 0
            for k in np.flatnonzero(self.inside).tolist():
                row = self._row(k)
                near = self._near[row]
                outside = ~self.inside[near]
                voids = near[outside]
                if not len(voids):
                    continue
                there = self._sums[voids] - self._gaussians[row][outside] + 0.5 * self._own[voids]
                gains = self._sums[k] - 0.5 * self._own[k] - self._pulls[k] - (there - self._pulls[voids])
                best = int(gains.argmax())
                if gains[best] > LEAST_GAIN * self._own[k]:
                    self._take(k, -1)
                    self._take(int(voids[best]), 1)
                    exchanged += 1
            if not exchanged:
                break

    def by_voids(self) -> NDArray[np.intp]:
        """Take in the points left out, each the largest void of its time, and tell the order."""
        outside = np.flatnonzero(~self.inside).tolist()
        voids = [(float(self._sums[k] / self._pulls[k]), k) for k in outside]
        heapq.heapify(voids)
        order: list[int] = []
        while voids:
            was, k = voids[0]
            now = self._sums[k] / self._pulls[k]  # which only rises
            if now > was:
                heapq.heapreplace(voids, (now, k))
            else:
                heapq.heappop(voids)
                self._take(k, 1)
                order.append(k)
        return np.array(order, np.intp)


def _neighbours(
    x: FloatArray, widths: FloatArray, torus: tuple[int, ...] | None
) -> tuple[NDArray[np.intp], NDArray[np.intp], FloatArray]:
    """First neighbour of each point, the neighbours, and the Gaussians of the pairs."""
    from scipy.spatial import cKDTree

    n, d = x.shape
    sides = None if torus is None else np.array(torus, np.float64)
    tree = cKDTree(x, boxsize=sides)
    # A pair is found from its wider kernel; on the torus a point has one image of another.
    balls = tree.query_ball_point(x, REACH * math.sqrt(2) * widths)
    wide = np.repeat(np.arange(n), [len(ball) for ball in balls])
    narrow = np.concatenate([np.asarray(ball, np.intp) for ball in balls])
    first = (widths[narrow] < widths[wide]) | ((widths[narrow] == widths[wide]) & (narrow < wide))
    wide, narrow = wide[first], narrow[first]
    apart = x[wide] - x[narrow]
    if sides is not None:
        apart -= sides * np.rint(apart / sides)
    variance = widths[wide] ** 2 + widths[narrow] ** 2
    gaussian = np.exp(-(apart**2).sum(axis=1) / (2 * variance)) * (2 * math.pi * variance) ** (-d / 2)
    of, near = np.concatenate([wide, narrow]), np.concatenate([narrow, wide])
    order = np.argsort(of, kind="stable")
    starts = np.concatenate([[0], np.cumsum(np.bincount(of, minlength=n))]).astype(np.intp)
    return starts, near[order].astype(np.intp), np.concatenate([gaussian, gaussian])[order]
