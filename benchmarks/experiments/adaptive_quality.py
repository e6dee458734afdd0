"""Quality and cost of adaptive generators on scikit-image's pictures, for docs/adaptive.md.

    python -m gbnbench.benchmarks.experiments.adaptive_quality benchmarks/results/adaptive/quality.csv
    python -m gbnbench.benchmarks.experiments.adaptive_quality --table benchmarks/results/adaptive/quality.csv

The first measures, set by set, and goes on where it was stopped; with --jobs or --executor workers do it. The
second prints a table.
"""

from __future__ import annotations

import argparse
import itertools
import time
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
from skimage import color, data

from gbnbench.analysis.reconstruction.blurred_difference import blurred_difference
from gbnbench.benchmarks.experiments.filled_table import add_workers, fill
from gbnbench.benchmarks.timing.table_store import TableStore
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.registry import ADAPTIVE_GENERATORS, adaptive_points
from gbnbench.runs.task import Task
from gbnbench.studies.stippling_comparison.measured_set import BLUR, reconstruction_quality
from gbnbench.studies.stippling_comparison.relative_variance import relative_variance

IMAGES = ("camera", "coins", "astronaut")
POINTS, SEEDS = 10_000, 3
COLUMNS = ["image", "method", "n", "seed", "CPU s", "variance", "F16", "PSNR", "SSIM"]
COLUMNS += ["PSNR mirrored", "SSIM mirrored"]


def darkness(name: str) -> FloatArray:
    """Give a picture of scikit-image in grey, dark being large.

    Parameters
    ----------
    name : str
        Of a function of ``skimage.data``.

    Returns
    -------
    (rows, columns) float64
        0 to 255.
    """
    image = np.asarray(getattr(data, name)())
    grey = 255 * color.rgb2gray(image) if image.ndim == 3 else image.astype(np.float64)
    dark: FloatArray = 255 - np.asarray(grey, np.float64)
    return dark


def measured(image: str, method: str, n: int, seed: int) -> list[dict[str, object]]:
    """Draw one set and measure it.

    Parameters
    ----------
    image, method : str
        The picture, and the generator.
    n, seed : int
        Points, and the seed.

    Returns
    -------
    list of one dict
        A row of the table.
    """
    build_kernels()
    dark = darkness(image)
    density = as_density(dark)
    begun = time.process_time()
    x = adaptive_points(method, density, n, seed=seed)
    cost = time.process_time() - begun
    authors, mirrored = (reconstruction_quality(x, dark, reflected=mirror)[1] for mirror in (False, True))
    variance, blurred = relative_variance(x, density), blurred_difference(x, density.values, BLUR)
    row = [
        image, method, n, seed, cost, variance, blurred,
        authors.psnr, authors.ssim, mirrored.psnr, mirrored.ssim,
    ]  # fmt: skip
    return [dict(zip(COLUMNS, row, strict=True))]


@cache
def build_kernels() -> None:
    """Build the kernels of Gaussian blue noise before anything is timed, once a process."""
    adaptive_points("gbn[gradients=1]", as_density(np.ones((64, 64))), 100)


def tasks_of(seeds: int, n: int = POINTS) -> list[Task]:
    """List a task a set: every picture and generator, seed by seed.

    Parameters
    ----------
    seeds : int
        Sets of each.
    n : int
        Points of a set.

    Returns
    -------
    list of Task
    """
    return [
        Task(key := f"{image} {method} {seed}", key, measured, (image, method, n, seed))
        for seed in range(seeds)
        for image in IMAGES
        for method in ADAPTIVE_GENERATORS
    ]


def markdown(table: pd.DataFrame) -> str:
    """Write the table for the page: means over seeds.

    Parameters
    ----------
    table : pandas.DataFrame
        Rows of ``measured``.

    Returns
    -------
    str
    """
    lines = [
        "| picture | method | sets | CPU s | variance | F16 | PSNR, dB | SSIM | mirrored: PSNR | SSIM |",
        "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|",
    ]
    parts = dict(list(table.groupby(["image", "method"])))
    for image, method in itertools.product(IMAGES, ADAPTIVE_GENERATORS):
        if (part := parts.get((image, method))) is None:
            continue
        m = part.mean(numeric_only=True)
        lines.append(
            f"| {image} | {method} | {len(part)} | {m['CPU s']:.3g} | {m['variance']:.2e} | {m['F16']:.2e} | "
            f"{m['PSNR']:.2f} | {m['SSIM']:.3f} | {m['PSNR mirrored']:.2f} | {m['SSIM mirrored']:.3f} |"
        )
    return "\n".join(lines)


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--seeds", type=int, default=SEEDS)
    add_workers(parser)
    given = parser.parse_args()
    if given.table:
        print(markdown(pd.read_csv(given.out)))
        return
    tasks = tasks_of(given.seeds)
    store = TableStore(given.out, COLUMNS, key_of, [task.key for task in tasks])
    fill(tasks, store, given)


def key_of(row: Mapping[str, str]) -> str:
    """Name the task of a row."""
    return f"{row['image']} {row['method']} {row['seed']}"


if __name__ == "__main__":
    # Workers find a task's function by the name of its module, which is not __main__ there.
    from gbnbench.benchmarks.experiments import adaptive_quality

    adaptive_quality.main()
