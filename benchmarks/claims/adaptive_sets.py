"""Adaptive sampling: the picture found back, the noise in a flat part, and how soon both are there."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gbnbench.analysis.reconstruction.density_estimates import reconstructed_density
from gbnbench.analysis.reconstruction.image_quality import image_quality
from gbnbench.analysis.standard_errors import mean_over_sets
from gbnbench.benchmarks.claims.claim import ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import SetCache
from gbnbench.core.cpu_time import cpu_seconds
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.reports.paper.figure_11 import adaptive_evolution
from gbnbench.studies.stippling.darkness import as_darkness
from gbnbench.studies.stippling_comparison.flat_patch import FlatPatch, flattest_patch
from gbnbench.studies.stippling_comparison.measured_set import measured_set, reconstruction_quality

IMAGE, N, SETS, SEED = "camera", 5000, 2, 0
FAITHFUL = "gbn[sigma=1,smoothing=1,spread=1]"
EARLY = "gbn[gradients=50]"  # the work of about 300 steps of descent
SHAPED, SETTLED = 64, 256  # gradients: the work of about 500 steps, and of 7,000
RIVALS = {"bnot": "BNOT", "kdm": "KDM"}


def adaptive(_: SetCache) -> Iterator[ClaimRow]:
    """Compare pictures found back, floors of the flattest square, time, and iterations of Algorithm 2."""
    density = as_darkness(IMAGE).density()
    patch = flattest_patch(density.values, N)
    adaptive_points(EARLY, density, 100)  # kernels are built
    drawn = {name: _drawn(name, density) for name in ("gbn", FAITHFUL, EARLY, *RIVALS)}
    quality = {
        name: np.array([reconstruction_quality(x, density.values)[1].psnr for x in sets])
        for name, (sets, _) in drawn.items()
    }
    floors = {name: _floor(drawn[name][0], density, patch) for name in (FAITHFUL, *RIVALS)}
    for name, title in RIVALS.items():
        gain, error = mean_over_sets(quality["gbn"] - quality[name])
        yield _row(
            f"psnr-{name}", f"PSNR of the picture found back, GBN less {title}, dB", "above 0", gain,
            error, met=gain > 0,
        )  # fmt: skip
        ratio = floors[FAITHFUL] / floors[name]
        yield _row(
            f"floor-{name}", f"power at nu <= 0.25 in the flattest square, faithful GBN over {title}",
            "below 1", ratio, met=ratio < 1,
        )  # fmt: skip
    early, error = mean_over_sets(quality[EARLY] - quality["bnot"])
    yield _row(
        "early", "PSNR after 50 gradients, about 300 steps, less that of BNOT, dB", "0 or above", early,
        error, met=early >= 0,
    )  # fmt: skip
    time = drawn[EARLY][1] / drawn["bnot"][1]
    yield _row("time", "CPU time of those over BNOT's", "about 1 or below", time, met=time < 1.5)
    x = drawn["gbn"][0][0]
    few, many = (
        image_quality(
            reconstructed_density(x, density.shape, average="mean", iterations=count), density.values
        ).psnr
        for count in (10, 100)
    )
    change = few - many
    yield _row(
        "ten", "PSNR by 10 iterations of Algorithm 2 less that by 100, dB", "0 within 0.1", change,
        met=abs(change) < 0.1,
    )  # fmt: skip
    found = adaptive_evolution(512, SEED, [SHAPED, SETTLED], SETS)
    low = found["nu"] <= 0.5
    median = float(np.median((found["power"][0] / found["power"][1])[low]))
    yield reported(
        "shape",
        "power after 64 gradients, about 500 steps, over that after 256, median of annuli to nu = 0.5",
        "below 2", median, n=512, d=2, sets=SETS, holds=holds(median < 2),
    )  # fmt: skip


def _drawn(name: str, density: Density) -> tuple[list[FloatArray], float]:
    """Draw the sets of a method, with their CPU seconds."""
    began = cpu_seconds()
    sets = [adaptive_points(name, density, N, seed=SEED, realization=k) for k in range(SETS)]
    return sets, cpu_seconds() - began


def _floor(sets: list[FloatArray], density: Density, patch: FlatPatch | None) -> float:
    found = [measured_set(x, density, patch, pictures=False)["patch_floor"] for x in sets]
    return float(np.mean(np.array(found, np.float64)))


def _row(
    row: str, quantity: str, paper: str, value: float, error: float = float("nan"), *, met: bool
) -> ClaimRow:
    return reported(row, quantity, paper, value, error, n=N, d=2, sets=SETS, holds=holds(met))
