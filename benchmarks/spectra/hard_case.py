"""A point set that brings out the errors of a periodogram, where to look, and the true spectrum there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.benchmarks.spectra.reference import LongArray, reference_roots
from gbnbench.core.torus import FloatArray

Frequencies = NDArray[np.int64]
Points = Callable[[], FloatArray]


@dataclass(frozen=True)
class HardCase:
    """A point set, where to look, and what is to be seen there.

    Attributes
    ----------
    name : str
        What is hard about it.
    n, d, reach : int
        Points, dimension, largest |f_a|.
    build : callable
        Makes the (n, d) points, always the same.
    truth : callable
        (points, frequencies) -> square root of the true power.
    cube : bool
        Whether the whole cube of frequencies is evaluated too, or only those listed.
    probes : int
        Random frequencies looked at, besides the corners and axes of the cube.
    also : tuple of tuple of int
        Further frequencies.
    ceiling : callable or None
        frequencies -> what the square root of power cannot exceed, inf where nothing is known.
    scattered : bool
        Whether the typical error is meant for such points.
    """

    name: str
    n: int
    d: int
    reach: int
    build: Points
    truth: Callable[[FloatArray, Frequencies], LongArray] = reference_roots
    cube: bool = True
    probes: int = 48
    also: tuple[tuple[int, ...], ...] = ()
    ceiling: Callable[[Frequencies], FloatArray] | None = None
    scattered: bool = False

    def frequencies(self) -> Frequencies:
        """(m, d) distinct frequencies at which errors are taken."""
        rng = np.random.default_rng([self.n, self.d, self.reach])
        near = min(3, self.reach)
        rows = [
            rng.integers(-self.reach, self.reach + 1, (self.probes, self.d)),
            rng.integers(-near, near + 1, (self.probes // 4, self.d)),
        ]
        if self.probes > 10:
            rows.append(np.array([[self.reach] * self.d, [-self.reach] * self.d]))
            rows.append(np.eye(self.d, dtype=np.int64)[[0, -1]] * self.reach)
        rows.append(np.array(self.also, np.int64).reshape(-1, self.d))
        return np.unique(np.concatenate(rows), axis=0)
