"""Claims about the integration of half spaces (Sec. 5.2, Fig. 9)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.analysis.integration.estimator import estimate_errors
from gbnbench.analysis.integration.variance import slope_of
from gbnbench.benchmarks.claims.claim import ClaimRow, holds, reported
from gbnbench.benchmarks.claims.integration_errors import (
    AGREES,
    OTHERS,
    PARALLEL,
    SIZES,
    STEP,
    draw,
    integrands,
    slope,
    variance,
)
from gbnbench.benchmarks.claims.sets import FAST, SetCache

AGAIN = 24  # further draws of sets and integrands, to tell how far a slope moves from draw to draw


def half_spaces(sets: SetCache) -> Iterator[ClaimRow]:
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


def redrawn(sets: SetCache, generator: str, d: int, further: int = AGAIN) -> list[float]:
    """Repeat the exponent of the half spaces' variance on further draws, 64 sets and 60 half spaces each.

    Parameters
    ----------
    sets : SetCache
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


def owen(sets: SetCache) -> Iterator[ClaimRow]:
    """Compare half spaces by Owen-scrambled Sobol points and by GBN."""
    for d, sizes in SIZES.items():
        a, b = (variance(sets, STEP, name, sizes[-1], d) for name in ("sobol", FAST))
        error = a.value / b.value * math.hypot(a.standard_error / a.value, b.standard_error / b.value)
        yield reported(
            f"sobol-{d}", f"variance of Owen-scrambled Sobol over GBN, half space, n = {sizes[-1]}, d = {d}",
            "below 1", a.value / b.value, error, of=draw(sets, FAST, sizes[-1], d),
            holds=holds(a.value < b.value),
        )  # fmt: skip
