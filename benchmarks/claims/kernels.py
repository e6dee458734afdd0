"""Claims about the kernel: its width sigma and its support (Sec. 4.3, 4.4)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.benchmarks.claims.claim import BESIDE, PARTLY, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import FAST, SEED, SetCache
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.kernel_profile import truncated_transform

SIGMAS = (0.5, 0.7, 0.85, 1.0, 1.2, 1.5)


def widths(sets: SetCache) -> Iterator[ClaimRow]:
    """Measure the trade-off of Fig. 3(a)."""
    drawn = {sigma: sets.draw(f"gbn[sigma={sigma:g}]" if sigma != 1 else FAST) for sigma in SIGMAS}
    for sigma, some in drawn.items():
        for row, measure in (
            ("floor", "noise_floor"),
            ("peak", "peak"),
            ("oscillations", "oscillations"),
            ("nyquist", "effective_nyquist"),
            ("evacuated", "evacuated_energy"),
            ("psi6", "psi6"),
        ):
            yield reported(
                f"{row}-{sigma:g}",
                f"{measure.replace('_', ' ')}, sigma = {sigma:g}",
                "",
                *some.value(measure),
                of=some,
            )
    size = drawn[1.0]
    of = {sigma: some.measures for sigma, some in drawn.items()}
    residual = math.log10(of[0.5]["noise_floor"] / of[1.0]["noise_floor"])
    yield reported(
        "narrow-floor",
        "orders from the floor at sigma = 1 up to that at 0.5",
        "above 0: residual low frequencies",
        residual,
        of=size,
        holds=holds(residual > 1),
    )
    ringing = of[0.5]["oscillations"] / of[1.0]["oscillations"]
    yield reported(
        "narrow-oscillations",
        "oscillations at sigma = 0.5 over those at 1",
        "above 1: too much oscillation",
        ringing,
        of=size,
        holds=holds(ringing > 1),
    )
    gain = math.log10(of[1.0]["noise_floor"] / of[1.5]["noise_floor"])
    yield reported(
        "wide-floor",
        "orders from the floor at sigma = 1.5 up to that at 1",
        "above 0: lower floor",
        gain,
        of=size,
        holds=holds(gain > 0),
    )
    band = of[1.5]["effective_nyquist"] / of[1.0]["effective_nyquist"]
    yield reported(
        "wide-band",
        "effective Nyquist frequency at sigma = 1.5 over that at 1",
        "below 1: narrower band",
        band,
        of=size,
        holds=holds(band < 1),
    )
    best = max(of, key=lambda sigma: of[sigma]["evacuated_energy"])
    yield reported(
        "best", "sigma of the largest evacuated energy", "1", best, of=size, holds=holds(best == 1, PARTLY)
    )


def alike(sets: SetCache) -> Iterator[ClaimRow]:
    """Compare the two settings of Fig. 2."""
    narrow = sets.draw("gbn[sigma=0.5,iterations=30]")
    wide = sets.draw("gbn[sigma=1.1,gradients=3000]")
    for row, measure, most in (
        ("mean-distance", "mean_distance", 0.05),
        ("psi6", "psi6", 0.15),
        ("v6", "valence6", 0.15),
    ):
        a, b = (some.value(measure) for some in (narrow, wide))
        for name, some in (("narrow", a), ("wide", b)):
            yield reported(f"{row}-{name}", f"{measure.replace('_', ' ')}, {name}", "", *some, of=narrow)
        yield reported(
            row,
            f"{measure.replace('_', ' ')}: sigma = 0.5, 30 steps over sigma = 1.1, 1M steps",
            f"1 within {most:.0%}: look alike",
            a[0] / b[0],
            of=narrow,
            holds=holds(abs(a[0] / b[0] - 1) < most),
        )
    orders = math.log10(narrow.measures["noise_floor"] / wide.measures["noise_floor"])
    yield reported(
        "floor",
        "orders from the floor of the latter up to that of the former",
        "very different",
        orders,
        of=narrow,
        holds=holds(orders > 3),
    )


def leak(_: SetCache) -> Iterator[ClaimRow]:
    """High frequencies that truncation lets in: the transform at nu = 1 over that at 0, sigma = 1 spacing."""
    levels = []
    for cutoff in (1.0, 2.0, 6.0, math.inf):
        at = np.abs(truncated_transform(np.linspace(0.9, 1.1, 201), 1.0, cutoff, 2)).max()
        levels.append(float(at / truncated_transform(np.zeros(1), 1.0, cutoff, 2)[0]))
        yield reported(
            f"leak-{cutoff:g}",
            f"largest transform at nu = 0.9 to 1.1 over that at 0, 2D, support {cutoff:g} sigma",
            "" if len(levels) == 1 else "less than with a smaller support",
            levels[-1],
            d=2,
            holds=BESIDE if len(levels) == 1 else holds(levels[-1] < levels[-2]),
        )


def truncated(sets: SetCache) -> Iterator[ClaimRow]:
    """Draw sets of truncated kernels after 10,000 steps, and Lloyd's beside that of 1 sigma."""
    whole = sets.draw(FAST, sets=8)
    some = {
        cutoff: sets.draw(f"gbn[iterations=10000,cutoff={cutoff:g}]", sets=2) for cutoff in (1.0, 2.0, 3.0)
    }
    for cutoff, drawn in (*some.items(), (math.inf, whole)):
        for row, measure in (
            ("psi6", "psi6"),
            ("v6", "valence6"),
            ("floor", "noise_floor"),
            ("peak", "peak"),
            ("distance", "mean_distance"),
            ("nearest", "min_distance"),
        ):
            yield reported(
                f"{row}-{cutoff:g}",
                f"{measure.replace('_', ' ')}, support {cutoff:g} sigma",
                "",
                *drawn.value(measure),
                of=drawn,
            )
    for cutoff, drawn in some.items():
        orders = math.log10(drawn.measures["noise_floor"] / whole.measures["noise_floor"])
        yield reported(
            f"distorted-{cutoff:g}",
            f"orders from the whole kernel's floor up to that of {cutoff:g} sigma",
            "above 0: distorted",
            orders,
            of=drawn,
            holds=holds(orders > 1),
        )
    for cutoff in (1.0, 2.0, 3.0):
        nu = np.linspace(0, 3, 3001)
        transform = truncated_transform(nu, 1.0, cutoff, 2)
        yield reported(
            f"negative-{cutoff:g}",
            f"most negative value of the transform over that at 0, support {cutoff:g} sigma",
            "",
            float(transform.min() / transform[0]),
            d=2,
        )
    lloyd = sets.draw("lloyd", sets=4)
    for row, measure, within in (
        ("psi6", "psi6", 0.1),
        ("v6", "valence6", 0.1),
        ("distance", "mean_distance", 0.03),
    ):
        ratio = some[1.0].measures[measure] / lloyd.measures[measure]
        yield reported(
            f"cvt-{row}",
            f"{measure.replace('_', ' ')} of 1 sigma over that of Lloyd's (CVT)",
            f"1 within {within:.0%}: similar",
            ratio,
            of=lloyd,
            holds=holds(abs(ratio - 1) < within),
        )


def support(sets: SetCache) -> Iterator[ClaimRow]:
    """Measure what pairs beyond 6 and 9 sigma add: to an energy of 1 and to the forces."""
    x = sets.draw(FAST, n=1024).x[:1]
    whole = energy_evaluation(1024, 2, 1.0, "double", method="images")(x).gradient
    loose = np.random.default_rng(SEED).random((1, 1024, 2))
    scale = np.abs(energy_evaluation(1024, 2, 1.0, "double", method="images")(loose).gradient).max()
    for name, reach in (("float", 6.0), ("double", 9.0)):
        eps = kernel.EPS[name]
        energy = math.exp(-(reach**2) / 2)
        yield reported(
            f"energy-{name}",
            f"energy of a pair {reach:g} sigma apart over the rounding of {name}",
            "below 1",
            energy / eps,
            holds=holds(energy < eps),
        )
        cut = energy_evaluation(1024, 2, 1.0, "double", method="strips", cutoff=reach)(x).gradient
        yield reported(
            f"force-{name}",
            f"force of all pairs beyond {reach:g} sigma over the largest at random points",
            "",
            float(np.abs(cut - whole).max() / scale),
            n=1024,
            d=2,
            sets=1,
        )
