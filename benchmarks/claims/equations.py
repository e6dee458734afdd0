"""The paper's equations of the energy against numbers found another way: Eq. (1), (18), (29) and (47)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.benchmarks.claims.claim import ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import SEED, SetCache
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.kernel_profile import theta

SIDE, N = 8.0, 64  # a torus of unit density
GRID = 96  # samples a side: the squares of Gaussians are exact to rounding
EXACT = 1e-9


def sampled_variance(u: FloatArray, a: FloatArray, sigma: float) -> float:
    """Compute the variance of a sum of Gaussians over the torus by sampling it on a grid.

    Parameters
    ----------
    u : (n, d) float64
        Centres u_k.
    a : (n,) float64
        Amplitudes a_k.
    sigma : float
        Width of a kernel whose amplitude is 1.

    Returns
    -------
    float

    Notes
    -----
    The sum is sum over k of a_k exp(-a_k |x - u_k|^2 / (2 sigma^2)).
    """
    axis = np.arange(GRID) * SIDE / GRID
    total = np.zeros((GRID, GRID))
    for (x, y), weight in zip(u, a, strict=True):
        width = sigma / math.sqrt(weight)
        total += weight * np.outer(theta(axis - x, SIDE, width), theta(axis - y, SIDE, width))
    return float(np.mean((total - total.mean()) ** 2))


def printed_variance(u: FloatArray, a: FloatArray, sigma: float) -> float:
    """Compute the variance as Eq. (47) prints it, its squared distances over all periods.

    Parameters
    ----------
    u : (n, d) float64
        Centres.
    a : (n,) float64
        Amplitudes; Eq. (1) is the case in which every one is 1.
    sigma : float
        Width of a kernel whose amplitude is 1.

    Returns
    -------
    float
    """
    total = 0.0
    for k, point in enumerate(u):
        both = a[k] * a / (a[k] + a)
        step = point - u
        pair = np.array(
            [
                theta(step[j, :1], SIDE, sigma / math.sqrt(b))[0]
                * theta(step[j, 1:], SIDE, sigma / math.sqrt(b))[0]
                for j, b in enumerate(both)
            ]
        )
        total += float(np.sum(2 * math.pi * sigma**2 * both * pair))
    return total / len(u) - (2 * math.pi * sigma**2) ** 2


def variance(_: SetCache) -> Iterator[ClaimRow]:
    """Eq. (1), and its gradient by Eq. (18)."""
    rng = np.random.default_rng(SEED)
    u, ones, sigma = rng.random((N, 2)) * SIDE, np.ones(N), 0.8
    away = abs(printed_variance(u, ones, sigma) / sampled_variance(u, ones, sigma) - 1)
    yield reported(
        "eq-1",
        "relative difference of Eq. 1 from the variance sampled on a grid",
        "0",
        away,
        n=N,
        d=2,
        sets=1,
        holds=holds(away < EXACT),
    )
    # Eq. (18) in the library's terms: its gradient is of the sum over pairs, with sigma^2 of Eq. (14).
    wide = math.sqrt(2) * sigma
    energy = energy_evaluation(N, 2, wide, "double")
    ours = energy(u[None] / SIDE).gradient[0] * math.pi * wide**2 / N
    h = 1e-4
    step = np.zeros_like(u)
    step[0, 0] = h
    slope = (sampled_variance(u + step, ones, sigma) - sampled_variance(u - step, ones, sigma)) / (2 * h)
    ratio = slope / float(ours[0, 0])
    yield reported(
        "eq-18",
        "sampled variance's slope over Eq. 18",
        "1",
        ratio,
        n=N,
        d=2,
        sets=1,
        holds=holds(abs(ratio - 1) < 1e-6),
    )


def adaptive(_: SetCache) -> Iterator[ClaimRow]:
    """Eq. (47) with shaping factors, and its reduction to Eq. (1)."""
    rng = np.random.default_rng(SEED)
    u, a, sigma = rng.random((N, 2)) * SIDE, rng.uniform(0.5, 2.0, N), 0.8
    away = abs(printed_variance(u, a, sigma) / sampled_variance(u, a, sigma) - 1)
    yield reported(
        "eq-47",
        "relative difference of Eq. 29 and 47 from the variance sampled on a grid, a from 0.5 to 2",
        "0",
        away,
        n=N,
        d=2,
        sets=1,
        holds=holds(away < EXACT),
    )
    plain = printed_variance(u, np.ones(N), sigma)
    squares = printed_variance(u, np.full(N, sigma**2), sigma)
    yield reported(
        "reduction",
        "Eq. 47 with every a = sigma^2 over Eq. 1, sigma = 0.8",
        "1",
        squares / plain,
        n=N,
        d=2,
        sets=1,
        holds=holds(abs(squares / plain - 1) < EXACT),
    )
