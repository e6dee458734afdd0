"""Claims about numerical integration (Sec. 5.2, Fig. 9)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from gbnbench.analysis.integration.estimator import estimate_errors
from gbnbench.analysis.integration.integrands.gaussians import Gaussians
from gbnbench.analysis.integration.integrands.half_space import HalfSpaces
from gbnbench.analysis.integration.integrands.protocol import Integrand
from gbnbench.analysis.integration.spectral_variance import fourier_series, predicted_variance
from gbnbench.analysis.integration.variance import Slope, Variance, crossed_mean, slope_of, variance_of
from gbnbench.benchmarks.claims.claim import BESIDE, NO, PARTLY, Row, holds, reported
from gbnbench.benchmarks.claims.sets import FAST, SEED, Drawn, Sets
from gbnbench.core.torus import FloatArray

SMOOTH, STEP = Gaussians(), HalfSpaces()
INSTANCES = 60
LADDER = (16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 16_384)
SIZES = {2: (64, 256, 1024), 3: (64, 216, 1000), 8: (64, 256, 1024)}  # the same for all; 3D has whole grids
OTHERS = {2: ("random", "jittered", "sobol"), 3: ("random", "jittered", "sobol"), 8: ("random", "sobol")}
PARALLEL = 0.15  # difference of two slopes that still counts as one rate
CONSTANT = 0.25  # change of a rate from one span to the next that still counts as one rate
AGAIN = 24  # further draws of sets and integrands, to tell how far a slope moves from draw to draw
AGREES = 3.0  # joint standard errors


@lru_cache(maxsize=8)
def integrands(family: Gaussians | HalfSpaces, d: int, further: int = 0) -> tuple[Integrand, ...]:
    """Draw the integrands that all sets of a dimension are tried on.

    Parameters
    ----------
    family : Gaussians or HalfSpaces
        The family of integrands.
    d : int
        Dimension.
    further : int
        Number of the draw; every number gives other integrands.

    Returns
    -------
    tuple of Integrand
    """
    rng = np.random.default_rng([SEED, d, further] if further else [SEED, d])
    return tuple(family.draw(d, rng) for _ in range(INSTANCES))


def draw(sets: Sets, generator: str, n: int, d: int) -> Drawn:
    """Draw sets for integration, few of those that cost much.

    Parameters
    ----------
    sets : Sets
        The sets that are drawn once and shared.
    generator : str
        The generator, with its settings.
    n, d : int
        Points in a set, and dimension.

    Returns
    -------
    Drawn
    """
    many = 64 if generator != FAST else 8 if n <= 2048 else 4 if n <= 4096 else 2
    return sets.draw(generator, n=n, d=d, sets=many)


def errors(sets: Sets, family: Gaussians | HalfSpaces, generator: str, n: int, d: int) -> FloatArray:
    """Estimate every integral with every set.

    Parameters
    ----------
    sets : Sets
        The sets that are drawn once and shared.
    family : Gaussians or HalfSpaces
        The family of integrands.
    generator : str
        The generator, with its settings.
    n, d : int
        Points in a set, and dimension.

    Returns
    -------
    (integrands, sets) float64
        Estimates less integrals.
    """
    return estimate_errors(integrands(family, d), draw(sets, generator, n, d).x)


def variance(sets: Sets, family: Gaussians | HalfSpaces, generator: str, n: int, d: int) -> Variance:
    """Compute the variance of the estimates.

    Parameters
    ----------
    sets : Sets
        The sets that are drawn once and shared.
    family : Gaussians or HalfSpaces
        The family of integrands.
    generator : str
        The generator, with its settings.
    n, d : int
        Points in a set, and dimension.

    Returns
    -------
    Variance
    """
    return variance_of(errors(sets, family, generator, n, d))


def slope(
    sets: Sets, family: Gaussians | HalfSpaces, generator: str, d: int, sizes: tuple[int, ...]
) -> Slope:
    """Fit the exponent of the variance in n.

    Parameters
    ----------
    sets : Sets
        The sets that are drawn once and shared.
    family : Gaussians or HalfSpaces
        The family of integrands.
    generator : str
        The generator, with its settings.
    d : int
        Dimension.
    sizes : tuple of int
        Numbers of points.

    Returns
    -------
    Slope
    """
    return slope_of(sizes, [errors(sets, family, generator, n, d) for n in sizes])


def random(sets: Sets) -> Iterator[Row]:
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


def best(sets: Sets) -> Iterator[Row]:
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


def sigmoid(sets: Sets) -> Iterator[Row]:
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


def predicted(sets: Sets) -> Iterator[Row]:
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


def exponents(sets: Sets) -> Iterator[Row]:
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


def half_spaces(sets: Sets) -> Iterator[Row]:
    """Fit the rates of the half space, and compare Owen-scrambled Sobol points with the others."""
    means = {}
    for d, sizes in SIZES.items():
        names = (*(name for name in OTHERS[d] if name != "random"), FAST)
        slopes = {name: slope(sets, STEP, name, d, sizes) for name in names}
        means[d] = sum(s.value for s in slopes.values()) / len(slopes)
        for name, found in slopes.items():
            yield reported(
                f"{name}-{d}",
                f"exponent of the variance in n, half space, {name}, d = {d}",
                f"that of all (-{1 + 1 / d:.3g} by theory)",
                found.value,
                found.standard_error,
                of=draw(sets, name, sizes[-1], d),
                holds=holds(abs(found.value - means[d]) < max(PARALLEL, AGREES * found.standard_error)),
            )
    for d, before in ((3, 2), (8, 3)):
        yield reported(
            f"mean-{d}", f"mean of these exponents, d = {d}", f"nearer to -1 than d = {before}", means[d],
            d=d,
            holds=holds(abs(means[d] + 1) < abs(means[before] + 1)),
        )  # fmt: skip
    again = np.array(redrawn(sets, "jittered", 3))
    for row, title, value, error in (
        ("redrawn-mean", "mean", again.mean(), again.std(ddof=1) / math.sqrt(len(again))),
        ("redrawn-spread", "standard deviation", again.std(ddof=1), math.nan),
    ):
        yield reported(
            row,
            f"{title} of the exponent, half space, jittered, d = 3, over {len(again)} other draws of all",
            "", float(value), float(error), n=SIZES[3][-1], d=3, sets=64,
        )  # fmt: skip


def redrawn(sets: Sets, generator: str, d: int, further: int = AGAIN) -> list[float]:
    """Repeat the exponent of the half spaces' variance on further draws, 64 sets and 60 half spaces each.

    Parameters
    ----------
    sets : Sets
        The sets that are drawn once and shared.
    generator : str
        The generator, with its settings.
    d : int
        Dimension.
    further : int
        Number of further draws.

    Returns
    -------
    list of float
        One exponent for each further draw.
    """
    many = 64
    drawn = [sets.draw(generator, n=n, d=d, sets=(further + 1) * many).x for n in SIZES[d]]
    return [
        slope_of(
            SIZES[d],
            [estimate_errors(integrands(STEP, d, k), x[k * many : (k + 1) * many]) for x in drawn],
        ).value
        for k in range(1, further + 1)
    ]


def owen(sets: Sets) -> Iterator[Row]:
    """Compare half spaces by Owen-scrambled Sobol points and by GBN."""
    for d, sizes in SIZES.items():
        a, b = (variance(sets, STEP, name, sizes[-1], d) for name in ("sobol", FAST))
        error = a.value / b.value * math.hypot(a.standard_error / a.value, b.standard_error / b.value)
        yield reported(
            f"sobol-{d}", f"variance of Owen-scrambled Sobol over GBN, half space, n = {sizes[-1]}, d = {d}",
            "below 1", a.value / b.value, error, of=draw(sets, FAST, sizes[-1], d),
            holds=holds(a.value < b.value),
        )  # fmt: skip
