"""Swaps of samples between sites that lower the sum of squared distances at equal capacity."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import DeviceError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.ccvt.pairs import Pairs, first_free_groups, touching_pairs
from gbnbench.opencl import runtime

SLACK = 0.2  # of the median radius: how much wider than the circles those are whose pairs are listed
CROWDED = 2  # pairs on the list for each one that overlaps: then the list is made anew
CHUNK = 32  # samples that have a box in common
GAIN = 1e-13  # least change of half a squared distance, in units of length squared, that counts as one


class Swaps:
    """Sites with their samples on the device, and passes of swaps over all pairs.

    Parameters
    ----------
    sites : (n, 2) float64
        On the unit torus.
    offsets : (n, 2, capacity) float64
        Samples of each site, from the site: x, then y.

    Attributes
    ----------
    sites : (n, 2) float64
        On the unit torus, each at the centroid of its samples.
    settled : bool
        Whether no swap can lower the energy any more.

    Raises
    ------
    DeviceError
        If the device lacks double precision or memory.
    """

    def __init__(self, sites: FloatArray, offsets: FloatArray) -> None:
        self._runtime = runtime()
        if not self._runtime.device.has_double:
            raise DeviceError(
                f"ccvt needs double precision, which {self._runtime.device.label} lacks; "
                "choose another device: gbnbench devices lists them"
            )
        self._program = self._runtime.program(
            "gbnbench.generators",
            ("/vector.cl", "ccvt_swap.cl", "ccvt_recentre.cl"),
            {"DOUBLE": 1, "LANES": self._runtime.lanes("double"), "GAIN": GAIN, "CHUNK": CHUNK},
        )
        n, _, capacity = self._shape = offsets.shape
        self._sizes = np.int32(capacity), np.int32(-(-capacity // CHUNK))
        self.sites = sites.copy()
        self.settled = False
        self._pairs: Pairs | None = None
        self._crowded = False
        self._slack = 0.0
        self._drift = np.zeros((n, 2))
        self._radius = np.zeros(n)
        self._listed_radius = self._radius
        self._moved = np.zeros((n, 2))
        self._changed = np.ones(n, dtype=np.int32)
        self._offsets_buffer = self._runtime.upload(in_chunks(offsets))
        self._boxes_buffer = self._runtime.empty(n * 4 * int(self._sizes[1]) * 8)
        self._heaps_buffer = self._runtime.empty(n * capacity * 4)
        self._shift_buffer = self._runtime.upload(np.zeros((n, 2)))
        self._changed_buffer = self._runtime.upload(self._changed)
        self._moved_buffer = self._runtime.upload(self._moved)
        self._radius_buffer = self._runtime.upload(self._radius)
        for _ in range(2):  # the first finds the centroids
            self._recentre()

    @property
    def offsets(self) -> FloatArray:
        """Samples of each site, from the site, (n, 2, capacity), read back from the device."""
        return self._runtime.download(self._offsets_buffer, np.empty(self._shape))

    @property
    def at_rest(self) -> float:
        """Share of the sites that the last pass left as they were."""
        return float(np.mean(self._changed == 0))

    @property
    def energy(self) -> float:
        """Mean squared distance of a sample from its site."""
        return float(2 * np.mean(self.offsets**2))

    def sweep(self, rng: np.random.Generator) -> None:
        """Look once, in random order, at every pair of which a site has changed, and swap while that pays.

        After the swaps of a pair both its sites move to the centroids of their samples at once.
        """
        pairs, between = self._listed()
        changed = self._changed > 0
        squares = np.sum(between * between, axis=1)
        overlap = squares < (self._radius[pairs.first] + self._radius[pairs.second]) ** 2
        self._crowded = bool(CROWDED * np.count_nonzero(overlap) < len(overlap))
        chosen = np.flatnonzero(overlap & (changed[pairs.first] | changed[pairs.second]))
        group = pairs.group[chosen]
        if len(chosen) < len(changed):  # a few pairs need fewer groups
            chosen = rng.permutation(chosen)
            group = first_free_groups(pairs.first[chosen], pairs.second[chosen], len(changed))
            order = np.argsort(group, kind="stable")
            chosen, group = chosen[order], group[order]
        # A site whose samples were turned about the torus is looked at again.
        self._runtime.update(self._changed_buffer, (self._changed == 2).astype(np.int32))
        if len(chosen):
            arguments = (
                *self._sizes,
                self._runtime.upload(np.stack([pairs.first, pairs.second], axis=1)[chosen].astype(np.int32)),
                self._runtime.upload(between[chosen]),
                self._offsets_buffer,
                self._boxes_buffer,
                self._heaps_buffer,
                self._shift_buffer,
                self._changed_buffer,
            )
            bounds = np.searchsorted(group, np.arange(group[-1] + 2))
            for k in rng.permutation(group[-1] + 1):
                start, stop = bounds[k : k + 2]
                if stop > start:
                    self._run("ccvt_swap", stop - start, np.int32(start), np.int32(stop), *arguments)
        self._recentre()
        self.settled = not self._changed.any()

    def _listed(self) -> tuple[Pairs, FloatArray]:
        """Pairs that hold all whose circles overlap, with the vectors between them as sites stand."""
        if self._pairs is not None and not self._crowded:
            wider = np.linalg.norm(self._drift, axis=1) + self._radius - self._listed_radius
            if wider.max() <= self._slack:
                drift = self._drift[self._pairs.second] - self._drift[self._pairs.first]
                return self._pairs, self._pairs.between + drift
        self._slack = SLACK * float(np.median(self._radius))
        self._listed_radius = self._radius.copy()
        self._drift = np.zeros_like(self.sites)
        self._pairs = touching_pairs(self.sites, self._radius + self._slack)
        return self._pairs, self._pairs.between

    def _recentre(self) -> None:
        """Move changed sites to the centroids of their samples, and measure their circles."""
        self._run(
            "ccvt_recentre",
            len(self.sites),
            np.int32(len(self.sites)),
            *self._sizes,
            self._offsets_buffer,
            self._boxes_buffer,
            self._shift_buffer,
            self._changed_buffer,
            self._moved_buffer,
            self._radius_buffer,
        )
        self._runtime.download(self._changed_buffer, self._changed)
        self._runtime.download(self._moved_buffer, self._moved)
        self._runtime.download(self._radius_buffer, self._radius)
        changed = self._changed > 0
        self.sites[changed] = wrap(self.sites[changed] + self._moved[changed])
        self._drift[changed] += self._moved[changed]

    def _run(self, name: str, items: int, *arguments: object) -> None:
        """Launch so many work-items of a kernel."""
        group = self._runtime.group
        self._program.run(name, (-(-items // group) * group,), (group,), *arguments)


def placed(sites: FloatArray, samples: NDArray[np.float64]) -> FloatArray:
    """Offsets of samples from their sites by the shorter way, as ``Swaps`` takes them.

    Parameters
    ----------
    sites : (n, 2) float64
        On the unit torus.
    samples : (n, capacity, 2) float64
        Those of each site, on the unit torus.

    Returns
    -------
    (n, 2, capacity) float64
    """
    offsets = samples - sites[:, None]
    offsets -= np.rint(offsets)
    return np.ascontiguousarray(np.moveaxis(offsets, 2, 1))


def in_chunks(offsets: FloatArray) -> FloatArray:
    """Order the samples of each site by strips, and in these by y, so that a chunk is a compact piece.

    Parameters
    ----------
    offsets : (n, 2, capacity) float64
        Samples from their sites.

    Returns
    -------
    (n, 2, capacity) float64
        The same in another order.
    """
    n, _, capacity = offsets.shape
    strips = max(1, round((capacity / CHUNK) ** 0.5))
    strip = np.empty((n, capacity))
    rank = np.arange(capacity) * strips // capacity
    np.put_along_axis(strip, np.argsort(offsets[:, 0], axis=1), rank[None].astype(np.float64), axis=1)
    order = np.argsort(strip + offsets[:, 1] / 4, axis=1)  # |y| is 1 at most, so that strips stay apart
    return np.take_along_axis(offsets, order[:, None, :], axis=2)
