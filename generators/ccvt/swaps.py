"""Swaps of samples between sites that lower the sum of squared distances at equal capacity."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.ccvt.pairs import Indices, matchings, touching_pairs

GAIN = 1e-13  # least change of half a squared distance, in units of length squared, that counts as one
ROWS = 128  # pairs that are treated at once: what fits a cache


class Swaps:
    """Sites with their samples, and passes of swaps over all pairs.

    Attributes
    ----------
    sites : (n, 2) float64
        On the unit torus, each at the centroid of its samples.
    offsets : (n, capacity, 2) float64
        Samples of each site, from the site.
    settled : bool
        Whether no swap can lower the energy any more.
    """

    def __init__(self, sites: FloatArray, samples: FloatArray) -> None:
        """Take the sites with the samples that were given to each, (n, capacity, 2), on the torus."""
        self.sites = sites
        self.offsets = samples - sites[:, None]
        self.offsets -= np.rint(self.offsets)
        self.settled = False
        self._radius = np.zeros(len(sites))
        self._changed = np.ones(len(sites), dtype=bool)
        self._turned = np.zeros(len(sites), dtype=bool)
        self._shift = np.zeros_like(sites)
        self._recentre()

    @property
    def energy(self) -> float:
        """Mean squared distance of a sample from its site."""
        return float(2 * np.mean(self.offsets**2))

    def sweep(self, rng: np.random.Generator) -> int:
        """Look at every pair once, in random order; return how many pairs of samples were swapped.

        After a swap both sites move to the centroids of their samples at once.
        """
        first, second, between = touching_pairs(self.sites, self._radius, self._changed)
        self._changed[:] = self._turned  # their centroids moved with the samples that were turned
        swapped = 0
        for group in matchings(first, second, len(self.sites), rng):
            for start in range(0, len(group), ROWS):
                rows = group[start : start + ROWS]
                swapped += self._swap(first[rows], second[rows], between[rows])
        self.settled = not self._changed.any()
        self._recentre()
        return swapped

    def _swap(self, a: Indices, b: Indices, between: FloatArray) -> int:
        """Swap between each a and its b while that lowers the energy; no site comes twice."""
        vector = between + self._shift[b] - self._shift[a]
        half = np.sum(vector * vector, axis=1) / 2
        # Half of |from a|^2 - |from b|^2 of each sample: of those of a the gain of giving it to b.
        gain = np.matmul(self.offsets[a], vector[:, :, None])[:, :, 0]
        loss = np.matmul(self.offsets[b], vector[:, :, None])[:, :, 0]
        gain -= (half + np.sum(self._shift[a] * vector, axis=1))[:, None]
        loss += (half - np.sum(self._shift[b] * vector, axis=1))[:, None]
        least, most = loss.min(axis=1), gain.max(axis=1)
        hot = np.flatnonzero(most > least + GAIN)
        if not len(hot):
            return 0
        gain, loss, least, most = gain[hot], loss[hot], least[hot, None], most[hot, None]
        many = max((gain > least + GAIN).sum(axis=1).max(), (loss < most - GAIN).sum(axis=1).max())
        given, taken = _lowest(-gain, int(many)), _lowest(loss, int(many))
        profit = np.take_along_axis(gain, given, axis=1) - np.take_along_axis(loss, taken, axis=1)
        row, place = np.nonzero(profit > GAIN)  # both in order: the first k of a row
        ours, theirs = (a[hot][row], given[row, place]), (b[hot][row], taken[row, place])
        leaving = self.offsets[ours] - between[hot][row]
        coming = self.offsets[theirs] + between[hot][row]
        for axis in range(2):  # what comes to a has left b, and the other way round
            change = np.bincount(row, coming[:, axis] - self.offsets[ours][:, axis], len(hot))
            self._shift[a[hot], axis] += change / self.offsets.shape[1]
            self._shift[b[hot], axis] -= change / self.offsets.shape[1]
        self.offsets[ours], self.offsets[theirs] = coming, leaving
        self._changed[a[hot]] = True
        self._changed[b[hot]] = True
        return len(row)

    def _recentre(self) -> None:
        """Move changed sites to the centroids of their samples, and measure their circles."""
        changed = np.flatnonzero(self._changed)
        offsets = self.offsets[changed]
        centroid = offsets.mean(axis=1)
        offsets -= centroid[:, None]
        turns = np.rint(offsets)  # where a cell reaches half round the torus
        offsets -= turns
        self._turned[:] = False
        self._turned[changed] = turns.any(axis=(1, 2))
        self.offsets[changed] = offsets
        self.sites[changed] = wrap(self.sites[changed] + centroid)
        self._radius[changed] = np.sqrt(np.max(offsets[:, :, 0] ** 2 + offsets[:, :, 1] ** 2, axis=1))
        self._shift[:] = 0.0


def _lowest(values: FloatArray, many: int) -> NDArray[np.intp]:
    """Places of so many least values of each row, in order."""
    if many >= values.shape[1]:
        return np.argsort(values, axis=1)
    chosen = np.argpartition(values, many - 1, axis=1)[:, :many]
    order = np.argsort(np.take_along_axis(values, chosen, axis=1), axis=1)
    return np.take_along_axis(chosen, order, axis=1)
