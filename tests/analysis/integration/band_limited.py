"""A band-limited family of integrands that shares no code with the library."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np


@dataclass(frozen=True, eq=False)
class Cosines:
    """2 + sum of a_f cos(2 pi (f.x + phase_f)): band-limited, written without the library."""

    f: np.ndarray
    a: np.ndarray
    phase: np.ndarray
    integral: float = 2.0

    def __call__(self, x):
        return 2 + np.cos(2 * np.pi * (x @ self.f.T + self.phase)) @ self.a

    def energy(self, frequencies):
        energy = np.zeros(len(frequencies))
        for k, g in enumerate(frequencies):
            same = np.all(self.f == g, axis=1) | np.all(self.f == -g, axis=1)
            energy[k] = np.sum(self.a[same] / 2) ** 2 if same.any() else 0.0
        return energy


@dataclass(frozen=True)
class CosineFamily:
    """Five cosines of random frequency, amplitude and phase."""

    name: ClassVar[str] = "cosines"
    summary: ClassVar[str] = ""
    periodic: ClassVar[bool] = True
    reach: int = 3

    def refusal(self, d):
        return None

    def frequencies(self, d, share, most=0):
        cube = np.indices((2 * self.reach + 1,) * d).reshape(d, -1).T - self.reach
        return cube[len(cube) // 2 + 1 :]

    def draw(self, d, rng):
        f = self.frequencies(d, 0.5)
        f = f[rng.permutation(len(f))[:5]]
        return Cosines(f, rng.random(len(f)), rng.random(len(f)))
