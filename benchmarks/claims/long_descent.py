"""Claims about sets as deep as a million steps leave, and about second-order methods (Sec. 4.2, 4.3, 4.8)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.benchmarks.claims.claim import BESIDE, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import MILLION, PAPER, SetCache
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.energy import energy_evaluation

ALIKE = (1.5, 1.1)  # factors within which two ways leave the same depth and the same order
ZERO = 1e-9  # of the largest curvature, below which one is 0: finite differences leave 1e-11


def equivalence(sets: SetCache) -> Iterator[ClaimRow]:
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


def million(sets: SetCache) -> Iterator[ClaimRow]:
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


def repeated(_: SetCache) -> Iterator[ClaimRow]:
    """Run one start twice."""
    first, second = (SetCache().draw("gbn[iterations=300]", n=256, sets=2).x for _twice in range(2))
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


def singular(sets: SetCache) -> Iterator[ClaimRow]:
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
