"""Prefixes of progressive stipplings beside sets drawn for so many points, for docs/stippling.md.

python -m gbnbench.benchmarks.experiments.progressive_stippling benchmarks/results/adaptive/progressive.csv
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
import pandas as pd

from gbnbench.analysis.reconstruction.density_estimates import reconstructed_density
from gbnbench.analysis.reconstruction.image_quality import image_quality
from gbnbench.benchmarks.experiments.adaptive_quality import IMAGES, POINTS, darkness
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.gbn.progressive import progressive_order
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.studies.stippling_comparison.relative_variance import relative_variance

SHARES = (8, 4, 2.83, 2, 1.41, 1)
COLUMNS = ["image", "n", "CPU s of the order"]
COLUMNS += [
    f"{what} {of}" for of in ("prefix", "independent", "random") for what in ("variance", "PSNR", "SSIM")
]


def measured(image: str) -> list[list[object]]:
    """Order one set, and measure its prefixes, sets of so many points, and random parts of it.

    Parameters
    ----------
    image : str
        The picture.

    Returns
    -------
    list
        Rows of the table.
    """
    dark = darkness(image)
    density = as_density(dark)
    x = adaptive_points("gbn", density, POINTS)
    begun = time.process_time()
    order = progressive_order(density, x)
    cost = time.process_time() - begun
    shuffled = np.random.default_rng(0).permutation(POINTS)
    rows = []
    for share in SHARES:
        m = round(POINTS / share)
        row: list[object] = [image, m, cost]
        for points in (x[order[:m]], adaptive_points("gbn", density, m, seed=1), x[shuffled[:m]]):
            found = reconstructed_density(points, dark.shape, average="mean", iterations=15, reflected=True)
            quality = image_quality(found, dark)
            row += [relative_variance(points, density), quality.psnr, quality.ssim]
        rows.append(row)
    return rows


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    given = parser.parse_args()
    given.out.parent.mkdir(parents=True, exist_ok=True)
    adaptive_points("gbn[gradients=1]", as_density(np.ones((64, 64))), 100)  # kernels are built
    table = pd.DataFrame([row for image in IMAGES for row in measured(image)], columns=COLUMNS)
    table.to_csv(given.out, index=False, float_format="%.4g")
    print(table.to_string(index=False))


if __name__ == "__main__":
    main()
