"""Claims about the kernel on the torus: nearest images, Poisson's series, profiles (Sec. 4.4, 4.5)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.analysis.radial.profile_measures import noise_floor
from gbnbench.benchmarks.claims.claim import BESIDE, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import SEED, DrawnSets, SetCache
from gbnbench.core.torus import wrap
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.kernel_profile import energy_profile
from gbnbench.generators.gbn.optimiser import Descent
from gbnbench.generators.gbn.step_sizes import step_size
from gbnbench.generators.protocol import realization_rng


def images(_: SetCache) -> Iterator[ClaimRow]:
    """Add what the nearest image alone leaves out: all other images, the kernel's top being 1."""
    # The others are added by themselves: as a difference from theta 18 spacings would give its rounding.
    others = np.array([k for k in range(-20, 21) if k])[:, None]
    for side, precision in ((4.0, ""), (8.0, ""), (12.0, "float"), (18.0, "double")):
        u = np.linspace(0, side / 2, 501)
        error = float(np.exp(-((u - others * side) ** 2) / 2).sum(axis=0).max())
        yield reported(
            f"side-{side:g}",
            f"error of the nearest image alone, {side:g} spacings a side, sigma = 1",
            f"below the rounding of {precision}" if precision else "wrong: above the rounding of float",
            error,
            holds=holds(error < kernel.EPS[precision] if precision else error > kernel.EPS["float"]),
        )


def series(_: SetCache) -> Iterator[ClaimRow]:
    """Eq. (22) and (23): both sides, in the paper's unit box."""
    for sigma in (0.05, 0.2, 0.5):
        x = np.linspace(0, 1, 257)
        k, f = np.arange(-40, 41)[:, None], np.arange(1, 41)[:, None]
        sum_of_gaussians = np.exp(-((x - k) ** 2) / (2 * sigma**2)).sum(axis=0)
        cosines = (np.exp(-2 * np.pi**2 * sigma**2 * f**2) * np.cos(2 * np.pi * f * x)).sum(axis=0)
        scale = math.sqrt(2 * math.pi) * sigma
        right = float(np.abs(scale * (1 + 2 * cosines) - sum_of_gaussians).max() / sum_of_gaussians.max())
        printed = float(
            np.abs(scale * (2 + 2 * cosines) - sum_of_gaussians).max() / sum_of_gaussians.max()
        )  # all f, 0 among them
        yield reported(
            f"theta-{sigma:g}",
            f"largest error over theta(0) of Eq. 22 with 1 + 2 sum over f >= 1, sigma = {sigma:g} boxes",
            "0",
            right,
            d=1,
            holds=holds(right < 1e-9),
        )
        yield reported(
            f"printed-{sigma:g}",
            f"the same with the sum of Eq. 23 as printed, over all f and 1 besides, sigma = {sigma:g} boxes",
            "0",
            printed,
            d=1,
            holds=holds(printed < 1e-9),
        )


def harmonics(_: SetCache) -> Iterator[ClaimRow]:
    """Run one descent by images and by harmonics, from one start."""
    n, steps = 256, 300
    start = realization_rng(SEED, 0).random((1, n, 2))
    ends = []
    for method in ("images", "harmonics"):
        run = Descent(energy_evaluation(n, 2, 1.0, "double", method=method), start, step_size(n, 2, 1.0))
        for _step in range(steps):
            run.advance()
        ends.append(run.x)
    away = np.abs(ends[0] - ends[1]).max() * math.sqrt(n)
    yield reported(
        "points",
        f"largest distance of the points, spacings, {steps} steps",
        "almost 0",
        float(away),
        n=n,
        d=2,
        sets=1,
        holds=holds(away < 1e-3),
    )
    floors = [noise_floor(DrawnSets(wrap(end)).radial) for end in ends]
    yield reported(
        "floor",
        "ratio of the noise floors",
        "1",
        floors[0] / floors[1],
        n=n,
        d=2,
        sets=1,
        holds=holds(abs(floors[0] / floors[1] - 1) < 0.01),
    )


def flat(_: SetCache) -> Iterator[ClaimRow]:
    """Measure the profiles of Fig. 6: how flat, and whether Gaussian or raised cosine."""
    for side in (1.0, 2.0, 4.0, 8.0):
        u = np.linspace(-side / 2, side / 2, 1025)
        profile = energy_profile(u, side, 1.0)
        fall = float(1 - profile.min())
        gaussian = np.exp(-(u**2) / 2)
        cosine = profile.min() + fall * (1 + np.cos(2 * np.pi * u / side)) / 2
        to_gaussian, to_cosine = (
            float(np.sqrt(np.mean((profile - other) ** 2)) / fall) for other in (gaussian, cosine)
        )
        yield reported(
            f"fall-{side:g}",
            f"fall of the profile from its top to its lowest, {side:g} points an axis",
            "almost flat" if side <= 1 else "",
            fall,
            holds=holds(fall < 0.05) if side <= 1 else BESIDE,
        )
        yield reported(
            f"gaussian-{side:g}",
            f"rms distance from the Gaussian over the fall, {side:g} points an axis",
            "",
            to_gaussian,
        )
        yield reported(
            f"cosine-{side:g}",
            f"rms distance from a raised cosine over the fall, {side:g} points an axis",
            "below that from the Gaussian" if side == 8 else "",
            to_cosine,
            holds=holds(to_cosine < to_gaussian) if side == 8 else BESIDE,
        )
