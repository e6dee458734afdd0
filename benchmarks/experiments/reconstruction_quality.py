"""Quality and cost of pictures found back from points, for docs/stippling.md.

    python -m gbnbench.benchmarks.experiments.reconstruction_quality benchmarks/results/adaptive/reconstruction.csv
    python -m gbnbench.benchmarks.experiments.reconstruction_quality --picture docs/images/reconstructed-camera.png

The first measures and prints a table of means over seeds; the second draws points and what comes back of them.
"""  # noqa: E501

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from PIL import Image

import gbnbench
from gbnbench.analysis.reconstruction.image_quality import image_quality
from gbnbench.api.page_style import PageStyle, page_of
from gbnbench.api.reconstruct import density_of_points
from gbnbench.api.stippling import Stippling
from gbnbench.core.torus import FloatArray
from gbnbench.io.images import read_image
from gbnbench.reports.stippling.png import pixels
from gbnbench.studies.stippling.tones import tones

IMAGES = ("camera", "coins", "astronaut")
POINTS, SEEDS = 10_000, 3
PANEL, GAP = 400, 8  # pixels of the picture's parts
WAYS: dict[str, dict[str, Any]] = {
    "amplitudes of stipple": {},
    "Algorithm 2": {},
    "kernels of one width": {"method": "kernel"},
    "Voronoi cells": {"method": "voronoi"},
}


def density_by(way: str, made: Stippling, shape: tuple[int, ...]) -> FloatArray:
    """Find the density of a stippling's points.

    Parameters
    ----------
    way : str
        One of ``WAYS``.
    made : Stippling
        The points.
    shape : tuple of int
        Rows and columns.

    Returns
    -------
    (rows, columns) float64
    """
    given = made.amplitudes if way == "amplitudes of stipple" else None
    return density_of_points(made.points, given, shape, **WAYS[way])


def measured(name: str, seed: int) -> list[list[object]]:
    """Draw one picture and find it back in every way.

    Parameters
    ----------
    name : str
        Of an image of scikit-image's.
    seed : int
        Of the points.

    Returns
    -------
    list of list
        Rows: picture, way, seed, CPU s, PSNR, SSIM.
    """
    dark = 1 - read_image(name).tones
    made = gbnbench.stipple(name, POINTS, seed=seed)
    rows: list[list[object]] = []
    for way in WAYS:
        begun = time.process_time()
        density = density_by(way, made, dark.shape)
        cost = time.process_time() - begun
        quality = image_quality(density, dark)
        rows.append([name, way, seed, cost, quality.psnr, quality.ssim])
    return rows


def picture() -> Image.Image:
    """Draw the points of the first picture, and beside them three ways back.

    Returns
    -------
    Image
        Four parts in a row.
    """
    made = gbnbench.stipple(IMAGES[0], POINTS)
    page = page_of({"black": made}, PageStyle(margin_mm=0))
    parts = [pixels(page, PANEL / page.width * 25.4)]
    for way in ("Algorithm 2", "kernels of one width", "Voronoi cells"):
        found = tones(density_by(way, made, (PANEL, PANEL)), coverage=made.coverage)
        parts.append(np.rint(255 * found).astype(np.uint8))
    white = np.full((PANEL, GAP), 255, np.uint8)
    return Image.fromarray(np.hstack([part for one in parts for part in (one, white)][:-1]))


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    parser.add_argument("--picture", action="store_true")
    given = parser.parse_args()
    if given.picture:
        picture().save(given.out, optimize=True)
        return
    gbnbench.reconstruct(np.full((9, 2), 0.5), shape=(9, 9))  # kernels are built
    rows = [row for name in IMAGES for seed in range(SEEDS) for row in measured(name, seed)]
    table = pd.DataFrame(rows, columns=["image", "way", "seed", "CPU s", "PSNR", "SSIM"])
    given.out.parent.mkdir(parents=True, exist_ok=True)
    table.to_csv(given.out, index=False, float_format="%.4g")
    print(table.groupby(["image", "way"], sort=False).mean(numeric_only=True).to_string())


if __name__ == "__main__":
    main()
