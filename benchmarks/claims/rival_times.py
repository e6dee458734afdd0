"""Claims about the time of BNOT and KDM beside Gaussian Blue Noise (Sec. 5.4)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from gbnbench.benchmarks.claims.claim import BESIDE, UNTRIED, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.complexity import SAME, exponent, gradient
from gbnbench.benchmarks.claims.sets import SEED, SetCache
from gbnbench.benchmarks.timing.interleaved import Call, interleave, timed
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.kernel_based.density_raster import DensityRaster
from gbnbench.generators.registry import generate
from gbnbench.generators.voronoi.cells import toroidal_cells

BNOT_SIZES = [1024, 2048, 4096, 8192]
KDM_SIZES = [2048, 4096, 8192, 16_384]  # each timed once
SHORT = "gbn[gradients=30]"  # enough to lie below BNOT's noise floor
CELLS = 500  # points whose Voronoi cells are timed by dimension


def times(sets: SetCache) -> Iterator[ClaimRow]:
    """Compare BNOT's time with GBN's, and follow the times of BNOT and KDM with n and d."""
    yield from _beside(sets)
    yield from _by_points(sets)
    yield from _by_dimension(sets)


def _beside(sets: SetCache) -> Iterator[ClaimRow]:
    n = sets.few(4096, 256)
    calls: dict[str, Call] = {
        "bnot": partial(generate, "bnot", n=n),
        "gbn": partial(generate, "gbn", n=n),
        "short": partial(generate, SHORT, n=n),
        "gradient": gradient(energy_evaluation(n, 2, 1.0, "double"), n, 2),
    }
    timings = interleave(calls, 10.0)
    ratio = {name: float(np.median(timings["bnot"].over(timing))) for name, timing in timings.items()}
    for row, value, title in (
        ("descent", ratio["gradient"] / 10_000, "10,000 of our gradients"),
        ("nesterov", ratio["gbn"], "320 gradients of Nesterov's method, which do the same"),
    ):
        yield reported(
            row,
            f"BNOT's CPU time over that of {title}, one thread",
            "above 2: GBN is significantly faster",
            value,
            n=n,
            d=2,
            sets=1,
            holds=holds(value > 2),
        )
    some = {spec: sets.draw(spec, n=n, sets=2).measures for spec in ("bnot", SHORT)}
    below = math.log10(some["bnot"]["noise_floor"] / some[SHORT]["noise_floor"])
    yield reported(
        "short-floor",
        "orders from the floor of 30 gradients up to that of BNOT",
        "",
        below,
        n=n,
        d=2,
        sets=2,
    )
    yield reported(
        "short",
        "BNOT's CPU time over that of 30 gradients, whose floor is no higher",
        "above 2: to one noise floor it is significantly faster",
        ratio["short"],
        n=n,
        d=2,
        sets=1,
        holds=holds(ratio["short"] > 2 and below > 0),
    )


def _by_points(sets: SetCache) -> Iterator[ClaimRow]:
    sizes = BNOT_SIZES[: sets.few(len(BNOT_SIZES), 3)]
    timings = interleave({str(n): partial(generate, "bnot", n=n) for n in sizes}, 1.0)
    yield _growth("bnot", "BNOT", sizes, [float(timings[str(n)].cpu.min()) for n in sizes], "log-linear")
    sizes = KDM_SIZES[: sets.few(len(KDM_SIZES), 2)]
    yield _growth("kdm", "KDM", sizes, [timed(partial(generate, "kdm", n=n))[0] for n in sizes], "linear")


def _growth(row: str, title: str, sizes: list[int], seconds: list[float], paper: str) -> ClaimRow:
    slope, error = exponent(sizes, seconds)
    return reported(
        f"{row}-n",
        f"exponent of {title}'s CPU time in n, {sizes[0]:,} to {sizes[-1]:,}",
        f"1 within {SAME:g} ({paper})",
        slope,
        error,
        d=2,
        holds=holds(abs(slope - 1) < SAME),
    )


def _by_dimension(sets: SetCache) -> Iterator[ClaimRow]:
    yield reported("bnot-d", "factor a dimension of BNOT's own time", "exponential", holds=UNTRIED)
    n = sets.few(CELLS, 100)
    rng = np.random.default_rng(SEED)
    x = {str(d): rng.random((n, d)) for d in (2, 3, 4)}
    timings = interleave({d: partial(toroidal_cells, points) for d, points in x.items()}, 4.0)
    for d in (3, 4):
        factor = float(timings[str(d)].cpu.min() / timings[str(d - 1)].cpu.min())
        yield reported(
            f"cells-{d}",
            f"CPU time of {n} toroidal Voronoi cells, d = {d} over d = {d - 1}",
            "above 2: the time grows by a factor a dimension (exponential)",
            factor,
            n=n,
            d=d,
            sets=1,
            holds=holds(factor > 2),
        )
    for d in (2, 3):
        pixels = {side: DensityRaster(4096, side).side ** side for side in (d - 1, d)}
        yield reported(
            f"grid-{d}",
            f"pixels of KDM's grid, d = {d} over d = {d - 1}",
            "the same factor a dimension (exponential)",
            pixels[d] / pixels[d - 1],
            n=4096,
            d=d,
            holds=holds(abs(pixels[d] / pixels[d - 1] / 4 - 1) < 0.1) if d > 2 else BESIDE,
        )
