"""Power by direct sums, with integer phases and long double, exact at any double and any integer frequency.

A coordinate is a whole number of 2^-64 turns, whose multiples wrap exactly in integers, and a rest below
that, which is added as a phase of its own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

TURN = 8 * np.arctan(np.longdouble(1))
KNOWN: dict[tuple, NDArray[np.longdouble]] = {}


def amplitudes(x: ArrayLike, frequencies: ArrayLike, weights: ArrayLike | None = None) -> NDArray:
    """sum_k w_k exp(-2 pi i f.x_k) of one set: (n, d), (m, d), (n,) -> (m,) complex long double."""
    scaled = np.ldexp(np.asarray(x, dtype=np.float64), 64)
    whole = np.floor(scaled)
    rest = np.ldexp((scaled - whole).astype(np.longdouble), -64)
    size = np.abs(np.fmod(whole, 2.0**64)).astype(np.uint64)
    turns = np.where(whole < 0, ~size + np.uint64(1), size)
    w = np.ones(len(turns), np.longdouble) if weights is None else np.asarray(weights).astype(np.longdouble)
    found = []
    for f in np.asarray(frequencies, dtype=np.int64):
        phase = (turns * f.astype(np.uint64)).sum(axis=1, dtype=np.uint64).view(np.int64)
        angle = TURN * (np.ldexp(phase.astype(np.longdouble), -64) + rest @ f.astype(np.longdouble))
        found.append((w * np.cos(angle)).sum() - 1j * (w * np.sin(angle)).sum())
    return np.array(found)


def roots(x: ArrayLike, frequencies: ArrayLike, weights: ArrayLike | None = None) -> NDArray[np.longdouble]:
    """Square roots of the power of one set, |sum w exp(-2 pi i f.x)| / sqrt(sum w^2): (m,) long double."""
    square = len(np.asarray(x)) if weights is None else (np.asarray(weights).astype(np.longdouble) ** 2).sum()
    return np.abs(amplitudes(x, frequencies, weights)) / np.sqrt(np.longdouble(square))


def direct_power(
    x: ArrayLike, frequencies: ArrayLike, weights: ArrayLike | None = None
) -> NDArray[np.float64]:
    """|sum w exp(-2 pi i f.x)|**2 / sum w^2 of one set: (n, d), (m, d), (n,) -> (m,) double."""
    return (roots(x, frequencies, weights) ** 2).astype(np.float64)


def mean_power(
    sets: ArrayLike, frequencies: ArrayLike, weights: ArrayLike | None = None
) -> NDArray[np.longdouble]:
    """Power averaged over (sets, n, d), weights (n,) or (sets, n): (m,) long double; remembered."""
    x, f = np.asarray(sets), np.asarray(frequencies, dtype=np.int64)
    w = None if weights is None else np.broadcast_to(weights, x.shape[:2])
    key = (x.shape, x.tobytes(), f.tobytes(), None if w is None else w.tobytes())
    if key not in KNOWN:
        each = [None] * len(x) if w is None else w
        KNOWN[key] = np.mean([roots(one, f, own) ** 2 for one, own in zip(x, each, strict=True)], axis=0)
    return KNOWN[key]


def lattice_of(fmax: int, d: int) -> NDArray[np.int64]:
    """Every integer vector with |f_a| <= fmax, in the order of a flattened cube: ((2 fmax + 1)**d, d)."""
    return np.indices((2 * fmax + 1,) * d).reshape(d, -1).T - fmax


def half_space(fmax: int, d: int) -> NDArray[np.int64]:
    """One of each pair f, -f of nonzero integer vectors with |f_a| <= fmax: (m, d)."""
    cube = lattice_of(fmax, d)
    return cube[len(cube) // 2 + 1 :]


def root_distance(power: ArrayLike, truth: ArrayLike) -> NDArray[np.float64]:
    """Distance of the square roots of powers, where errors are stated."""
    return np.abs(np.sqrt(np.asarray(power, dtype=np.longdouble)) - np.sqrt(truth)).astype(float)


def on_grid(shape: tuple[int, ...], seed: int | np.random.Generator = 0) -> NDArray[np.float64]:
    """Draw points on the 2^-53 grid, from a seed or a generator in use."""
    return np.random.default_rng(seed).integers(0, 2**53, shape) / 2.0**53
