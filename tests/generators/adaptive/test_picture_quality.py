"""Pictures in dots: better by every measure than the authors' program makes them, and even up to borders."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from gbnbench.benchmarks.experiments.adaptive_quality import IMAGES, POINTS, measured
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.registry import adaptive_points

AUTHORS = Path(__file__).parents[3] / "benchmarks" / "results" / "adaptive" / "authors.csv"


@pytest.mark.slow
@pytest.mark.parametrize("image", IMAGES)
def test_every_measure_is_better_than_after_1000_iterations_of_the_authors_program(image):
    table = pd.read_csv(AUTHORS).query("iterations == 1000 and `pixel centres put right` == 'no'")
    theirs = table.set_index("image").loc[image]
    (ours,) = measured(image, "gbn", POINTS, 0)
    assert ours["variance"] < theirs["variance"] / 3
    assert ours["F16"] < theirs["F16"] / 8
    assert ours["PSNR"] > theirs["PSNR"] + 0.2
    assert ours["SSIM"] > theirs["SSIM"] + 0.015
    assert ours["PSNR mirrored"] > theirs["PSNR mirrored"] + 1
    assert ours["SSIM mirrored"] > theirs["SSIM mirrored"] + 0.03


def test_the_outermost_dots_lie_half_a_spacing_from_the_border():
    grey = as_density(np.ones((128, 128)))
    x = adaptive_points("gbn", grey, 1024)
    spacing = 128 / 32
    from_border = np.minimum(x, 128 - x) / spacing
    outermost = from_border[from_border < 0.9]  # the next row lies beyond one spacing
    assert outermost.mean() == pytest.approx(0.5, abs=0.05)
    assert len(outermost) / 4 == pytest.approx(32, rel=0.1)  # as many along a border as within
