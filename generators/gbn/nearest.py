"""The energy by the nearest image of each pair, runs of points beyond the cut-off skipped, where the box is wide."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.errors import RefusalError
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.cost import CUTOFF
from gbnbench.generators.gbn.field import Gradient
from gbnbench.generators.gbn.pairs import Evaluation
from gbnbench.opencl import Runtime
from gbnbench.torus import FloatArray

BOX = 8  # points bounded together, or as many as a vector holds


class NearestImage(Evaluation):
    """Pairs within 6 (float) or 9 (double) sigmas; see ``Field`` and kernels/gbn_nearest.cl."""

    method = "strips"

    def __init__(
        self, runtime: Runtime, n: int, d: int, sigma: float, precision: str, cutoff: float | None = None
    ) -> None:
        super().__init__(runtime, n, d, sigma, precision)
        if cutoff is not None:
            raise RefusalError("truncated kernels are not made yet: leave cutoff out")
        self.reach = CUTOFF[precision] * self.sigma / self.side
        box = max(BOX, self.lanes)  # a work-item's points must lie in one box
        self._program = self.program("/exp.cl", "gbn_nearest.cl", BOX=box)
        self._count = -(-n // box)
        self.error = (1e-15 if self.double else 1e-6) * np.sqrt(n)

    def bytes_a_set(self) -> int:
        """Take the sets one by one."""
        return 1 << 40

    def _sorted(self, x: FloatArray) -> NDArray[np.intp]:
        """Order by cells of about BOX points along a serpentine: any order is right, a compact one fast."""
        cells = max(1, round((self.n / BOX) ** (1 / self.d)))
        cell = np.minimum((np.mod(x, 1.0) * cells).astype(np.int64), cells - 1)
        key = cell[:, 0]
        for a in range(1, self.d):
            step = np.where(key % 2 == 1, cells - 1 - cell[:, a], cell[:, a])
            key = key * cells + step
        return np.argsort(key, kind="stable")

    def _sums(self, x: FloatArray) -> Gradient:
        order = self._sorted(x[0])
        rows = np.empty((self.d, self.stride), self.real)
        rows[:, : self.n] = (x[0] - np.floor(x[0]))[order].T
        rows[:, self.n :] = rows[:, :1]
        positions = self.send("positions", rows)
        n, stride, count = np.uint32(self.n), np.uint32(self.stride), np.uint32(self._count)
        box = self.buffer("box", 2 * self.d * self._count)
        self.launch(self._program, "boxes", self._count, positions, n, stride, box, count)
        gradient, energy = self.buffer("gradient", self.d * self.stride), self.buffer("energy", self.stride)
        self.launch(
            self._program, "gbn_nearest", self.stride // self.lanes, positions, n, stride, box, count,
            self.real(self.side / self.sigma), self.real(self.reach), gradient, energy,
        )  # fmt: skip
        sums = self.runtime.download(energy, np.empty(self.stride, self.real))[: self.n]
        slopes = self.runtime.download(gradient, np.empty((self.d, self.stride), self.real))[:, : self.n]
        out = np.empty((1, self.n, self.d))
        out[0, order] = slopes.T / self.sigma
        uniform = kernel.uniform_energy(self.d, self.sigma)
        return Gradient(out, np.array([(np.mean(sums, dtype=np.float64) - uniform) / 2]))
