"""Point sets made by other people's programs, which stand in tests/data with their sources and licences."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.paths import ROOT

FOLDER = ROOT / "tests" / "data"


def published_files(pattern: str) -> list[Path]:
    """Files whose path below the folder fits the pattern, in order; at least one."""
    others = (FOLDER, FOLDER / "field")  # what these hold was made by nobody else's program
    files = sorted(path for path in FOLDER.glob(pattern) if path.parent not in others)
    assert files, f"no file of {FOLDER} fits {pattern}"
    return files


def published(name: str) -> np.ndarray:
    """Rows of one set, its leading count dropped."""
    (path,) = published_files(name)
    rows = [line.split() for line in path.read_text().splitlines() if line.strip()]
    d = len(rows[-1])
    if len(rows) > int(rows[0][0].split(".")[0] or 0) >= len(rows) - 1:
        rows = rows[1:]
    return np.mod(np.array(rows, dtype=np.float64).reshape(-1, d), 1.0)
