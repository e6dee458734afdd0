"""Claims about the descent: how fast, in what order, where it digs first (Sec. 4.2, 4.3, 4.8)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from gbnbench.benchmarks.claims.claim import BESIDE, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.profile import STEEPNESS
from gbnbench.benchmarks.claims.sets import DrawnSets, SetCache

STOPS = (3, 10, 15, 30, 100, 300, 500, 1000, 3000, 10_000)
LARGER = (100, 300, 500, 1000)  # of them, those that 4,096 points take, too
LOWEST = 10.0  # times the fitted profile within which the lowest frequency belongs to it
SHAPED = (0.1, 2.0)  # departure of c from 4 pi^2 and residual in dB within which a profile has its shape
RING = 0.025  # width in nu of the bands in which the fastest fall is looked for


def shape(sets: SetCache) -> Iterator[ClaimRow]:
    """Profile after so many steps of the paper's descent, and whether the lowest frequency has come to it."""
    for n, stops in ((1024, STOPS), (4096, LARGER)):
        trace = sets.evolution(stops, n=n, sets=4 if n == 1024 else 2)
        ladder = dict(zip(stops, trace.keep_at, strict=True))
        for stop in LARGER:
            drawn = DrawnSets(trace.points(ladder[stop]))
            told = drawn.measures
            c = told["profile_c"]
            lowest = drawn.radial.power[0] / (
                told["profile_epsilon"] * math.exp(c * float(drawn.radial.nu[0]) ** 2)
            )
            shaped = abs(c / STEEPNESS - 1) < SHAPED[0] and told["profile_residual_db"] < SHAPED[1]
            there = shaped and lowest < LOWEST
            paper = {100: "not yet", 500: "there"}.get(stop, "")
            yield reported(
                f"lowest-{n}-{stop}",
                f"P(|f| = 1) over the profile fitted above it, {stop} steps, n = {n}",
                paper,
                float(lowest),
                of=drawn,
                holds=holds(there == (paper == "there")) if paper else BESIDE,
            )
            yield reported(
                f"c-{n}-{stop}",
                f"c over 4 pi^2 after {stop} steps, n = {n}",
                "",
                c / STEEPNESS,
                told.standard_error["profile_c"] / STEEPNESS,
                of=drawn,
            )
            yield reported(
                f"residual-{n}-{stop}",
                f"rms residual of the fit, dB, after {stop} steps, n = {n}",
                "",
                *drawn.value("profile_residual_db"),
                of=drawn,
            )


def longer(sets: SetCache) -> Iterator[ClaimRow]:
    """Noise floor along the ladder, and order at its ends."""
    trace = sets.evolution(STOPS)
    floors = []
    for stop, at in zip(STOPS, trace.keep_at, strict=True):
        x = trace.points(at)
        drawn = DrawnSets(x)
        told = drawn.measures
        floors.append(told["noise_floor"])
        if stop in (10, 15, 500, 1000, 10_000):
            yield reported(
                f"floor-{stop}",
                f"noise floor after {stop} steps",
                "",
                floors[-1],
                told.standard_error["noise_floor"],
                of=drawn,
            )
        if stop in (500, 10_000):
            yield reported(
                f"psi6-{stop}",
                f"psi6 after {stop} steps (1 is the triangular grid)",
                "",
                told["psi6"],
                told.standard_error["psi6"],
                of=drawn,
            )
    worst = max(b / a for a, b in pairwise(floors[1:]))
    yield reported(
        "monotone",
        "largest ratio of a floor to the one before it, from 10 steps on",
        "below 1: more is better",
        worst,
        n=1024,
        d=2,
        sets=len(trace.points(trace.keep_at[0])),
        holds=holds(worst < 1),
    )


def rate(sets: SetCache) -> Iterator[ClaimRow]:
    """Local exponents of the excess energy in the count of steps, and its share left by each step."""
    frame = sets.evolution(STOPS).to_frame()
    excess = frame.groupby("gradient").excess.mean()
    last = int(excess.index.max())
    spans = [(a, b) for a, b in ((10, 100), (100, 500), (500, 3000), (3000, 10_000)) if b <= last]
    found = []
    for low, high in spans:
        exponent = math.log(excess[high] / excess[low]) / math.log(high / low)
        found.append(math.log(excess[high] / excess[low]) / (high - low))
        yield reported(
            f"exponent-{high}",
            f"exponent of the excess energy in the count of steps, {low} to {high}",
            "slower from 500 on" if low == 500 else "",
            exponent,
            n=1024,
            d=2,
            sets=int(frame["set"].nunique()),
            holds=BESIDE,
        )
        yield reported(
            f"share-{high}",
            f"ln of the excess energy lost a step, {low} to {high}",
            "constant (linear convergence), then less" if high <= 500 else "less than before",
            found[-1],
            n=1024,
            d=2,
            sets=int(frame["set"].nunique()),
            holds=BESIDE
            if len(found) == 1
            else holds(
                abs(found[-1] / found[-2]) < 0.5 if high > 500 else 0.67 < found[-1] / found[-2] < 1.5
            ),
        )


def dug(sets: SetCache) -> Iterator[ClaimRow]:
    """Find the band of nu that has lost most power after three steps."""
    trace = sets.evolution((3,), n=4096, sets=8)
    drawn = DrawnSets(trace.points(trace.keep_at[0]))
    radial = drawn.radial
    band = np.floor(radial.nu / RING).astype(np.int64)
    mean = np.bincount(band, radial.count * radial.power) / np.maximum(np.bincount(band, radial.count), 1)
    mean[0] = np.inf  # a single shell, or none
    nu = (int(np.argmin(mean)) + 0.5) * RING
    yield reported(
        "nu",
        "nu of the band with least power after 3 steps",
        "0.159 (sigma of the kernel's image)",
        nu,
        RING / 2,
        of=drawn,
        holds=holds(abs(nu - 1 / (2 * math.pi)) < RING),
    )
    yield reported(
        "fastest",
        "nu where |q|^2 w_q, the rate of small steps, is largest: sqrt(2) / 2 pi",
        "",
        math.sqrt(2) / (2 * math.pi),
        holds=BESIDE,
    )
