"""Regular point sets, whose measures have closed forms."""

from __future__ import annotations

import numpy as np


def hexagonal(a: int, b: int) -> np.ndarray:
    """2 a b points: b pairs of rows of a points, staggered; hexagonal where b/a is near 1/sqrt(3)."""
    column, row = np.meshgrid(np.arange(a), np.arange(2 * b))
    return np.column_stack([((column + 0.5 * (row % 2)) / a).ravel(), (row / (2 * b)).ravel()])


def grid(m: int, d: int) -> np.ndarray:
    """Regular grid of m**d points."""
    return np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1).reshape(-1, d)
