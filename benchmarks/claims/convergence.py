"""Claims about the descent: how fast, in what order, what a million steps leave (Sec. 4.2, 4.3, 4.8)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from gbnbench.benchmarks.claims.claim import BESIDE, Row, holds, reported
from gbnbench.benchmarks.claims.profile import STEEPNESS
from gbnbench.benchmarks.claims.sets import FAST, MILLION, PAPER, Drawn, Sets
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.energy import energy_evaluation

STOPS = (3, 10, 15, 30, 100, 300, 500, 1000, 3000, 10_000)
LARGER = (100, 300, 500, 1000)  # of them, those that 4,096 points take, too
LOWEST = 10.0  # times the fitted profile within which the lowest frequency belongs to it
SHAPED = (0.1, 2.0)  # departure of c from 4 pi^2 and residual in dB within which a profile has its shape
RING = 0.025  # width in nu of the bands in which the fastest fall is looked for
ALIKE = (1.5, 1.1)  # factors within which two ways leave the same depth and the same order
ZERO = 1e-9  # of the largest curvature, below which one is 0: finite differences leave 1e-11


def shape(sets: Sets) -> Iterator[Row]:
    """Profile after so many steps of the paper's descent, and whether the lowest frequency has come to it."""
    for n, stops in ((1024, STOPS), (4096, LARGER)):
        trace = sets.evolution(stops, n=n, sets=4 if n == 1024 else 2)
        ladder = dict(zip(stops, trace.keep_at, strict=True))
        for stop in LARGER:
            drawn = Drawn(trace.points(ladder[stop]))
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


def longer(sets: Sets) -> Iterator[Row]:
    """Noise floor along the ladder, and order at its ends."""
    trace = sets.evolution(STOPS)
    floors = []
    for stop, at in zip(STOPS, trace.keep_at, strict=True):
        x = trace.points(at)
        drawn = Drawn(x)
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


def rate(sets: Sets) -> Iterator[Row]:
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


def dug(sets: Sets) -> Iterator[Row]:
    """Find the band of nu that has lost most power after three steps."""
    trace = sets.evolution((3,), n=4096, sets=8)
    drawn = Drawn(trace.points(trace.keep_at[0]))
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


def equivalence(sets: Sets) -> Iterator[Row]:
    """Descent of 100,000 steps beside 1,000 gradients of Nesterov's method, on the same starts."""
    slow = sets.draw("gbn[iterations=100000]", n=256, sets=3)
    fast = sets.draw("gbn[gradients=1000]", n=256, sets=3)
    excess = [energy_evaluation(256, 2, 1.0)(drawn.x).excess for drawn in (slow, fast)]
    ratio = float(excess[1].mean() / excess[0].mean())
    yield reported(
        "excess",
        "excess energy after 1,000 gradients over that after 100,000 steps",
        f"1 within a factor of {ALIKE[0]:g}",
        ratio,
        of=slow,
        holds=holds(1 / ALIKE[0] < ratio < ALIKE[0]),
    )
    for row, measure, factor in (
        ("floor", "noise_floor", ALIKE[0]),
        ("peak", "peak", ALIKE[1]),
        ("psi6", "psi6", ALIKE[1]),
        ("v6", "valence6", ALIKE[1]),
    ):
        a, b = slow.value(measure), fast.value(measure)
        ratio = b[0] / a[0]
        yield reported(
            row,
            f"{measure.replace('_', ' ')} after 1,000 gradients over that after 100,000 steps",
            f"1 within a factor of {factor:g}",
            ratio,
            ratio * math.hypot(a[1] / a[0], b[1] / b[0]),
            of=slow,
            holds=holds(1 / factor < ratio < factor),
        )


def million(sets: Sets) -> Iterator[Row]:
    """Isotropy and order of sets as deep as a million steps leave."""
    for row, spec in (("10k", PAPER), ("1M", MILLION)):
        drawn = sets.draw(spec, sets=8)
        away, error = drawn.value("anisotropy_db")
        away += 10 * math.log10(len(drawn.x))
        yield reported(
            f"anisotropy-{row}",
            f"anisotropy over that of isotropic noise, dB, {row} steps",
            "0",
            away,
            error,
            of=drawn,
            holds=holds(abs(away) < 0.5) if row == "1M" else BESIDE,
        )
        for measure in ("psi6", "valence6", "peak"):
            limit = {"psi6": 0.5, "valence6": 0.7, "peak": 4.0}[measure]
            found = drawn.value(measure)
            yield reported(
                f"{measure}-{row}",
                f"{measure}, {row} steps",
                f"no triangular grid (below {limit:g})" if row == "1M" else "",
                *found,
                of=drawn,
                holds=holds(found[0] < limit) if row == "1M" else BESIDE,
            )


