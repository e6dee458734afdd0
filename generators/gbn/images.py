"""The energy over all pairs, each dimension's theta function as a sum over the images it needs."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.errors import RefusalError
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.field import Gradient
from gbnbench.generators.gbn.pairs import AllPairs
from gbnbench.opencl import Runtime
from gbnbench.torus import FloatArray

# Sigmas beyond which an image adds less than the precision, of one pair's largest value and force.
CUTOFF = {"double": 9.0, "float": 6.0}
MOST = 9  # images a dimension


def images(ratio: float, precision: str) -> int:
    """Count the images of a point within the cut-off of another, a dimension, in a box of so many sigmas.

    Notes
    -----
    The nearest lies within half a side, the others at least 1/2, 1, 3/2, ... sides away.
    """
    return max(1, math.ceil(2 * CUTOFF[precision] / ratio))


class Images(AllPairs):
    """All pairs by the nearest images in each dimension; see ``Field`` and kernels/gbn_images.cl.

    Notes
    -----
    The nearest image alone where the box is twice the cut-off wide, two a dimension down to the cut-off, and so
    on: one exp a pair, and one for each further image of each dimension.
    """

    method = "images"

    def __init__(self, runtime: Runtime, n: int, d: int, sigma: float, precision: str) -> None:
        super().__init__(runtime, n, d, sigma, precision)
        ratio = self.side / self.sigma
        self.images = images(ratio, precision)
        if self.images > MOST:
            raise RefusalError(
                f"a box of {ratio:.3g} sigmas needs {self.images} images a dimension; method images sums up to "
                f"{MOST}: theta or harmonics fit such boxes"
            )
        self._program = self.program("/exp.cl", "gbn_images.cl", IMAGES=self.images)
        self._turn = 1.0 if self.double else 2.0**-32  # box sides that a unit of a position stands for
        self.error = kernel.EPS[precision] * (24 + 4 * self.images + d + ratio) * math.sqrt(n)

    def _sums(self, x: FloatArray) -> Gradient:
        ratio = self.side / self.sigma
        at = self.send("at", x - np.rint(x)) if self.double else self.send_turns(x)
        slopes, sums = self.sum_pairs(
            self._program, "gbn_images", len(x), at, self.real(ratio), self.real(ratio * self._turn)
        )
        uniform = kernel.uniform_energy(self.d, self.sigma)
        return Gradient(slopes / self.sigma, (np.mean(sums, axis=1, dtype=np.float64) - uniform) / 2)
