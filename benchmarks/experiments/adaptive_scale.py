"""Time and memory of adaptive Gaussian blue noise up to a million points, for docs/adaptive.md.

    python -m gbnbench.benchmarks.experiments.adaptive_scale benchmarks/results/adaptive/scale.csv

Each case has a process of its own, so that its peak of memory is its own; cases that the file has are kept.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import resource
import time
from pathlib import Path

import numpy as np
import pandas as pd
from skimage import transform

import gbnbench
from gbnbench.analysis.reconstruction.image_quality import image_quality
from gbnbench.api.reconstruct import density_of_points
from gbnbench.core.torus import FloatArray
from gbnbench.io.images import read_image

# picture, rows, columns, points
CASES = (
    ("camera", 512, 512, 10_000),
    ("coffee", 512, 768, 100_000),
    ("camera", 512, 512, 1_000_000),
)
COLUMNS = ["image", "rows", "columns", "n", "start-up CPU s", "CPU s", "wall s", "load", "peak GB"]
COLUMNS += ["found back CPU s", "PSNR", "SSIM"]


def tones_of(name: str, rows: int, columns: int) -> FloatArray:
    """Give a picture of scikit-image in grey, at a size.

    Parameters
    ----------
    name : str
        Its name.
    rows, columns : int
        Pixels.

    Returns
    -------
    (rows, columns) float64
        0 black to 1 white.
    """
    tones = read_image(name).tones
    if tones.shape == (rows, columns):
        return tones
    scaled = transform.resize(tones, (rows, columns), anti_aliasing=True)  # type: ignore[no-untyped-call]
    return np.clip(np.asarray(scaled, np.float64), 0, 1)


def measured(case: tuple[str, int, int, int]) -> list[object]:
    """Draw one set, and find the picture back from it.

    Parameters
    ----------
    case : tuple
        One of ``CASES``.

    Returns
    -------
    list
        A row of the table.
    """
    name, rows, columns, n = case
    tones = tones_of(name, rows, columns)
    begun = time.process_time()
    gbnbench.stipple(tones[:64, :64], 100, method="gbn[gradients=1]")  # kernels are built
    gbnbench.reconstruct([[0.5, 0.5]], shape=(9, 9))
    ready, clock = time.process_time(), time.perf_counter()
    made = gbnbench.stipple(tones, n)
    cost, wall = time.process_time() - ready, time.perf_counter() - clock
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    again = time.process_time()
    density = density_of_points(made.points, made.amplitudes, tones.shape)
    back = time.process_time() - again
    quality = image_quality(density, 1 - tones)
    load = os.getloadavg()[0]
    return [*case, ready - begun, cost, wall, load, peak, back, quality.psnr, quality.ssim]


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    out: Path = parser.parse_args().out
    out.parent.mkdir(parents=True, exist_ok=True)
    done = pd.read_csv(out) if out.exists() else pd.DataFrame(columns=COLUMNS)
    for case in CASES:
        if (done[["image", "rows", "columns", "n"]] == list(case)).all(axis=1).any():
            continue
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            row = pd.DataFrame([pool.apply(measured, (case,))], columns=COLUMNS)
        done = row if done.empty else pd.concat([done, row])
        done.to_csv(out, index=False, float_format="%.4g")
        print(row.to_string(index=False), flush=True)


if __name__ == "__main__":
    main()
