"""Energy and gradient of Gaussian Blue Noise on the torus (Ahmed, Ren & Wonka 2022, Eq. 15-23).

E = sum over pairs of prod over dimensions of theta, theta being exp(-u^2 / 2 sigma^2) summed over all
periods, and u = x n^(1/d) counted in spacings. Two evaluations, both exact to the precision: the nearest
image of each pair where the box is at least twice the cut-off wide, and the harmonics of theta where it is
narrower.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.generators.gbn.field import Field, Gradient
from gbnbench.generators.gbn.strips import Strips
from gbnbench.opencl import Runtime, runtime
from gbnbench.torus import FloatArray

CUTOFF = {"double": 9.0, "float": 6.0}  # sigmas beyond which a pair adds less than the precision
SMALLEST = {"double": 1e-18, "float": 1e-9}  # weight of the first harmonic left out, over that of f = 0
BOX = 8  # points bounded together, or as many as a vector holds
PACKAGE = "gbnbench.generators"


@dataclass(frozen=True)
class One:
    """Gradient (n, d) and excess energy of one set."""

    gradient: FloatArray
    excess: float


class Looped:
    """Set by set."""

    def __init__(self, one: Theta) -> None:
        self.method, self.error, self._one = one.method, 1e-14, one

    def __call__(self, x: FloatArray) -> Gradient:
        """Evaluate; see ``Field``."""
        found = [self._one(points) for points in x]
        return Gradient(np.stack([at.gradient for at in found]), np.array([at.excess for at in found]))


def field(
    n: int,
    d: int,
    sigma: float,
    precision: str | None = None,
    *,
    cutoff: float | None = None,
    edge: float | None = None,
) -> Field:
    """Choose the cheapest evaluation that is exact to the precision.

    Parameters
    ----------
    n, d : int
        Size of the sets.
    sigma : float
        Kernel width in spacings n**(-1/d).
    precision : {"double", "float"}, optional
        Double where the device has it.
    """
    chosen = runtime()
    name = precision or ("double" if chosen.device.has_double else "float")
    if d <= 3 and (name == "double" or n ** (1 / d) / sigma >= 2 * CUTOFF[name]):
        return Strips(chosen, n, d, sigma, name, cutoff)
    return Looped(Theta(chosen, n, d, sigma, name))


class _Evaluation:
    """Buffers shared by both evaluations."""

    def __init__(self, chosen: Runtime, n: int, d: int, sigma: float, precision: str) -> None:
        self.n, self.d, self.sigma = n, d, sigma
        self.runtime = chosen
        self.real: type[np.floating[Any]] = np.float64 if precision == "double" else np.float32
        self.lanes = chosen.lanes(precision)
        self.stride = -(-n // self.lanes) * self.lanes
        self.side = n ** (1 / d)
        itemsize = np.dtype(self.real).itemsize
        self._gradient = chosen.empty(d * self.stride * itemsize)
        self._energy = chosen.empty(self.stride * itemsize)

    def _program(self, *files: str, **defines: object) -> Any:
        base = {"DOUBLE": int(self.real is np.float64), "LANES": self.lanes, "DIM": self.d}
        return self.runtime.program(PACKAGE, ("/vector.cl", *files), {**base, **defines})

    def _rows(self, x: FloatArray) -> NDArray[Any]:
        """(d, stride) rows of coordinates; the padding repeats the first point and is left out of results."""
        rows = np.empty((self.d, self.stride), self.real)
        rows[:, : self.n] = x.T
        rows[:, self.n :] = x[0][:, None]
        return rows

    def _work(self) -> tuple[tuple[int], tuple[int]]:
        local = self.runtime.group
        items = self.stride // self.lanes
        return (-(-items // local) * local,), (local,)

    def _results(self) -> tuple[FloatArray, FloatArray]:
        gradient = self.runtime.download(self._gradient, np.empty((self.d, self.stride), self.real))
        energy = self.runtime.download(self._energy, np.empty(self.stride, self.real))
        return gradient[:, : self.n].T.astype(np.float64), energy[: self.n].astype(np.float64)


class NearestImage(_Evaluation):
    """Each pair by its nearest image, runs of points beyond the cut-off skipped."""

    method = "nearest image, cut off"

    def __init__(self, chosen: Runtime, n: int, d: int, sigma: float, precision: str) -> None:
        super().__init__(chosen, n, d, sigma, precision)
        self.reach = CUTOFF[precision] * sigma / self.side
        box = max(BOX, self.lanes)  # a work-item's points must lie in one box
        self._kernels = self._program("/exp.cl", "gbn_images.cl", BOX=box)
        self._count = -(-n // box)
        self._box = chosen.empty(2 * d * self._count * np.dtype(self.real).itemsize)
        self._order: NDArray[np.intp] | None = None

    def _sorted(self, x: FloatArray) -> NDArray[np.intp]:
        """Order by cells of about BOX points along a serpentine: any order is right, a compact one fast."""
        cells = max(1, round((self.n / BOX) ** (1 / self.d)))
        cell = np.minimum((np.mod(x, 1.0) * cells).astype(np.int64), cells - 1)
        key = cell[:, 0]
        for a in range(1, self.d):
            step = np.where(key % 2 == 1, cells - 1 - cell[:, a], cell[:, a])
            key = key * cells + step
        return np.argsort(key, kind="stable")

    def __call__(self, x: FloatArray) -> One:
        """Evaluate; see ``Field``."""
        if self._order is None:  # points move by less than a spacing or so: one order serves a whole run
            self._order = self._sorted(x)
        order = self._order
        positions = self.runtime.upload(self._rows(x[order] - np.floor(x[order])))
        n, stride, count = np.uint32(self.n), np.uint32(self.stride), np.uint32(self._count)
        local = self.runtime.group
        groups = -(-self._count // local) * local
        self._kernels.run("boxes", (groups,), (local,), positions, n, stride, self._box, count)
        work, local_size = self._work()
        self._kernels.run(
            "gbn_images",
            work,
            local_size,
            positions,
            n,
            stride,
            self._box,
            count,
            self.real(self.side / self.sigma),
            self.real(self.reach),
            self._gradient,
            self._energy,
        )
        sorted_gradient, energy = self._results()
        gradient = np.empty_like(sorted_gradient)
        gradient[order] = sorted_gradient / self.sigma
        uniform = (2 * math.pi) ** (self.d / 2) * self.sigma**self.d
        return One(gradient, float((np.mean(energy) - uniform) / 2))


class Theta(_Evaluation):
    """All pairs by the harmonics of theta, for boxes of few sigmas; exact in any dimension."""

    method = "all pairs, theta harmonics"

    def __init__(self, chosen: Runtime, n: int, d: int, sigma: float, precision: str) -> None:
        super().__init__(chosen, n, d, sigma, precision)
        decay = 2 * (math.pi * sigma / self.side) ** 2
        terms = max(1, math.ceil(math.sqrt(-math.log(SMALLEST[precision]) / decay)))
        weight = np.exp(-decay * np.arange(terms + 1.0) ** 2)
        self._weight = chosen.upload(weight.astype(self.real))
        self._terms = np.int32(terms)
        self._kernels = self._program("gbn_theta.cl")

    def __call__(self, x: FloatArray) -> One:
        """Evaluate; see ``Field``."""
        angle = 2 * np.pi * (x - np.rint(x))  # small on both sides of the border, where neighbours meet
        cosine = self.runtime.upload(self._rows(np.cos(angle)))
        sine = self.runtime.upload(self._rows(np.sin(angle)))
        work, local = self._work()
        self._kernels.run(
            "gbn_theta",
            work,
            local,
            cosine,
            sine,
            np.uint32(self.n),
            np.uint32(self.stride),
            self._weight,
            self._terms,
            self._gradient,
            self._energy,
        )
        gradient, energy = self._results()
        # The kernel's theta has mean 1 over the box and its slope is per box side.
        mean = (math.sqrt(2 * math.pi) * self.sigma / self.side) ** self.d
        return One(gradient * (mean / self.side), float(np.mean(energy) * mean / 2))
