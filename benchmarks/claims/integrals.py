"""Claims about the integration of smooth functions, and the rate of random points (Sec. 5.2, Fig. 9)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from gbnbench.analysis.integration.estimator import estimate_errors
from gbnbench.analysis.integration.spectral_variance import fourier_series, predicted_variance
from gbnbench.analysis.integration.variance import crossed_mean, slope_of, variance_of
from gbnbench.benchmarks.claims.claim import BESIDE, NO, PARTLY, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.integration_errors import (
    AGREES,
    OTHERS,
    PARALLEL,
    SIZES,
    SMOOTH,
    STEP,
    draw,
    errors,
    integrands,
    slope,
    variance,
)
from gbnbench.benchmarks.claims.sets import FAST, SetCache

LADDER = (16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 16_384)
CONSTANT = 0.25  # change of a rate from one span to the next that still counts as one rate


def random(sets: SetCache) -> Iterator[ClaimRow]:
    """Fit the rate of random points."""
    for family in (SMOOTH, STEP):
        for d, sizes in SIZES.items():
            found = slope(sets, family, "random", d, sizes)
            yield reported(
                f"{family.name}-{d}",
                f"exponent of the variance in n, random points, {family.name}, d = {d}",
                "-1",
                found.value,
                found.standard_error,
                of=draw(sets, "random", sizes[-1], d),
                holds=holds(abs(found.value + 1) < AGREES * found.standard_error),
            )


def best(sets: SetCache) -> Iterator[ClaimRow]:
    """Compare variances of the smooth integrand: orders from GBN up to each other generator."""
    for d, sizes in SIZES.items():
        n = sizes[-1]
        gbn = variance(sets, SMOOTH, FAST, n, d)
        for other in OTHERS[d]:
            found = variance(sets, SMOOTH, other, n, d)
            orders = math.log10(found.value / gbn.value)
            error = math.hypot(*(v.standard_error / v.value for v in (found, gbn))) / math.log(10)
            yield reported(
                f"{other}-{d}",
                f"orders from GBN's variance up to that of {other}, n = {n}, d = {d}",
                "orders of magnitude (2 or more)",
                orders,
                error,
                of=draw(sets, FAST, n, d),
                holds=holds(orders >= 2, PARTLY if orders > AGREES * error else NO),
            )


def sigmoid(sets: SetCache) -> Iterator[ClaimRow]:
    """Follow GBN's variance of the smooth integrand through under- and oversampling, 2D."""
    ladder = LADDER[: sets.few(len(LADDER), 4)]
    found = {n: errors(sets, SMOOTH, FAST, n, 2) for n in ladder}
    for n, one in ((n, variance_of(e)) for n, e in found.items()):
        yield reported(
            f"variance-{n}", f"GBN's variance, n = {n}", "", one.value, one.standard_error,
            of=draw(sets, FAST, n, 2),
        )  # fmt: skip
    lost = {}
    for low, high, paper in (
        (64, 128, ""), (128, 256, ""), (256, 512, ""), (512, 1024, ""), (1024, 4096, ""),
        (4096, 16_384, "-1 within 0.15: its advantage lost"),
    ):  # fmt: skip
        if high not in found:
            continue
        fall = slope_of((low, high), [found[low], found[high]])
        scale = math.log(high / low) / (high - low)
        lost[high] = fall.value * scale
        yield reported(
            f"exponent-{high}", f"exponent of the variance in n, {low} to {high}",
            paper, fall.value, fall.standard_error,
            of=draw(sets, FAST, high, 2),
            holds=holds(abs(fall.value + 1) < PARALLEL) if paper else BESIDE,
        )  # fmt: skip
        yield reported(
            f"share-{high}", f"ln of the variance lost a point, {low} to {high}", "", lost[high],
            fall.standard_error * scale,
            of=draw(sets, FAST, high, 2),
        )  # fmt: skip
    for high in (256, 512):
        if high not in lost:
            continue
        ratio = lost[high] / lost[high // 2]
        yield reported(
            f"constant-{high}",
            f"ln of the variance lost a point, {high // 2} to {high} over {high // 4} to {high // 2}",
            f"1 within {CONSTANT:.0%} (exponential; a power law has 0.5)", ratio,
            of=draw(sets, FAST, high, 2),
            holds=holds(abs(ratio - 1) < CONSTANT),
        )  # fmt: skip
    for other in OTHERS[2]:
        fall = slope(sets, SMOOTH, other, 2, SIZES[2])
        yield reported(
            f"exponent-{other}", f"exponent of the variance in n, {SIZES[2][0]} to {SIZES[2][-1]}, {other}",
            "", fall.value, fall.standard_error, of=draw(sets, other, SIZES[2][-1], 2),
        )  # fmt: skip


def predicted(sets: SetCache) -> Iterator[ClaimRow]:
    """Lay the measured variance beside the inner product of the two spectra."""
    for n in (64, 256, 512, 1024):
        drawn = draw(sets, FAST, n, 2)
        some = integrands(SMOOTH, 2)
        series = fourier_series(SMOOTH, some, 2)
        if series is None:
            raise TypeError("sums of Gaussians have a series")
        told = predicted_variance(series, drawn.x)
        found = variance(sets, SMOOTH, FAST, n, 2)
        joint = crossed_mean(estimate_errors(some, drawn.x) ** 2 - told).standard_error
        yield reported(
            f"foretold-{n}",
            f"measured variance over that foretold by the spectra, n = {n}",
            "1",
            found.value / float(told.mean()),
            joint / float(told.mean()),
            of=drawn,
            holds=holds(abs(found.value - float(told.mean())) < AGREES * joint),
        )


def exponents(sets: SetCache) -> Iterator[ClaimRow]:
    """Compare beta of the points' spectrum with alpha of the integrand's, both over f^2."""
    alpha = (
        2 * math.pi * SMOOTH.width(2)
    ) ** 2  # of |transform of exp(-r^2 / 2 sigma'^2)|^2, sigma' = 512^(-1/2)
    for n, paper in ((256, "below 1"), (1024, "above 1")):
        drawn = sets.draw(FAST, n=n, sets=8)
        c, error = drawn.value("profile_c")
        yield reported(
            f"ratio-{n}",
            f"beta over alpha, n = {n}",
            paper,
            c / n / alpha,
            error / n / alpha,
            of=drawn,
            holds=holds((c / n < alpha) == (paper == "below 1")),
        )
