"""Sets of a long torus made of copies of a set of the unit torus, so that all of the long one is known."""

from __future__ import annotations

import numpy as np


def repeated(x: np.ndarray, times: tuple[int, ...]) -> np.ndarray:
    """Lay copies of a set side by side, and give them as fractions of the long torus's sides ``times``."""
    for axis, count in enumerate(times):
        moved = []
        for k in range(count):
            copy = x.copy()
            copy[..., axis] = (copy[..., axis] + k) / count
            moved.append(copy)
        x = np.concatenate(moved, axis=-2)
    return x


def hexagonal_rectangle(columns: int, rows: int) -> np.ndarray:
    """Hexagonal lattice of unit spacing on a torus of ``columns`` by ``rows`` cells of 1 by sqrt(3)."""
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    corner = np.stack([i / columns, j / rows], axis=-1).reshape(-1, 2)
    return np.concatenate([corner, corner + np.array([0.5 / columns, 0.5 / rows])])


def darts(sides: tuple[float, float], n: int, radius: float, seed: int) -> np.ndarray:
    """Throw darts at least ``radius`` apart on a torus of these sides: isotropic in its own lengths."""
    rng, box = np.random.default_rng(seed), np.array(sides)
    chosen = np.empty((0, 2))
    while len(chosen) < n:
        dart = rng.random(2)
        away = chosen - dart
        away -= np.rint(away)
        if (np.sum((away * box) ** 2, axis=1) >= radius**2).all():
            chosen = np.vstack([chosen, dart])
    return chosen
