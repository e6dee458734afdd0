"""Sums over points to long double at any double and any frequency, sharing no code with the package.

A coordinate is a whole number of 2^-64 turns, whose multiples wrap exactly in integers, and a rest below
that, which is added as a phase of its own.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

TURN = 8 * np.arctan(np.longdouble(1))
KNOWN = {}


def roots(x, frequencies, weights=None):
    """|sum w exp(-2 pi i f.x)| / sqrt(sum w^2) of one set: (n, d), (m, d), (n,) -> (m,) long double."""
    scaled = np.ldexp(np.asarray(x, dtype=np.float64), 64)
    whole = np.floor(scaled)
    rest = np.ldexp((scaled - whole).astype(np.longdouble), -64)
    whole = whole.astype(np.uint64)
    w = np.ones(len(whole), np.longdouble) if weights is None else np.asarray(weights).astype(np.longdouble)
    found = []
    for f in np.asarray(frequencies, dtype=np.int64):
        phase = (whole * f.astype(np.uint64)).sum(axis=1, dtype=np.uint64).view(np.int64)
        angle = TURN * (np.ldexp(phase.astype(np.longdouble), -64) + rest @ f.astype(np.longdouble))
        found.append(np.hypot((w * np.cos(angle)).sum(), (w * np.sin(angle)).sum()))
    return np.array(found) / np.sqrt((w * w).sum())


def mean_power(x, frequencies, weights=None):
    """Power averaged over (sets, n, d), weights (n,) or (sets, n): (m,) long double; remembered."""
    x, f = np.asarray(x), np.asarray(frequencies, dtype=np.int64)
    w = None if weights is None else np.broadcast_to(weights, x.shape[:2])
    key = (x.shape, x.tobytes(), f.tobytes(), None if w is None else w.tobytes())
    if key not in KNOWN:
        each = [None] * len(x) if w is None else w
        KNOWN[key] = np.mean([roots(one, f, own) ** 2 for one, own in zip(x, each, strict=True)], axis=0)
    return KNOWN[key]


def lattice_of(fmax, d):
    """Every integer vector with |f_a| <= fmax, in the order of a flattened cube: ((2 fmax + 1)**d, d)."""
    return np.indices((2 * fmax + 1,) * d).reshape(d, -1).T - fmax


def distance(power, truth):
    """Distance of the square roots of powers, where errors are stated."""
    return np.abs(np.sqrt(np.asarray(power, dtype=np.longdouble)) - np.sqrt(truth)).astype(float)


def on_grid(shape, seed=0):
    """Draw points on the 2^-53 grid."""
    return np.random.default_rng(seed).integers(0, 2**53, shape) / 2.0**53


@cache
def gpu_form(double=True, has_double=True):
    """Precision as on a GPU, one lane a work-item and work-groups of 64, on the device at hand."""
    from gbnbench.analysis.precision import Precision
    from gbnbench.opencl import Runtime, runtime

    device = replace(runtime().device, is_cpu=False, has_double=has_double)
    return Precision(Runtime(device), double, 1)
