"""The energy over all pairs, each dimension's theta function as a sum over the images it needs."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import kernel, operation_counts
from gbnbench.generators.gbn.evaluation import AllPairs, means
from gbnbench.generators.gbn.protocol import EnergyGradient
from gbnbench.opencl import Runtime


class Images(AllPairs):
    """All pairs by the nearest images in each dimension; see ``EnergyEvaluation`` and kernels/gbn_images.cl.

    Notes
    -----
    The nearest image alone where the box is twice the cut-off wide, two a dimension down to the cut-off, and
    so on: one exp a pair, and one for each further image of each dimension. Where ``side`` is given,
    the torus's in spacings, the energy is that of the pairs alone, no constant density's taken away.
    """

    method = "images"

    def __init__(
        self, runtime: Runtime, n: int, d: int, sigma: float, precision: str, side: float | None = None
    ) -> None:
        super().__init__(runtime, n, d, sigma, precision)
        self.side = side or self.side
        ratio = self.side / self.sigma
        self.error = operation_counts.images(n, d, self.sigma, precision, side).error
        # What another torus would hold at a constant density has no meaning for these points.
        self._uniform = 0.0 if side else kernel.uniform_energy(d, self.sigma)
        self.images = operation_counts.images_needed(ratio, precision)
        self._program = self.program("/exp2.cl", "gbn_images.cl", IMAGES=self.images)
        self._turn = 1.0 if self.double else 2.0**-32  # box sides that a unit of a position stands for

    def _sums(self, x: FloatArray) -> EnergyGradient:
        ratio = self.side / self.sigma
        at = self.send("at", x - np.rint(x)) if self.double else self.send_turns(x)
        slopes, sums = self.sum_pairs(
            self._program, "gbn_images", len(x), at, self.real(ratio), self.real(ratio * self._turn)
        )
        return EnergyGradient(slopes / self.sigma, (means(sums) - self._uniform) / 2)