def repeated(_: Sets) -> Iterator[Row]:
    """Run one start twice."""
    first, second = (Sets().draw("gbn[iterations=300]", n=256, sets=2).x for _twice in range(2))
    away = float(np.abs(first - second).max())
    yield reported(
        "repeat",
        "largest difference of two runs from one start",
        "0",
        away,
        n=256,
        d=2,
        sets=2,
        holds=holds(away == 0),
    )


def hessian_of(x: FloatArray, h: float = 1e-4) -> FloatArray:
    """Compute the Hessian of the energy at one set by central differences of the gradient.

    Parameters
    ----------
    x : (n, d) float64
        The set.
    h : float
        Distance that each coordinate is moved to either side, in spacings.

    Returns
    -------
    (n d, n d) float64
        In units of spacings.
    """
    n, d = x.shape
    energy = energy_evaluation(n, d, 1.0, "double")
    side = n ** (1 / d)
    moves = np.eye(n * d).reshape(n * d, n, d) * h / side
    slope = (energy(x + moves).gradient - energy(x - moves).gradient).reshape(n * d, n * d) / (2 * h)
    return np.asarray((slope + slope.T) / 2)


def singular(sets: Sets) -> Iterator[Row]:
    """Null directions of the Hessian, and what a second-order method reaches all the same."""
    x = sets.draw("gbn[iterations=10000]", n=64, sets=2).x[0]
    values = np.linalg.eigvalsh(hessian_of(x))
    yield reported(
        "null",
        f"curvatures below {ZERO:g} of the largest, of 128, at a set of 10,000 steps",
        "1 or more",
        float((np.abs(values) < ZERO * values.max()).sum()),
        n=64,
        d=2,
        sets=1,
        holds=holds(bool((np.abs(values) < ZERO * values.max()).any())),
    )
    yield reported(
        "spread",
        "largest over median curvature there",
        "",
        float(values.max() / np.median(values)),
        n=64,
        d=2,
        sets=1,
    )
    deep = sets.draw("deep")
    gain = math.log10(sets.draw(PAPER, sets=8).measures["noise_floor"] / deep.measures["noise_floor"])
    yield reported(
        "newton",
        "orders by which minimum-norm Gauss-Newton (deep) lies below the descent's floor",
        "0 (second-order methods ruled out)",
        gain,
        of=deep,
        holds=holds(gain < 1),
    )


def dimensions(sets: Sets) -> Iterator[Row]:
    """Level eps of the lowest shell after 500 steps of descent, by the dimension and the step."""
    for step, title in (("auto", "the step that curvature allows"), ("authors", "the authors' step")):
        found: list[float] = []
        for d in (2, 3, 4, 8):
            drawn = sets.draw(f"gbn[iterations=500,step={step}]", d=d, sets=2)
            found.append(drawn.level)
            yield reported(
                f"{step}-{d}",
                f"P exp(-4 pi^2 nu^2) at |f| = 1 after 500 steps, d = {d}, {title}",
                "" if d == 2 else "below that of d = 2",
                found[-1],
                of=drawn,
                holds=BESIDE if d == 2 else holds(found[-1] < found[0]),
            )


def high(sets: Sets) -> Iterator[Row]:
    """Floors of the same number of points in 2 to 8 dimensions, and that 20 dimensions move at all."""
    plane = sets.draw(FAST, sets=8)
    for d in (2, 3, 4, 6, 8):
        drawn = plane if d == 2 else sets.draw(FAST, d=d, sets=4)
        yield reported(
            f"level-{d}",
            f"P exp(-4 pi^2 nu^2) at |f| = 1 after 320 gradients, d = {d}",
            "" if d == 2 else "that of d = 2 or less",
            drawn.level,
            of=drawn,
            holds=BESIDE if d == 2 else holds(drawn.level < 2 * plane.level),
        )
        yield reported(f"at-1-{d}", f"P(|f| = 1), d = {d}", "", drawn.lowest, of=drawn)
    drawn = sets.draw(FAST, n=256, d=20, sets=2)
    yield reported(
        "twenty",
        "P(|f| = 1) in 20 dimensions, white noise being 1",
        "blue noise (far below 1)",
        drawn.lowest,
        of=drawn,
        holds=holds(drawn.lowest < 1e-3),
    )
