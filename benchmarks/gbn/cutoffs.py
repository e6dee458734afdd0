"""Time and exactness of the gradient of Gaussian Blue Noise by cut-off, beyond which pairs are left out."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.benchmarks.gbn.floor_cases import CUTOFFS, SIGMA
from gbnbench.benchmarks.timing.interleaved import interleave
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.operation_counts import CUTOFF
from gbnbench.generators.gbn.optimiser import Nesterov
from gbnbench.generators.gbn.step_sizes import gaussian_curvature, step_size
from gbnbench.generators.protocol import realization_rng
from gbnbench.opencl import runtime

FORCES = ("case", "n", "d", "precision", "kernel", "cutoff", "rounds", "cpu_ms", "cpu_ms_median", "error_rms")
SETTLE = 100  # gradients after which forces are checked: noise floor of 1e-8, where far pairs count
FURTHEST = 13.0  # sigmas: exp(-84) is below the last bit of a long double


def exact_forces(x: FloatArray, sigma: float, which: NDArray[np.intp]) -> NDArray[np.longdouble]:
    """Gradient of the energy at chosen points in long double, every pair and every image within 13 sigma.

    Parameters
    ----------
    x : (n, d) float64
        Points, box sides.
    sigma : float
        In spacings.
    which : (m,) intp
        Points whose forces are asked for.

    Returns
    -------
    (m, d) long double
        dE/du, u = x n^(1/d): minus the sum over l of theta'(u_a) times the product over b != a of theta(u_b).
    """
    n, d = x.shape
    side = np.longdouble(n) ** (np.longdouble(1) / d)
    images = np.arange(-(reach := math.ceil(FURTHEST * sigma / float(side) + 0.5)), reach + 1)
    out = np.empty((len(which), d), np.longdouble)
    for row, k in enumerate(which):
        between = x[k].astype(np.longdouble) - x
        u = (between - np.rint(between))[:, :, None] * side + images * side
        bell = np.exp(-(u * u) / (2 * np.longdouble(sigma) ** 2))
        theta, slope = bell.sum(axis=2), -(u * bell).sum(axis=2) / np.longdouble(sigma) ** 2
        for a in range(d):
            out[row, a] = (slope[:, a] * np.delete(theta, a, axis=1).prod(axis=1)).sum()
    return out


def forces(n: int, d: int, seconds: float, probes: int) -> Iterator[dict[str, Any]]:
    """Time and check a gradient at every cut-off that the box is wide enough for.

    Parameters
    ----------
    n, d : int
        Points in a set, and dimension.
    seconds : float
        Time given to all cut-offs together; at least three rounds are timed.
    probes : int
        Number of points whose forces are checked.

    Returns
    -------
    iterator of dict
        One row for each cut-off.

    Notes
    -----
    ``error_rms`` is over components of the forces at ``probes`` points, in units of the largest force of one
    pair, exp(-1/2) / sigma; the set has had 100 gradients. The kernel that is called whole leaves out pairs
    beyond 9 sigma in double and 6 in float.
    """
    precisions = ("double", "float") if runtime().device.has_double else ("float",)
    start = realization_rng(0, 0).random((1, n, d))
    settled = Nesterov(
        energy_evaluation(n, d, SIGMA, precisions[0]),
        start,
        step_size(n, d, SIGMA),
        curvature=gaussian_curvature(d, SIGMA),
    )
    while settled.gradients < SETTLE:
        settled.advance()
    x = settled.x
    which = np.random.default_rng(n).choice(n, min(n, probes), replace=False)
    truth = exact_forces(x[0], SIGMA, which)
    wide = [cutoff for cutoff in CUTOFFS if 2 * cutoff * SIGMA <= n ** (1 / d)]
    fields = {
        (precision, cutoff): energy_evaluation(n, d, SIGMA, precision, cutoff=cutoff)
        for precision in precisions
        for cutoff in (None, *wide)
    }
    timings = interleave({f"{p} {c}": partial(at, x) for (p, c), at in fields.items()}, seconds)
    for (precision, cutoff), at in fields.items():
        away = at(x).gradient[0, which] - truth
        timing = timings[f"{precision} {cutoff}"]
        cut = CUTOFF[precision] if at.method == "strips" else math.nan
        yield {
            "case": f"n={n} {d}D",
            "n": n,
            "d": d,
            "precision": precision,
            "kernel": "whole" if cutoff is None else "cut off",
            "cutoff": cut if cutoff is None else cutoff,
            "rounds": len(timing.cpu),
            "cpu_ms": 1e3 * float(timing.cpu.min()),
            "cpu_ms_median": 1e3 * float(np.median(timing.cpu)),
            "error_rms": float(np.sqrt(np.mean(away**2))) * SIGMA * math.exp(0.5),
        }
