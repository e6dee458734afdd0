"""Point sets made by other people's programs, which are no part of this project.

Tests that measure them run where their folder stands beside the checkout, or where GBNBENCH_PUBLISHED_SETS
names it, and are skipped elsewhere: what they hold is held against slow references in every checkout too.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from tests.paths import ROOT

FOLDER = Path(os.environ.get("GBNBENCH_PUBLISHED_SETS") or ROOT.parent / "shared" / "points")


def published_files(pattern: str) -> list[Path]:
    """Files whose path below the folder fits, in order; the test is skipped where there are none."""
    files = sorted(FOLDER.glob(pattern))
    if not files:
        pytest.skip(f"{pattern} of other people's point sets is not here")
    return files


def published(name: str) -> np.ndarray:
    """Rows of one set, its leading count dropped; the test is skipped where the file is not there."""
    (path,) = published_files(name)
    rows = [line.split() for line in path.read_text().splitlines() if line.strip()]
    d = len(rows[-1])
    if len(rows) > int(rows[0][0].split(".")[0] or 0) >= len(rows) - 1:
        rows = rows[1:]
    return np.mod(np.array(rows, dtype=np.float64).reshape(-1, d), 1.0)
