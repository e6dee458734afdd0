"""Point sets of other people's programs, where the folder beside the checkout has them."""

from __future__ import annotations

import numpy as np
import pytest

from tests.paths import ROOT

FOLDER = ROOT.parent / "shared" / "points"


def published(name: str) -> np.ndarray:
    """Rows of one set, its leading count dropped; the test is skipped where the file is not there."""
    path = FOLDER / name
    if not path.is_file():
        pytest.skip(f"{name} is not beside this checkout")
    rows = [line.split() for line in path.read_text().splitlines() if line.strip()]
    d = len(rows[-1])
    if len(rows) > int(rows[0][0].split(".")[0] or 0) >= len(rows) - 1:
        rows = rows[1:]
    return np.mod(np.array(rows, dtype=np.float64).reshape(-1, d), 1.0)


def hexagonal(a: int, b: int) -> np.ndarray:
    """2 a b points: b pairs of rows of a points, staggered; hexagonal where b/a is near 1/sqrt(3)."""
    column, row = np.meshgrid(np.arange(a), np.arange(2 * b))
    return np.column_stack([((column + 0.5 * (row % 2)) / a).ravel(), (row / (2 * b)).ravel()])


def grid(m: int, d: int) -> np.ndarray:
    """Regular grid of m**d points."""
    return np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1).reshape(-1, d)
