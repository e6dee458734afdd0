"""Claims about time: in the number of points, the dimension, and on the clock (Sec. 5.4)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.benchmarks.claims.claim import UNTRIED, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import SEED, SetCache
from gbnbench.benchmarks.timing.interleaved import Call, interleave
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.protocol import EnergyEvaluation

SAME = 0.2  # departure of an exponent from a whole one, and of times from a line, that counts as none
RUNS = 5  # of the timings by dimension: of each the least, since single runs scatter
WIDTH = 4.0  # sigmas a side of the kernels timed by dimension: the same polynomial in each


def gradient(evaluate: EnergyEvaluation, n: int, d: int) -> Call:
    """Prepare a call that computes one gradient of one random set.

    Parameters
    ----------
    evaluate : EnergyEvaluation
        The evaluation of the energy.
    n, d : int
        Points in a set, and dimension.

    Returns
    -------
    callable
    """
    x = np.random.default_rng(SEED).random((1, n, d))
    return lambda: evaluate(x)


def exponent(sizes: list[int], seconds: list[float]) -> tuple[float, float]:
    """Fit the slope of ln seconds over ln size.

    Parameters
    ----------
    sizes : list of int
        Sizes.
    seconds : list of float
        The time that each took.

    Returns
    -------
    slope, standard_error : float
    """
    x, y = np.log(sizes), np.log(seconds)
    (slope, at), *_ = np.polyfit(x, y, 1, full=True)
    rest = y - slope * x - at
    error = math.sqrt(float(rest @ rest) / max(1, len(x) - 2) / float(((x - x.mean()) ** 2).sum()))
    return float(slope), error


def by_points(sets: SetCache) -> Iterator[ClaimRow]:
    """CPU time of a gradient against n."""
    for row, d, sizes, method, paper in (
        ("all-pairs", 8, [512, 1024, 2048, 4096], "theta", f"2 within {SAME:g} (quadratic)"),
        ("strips", 2, [4096, 16_384, 65_536, 262_144], "strips", f"2 within {SAME:g} (quadratic)"),
    ):
        sizes = sizes[: sets.few(len(sizes), 3)]
        calls = {str(n): gradient(energy_evaluation(n, d, 1.0, "double", method=method), n, d) for n in sizes}
        timings = interleave(calls, 4.0)
        slope, error = exponent(sizes, [float(timings[str(n)].cpu.min()) for n in sizes])
        yield reported(
            row,
            f"exponent of a gradient's CPU time in n, d = {d}, {method}",
            paper,
            slope,
            error,
            d=d,
            holds=holds(abs(slope - 2) < SAME),
        )


def by_dimension(sets: SetCache) -> Iterator[ClaimRow]:
    """CPU time of a gradient against d, all else equal: all pairs, one polynomial."""
    n, dimensions = 1024, [2, 4, 6, 8, 12, 16]
    calls = {}
    for d in dimensions:
        calls[str(d)] = gradient(
            energy_evaluation(n, d, n ** (1 / d) / WIDTH, "double", method="theta"), n, d
        )
    runs = [interleave(calls, 4.0) for _ in range(sets.few(RUNS))]
    seconds = np.array([min(float(run[str(d)].cpu.min()) for run in runs) for d in dimensions])
    slope, error = exponent(dimensions, list(seconds))
    yield reported(
        "exponent",
        "exponent of a gradient's CPU time in d, 2 to 16, all pairs, a kernel 1/4 of the box wide",
        f"1 within {SAME:g} (linear)",
        slope,
        error,
        n=n,
        d=16,
        sets=1,
        holds=holds(abs(slope - 1) < SAME),
    )
    away = np.abs(np.polyval(np.polyfit(dimensions, seconds, 1), dimensions) / seconds - 1)
    worst, at = float(away.max()), dimensions[int(away.argmax())]
    yield reported(
        "straight",
        f"largest relative departure from a straight line in d, at d = {at}",
        f"below {SAME:g}",
        worst,
        n=n,
        d=16,
        sets=1,
        holds=holds(worst < SAME),
    )


def titan(_: SetCache) -> Iterator[ClaimRow]:
    """Time 10,000 steps of 4,096 points here, and what gives the same quality."""
    n = 4096
    calls = {name: gradient(energy_evaluation(n, 2, 1.0, name), n, 2) for name in ("double", "float")}
    timings = interleave(calls, 2.0)
    for name, timing in timings.items():
        seconds = float(timing.cpu.min())
        yield reported(
            f"descent-{name}",
            f"CPU seconds of 10,000 of our gradients of 4,096 points, {name}, one thread",
            "5 s on a Titan",
            10_000 * seconds,
            n=n,
            d=2,
            sets=1,
            holds=UNTRIED,
        )
        yield reported(
            f"nesterov-{name}",
            f"CPU seconds of the 320 gradients that do the same, {name}, one thread",
            "",
            320 * seconds,
            n=n,
            d=2,
            sets=1,
        )


def large(_: SetCache) -> Iterator[ClaimRow]:
    """Hundreds of thousands of points, and millions."""
    hours = 0.0
    for n, steps, title in ((100_000, 10_000, "10,000 steps"), (1_000_000, 10_000, "10,000 steps")):
        timing = interleave({"one": gradient(energy_evaluation(n, 2, 1.0, "double"), n, 2)}, 1.0)["one"]
        hours = steps * float(timing.cpu.min()) / 3600
        yield reported(
            f"descent-{n}",
            f"CPU hours of {title} of {n:,} points within 9 sigma",
            "reasonable" if n < 1e6 else "reasonable within 9 sigma",
            hours,
            n=n,
            d=2,
            sets=1,
            holds=holds(hours < 24),
        )
        yield reported(
            f"nesterov-{n}",
            f"CPU minutes of 320 gradients of {n:,} points",
            "",
            320 * float(timing.cpu.min()) / 60,
            n=n,
            d=2,
            sets=1,
        )
