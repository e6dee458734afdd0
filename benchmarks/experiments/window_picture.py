"""The picture of docs/windows.md: estimates of one set of the Ginibre process.

python -m gbnbench.benchmarks.experiments.window_picture docs/images/window.png
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from gbnbench.analysis.window.estimates import in_window
from gbnbench.benchmarks.experiments.window_processes import ginibre
from gbnbench.reports.window.estimates import save

SIDE, SEED = 60.0, 4


def main(path: Path) -> None:
    """Draw the picture into a file."""
    process = ginibre(SIDE)
    x = process.draw(np.random.default_rng(SEED))
    save(path, x, in_window(x, 0, SIDE), "Ginibre process in a square window")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
