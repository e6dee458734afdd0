"""Comparison of a cube of power with long double sums over exact phases."""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from tests.oracles.power import lattice_of, mean_power, root_distance

UNIT = {"double": 1e-15, "float": 1e-6}  # typical error allowed, the coordinates' rounding apart


def seen(fmax, d, most=240):
    """All frequencies of a small cube, some of a large one: index in the flattened cube, (m, d)."""
    size = (2 * fmax + 1) ** d
    if size <= most:
        return np.arange(size), lattice_of(fmax, d)
    index = np.unique(np.random.default_rng(size).integers(0, size, most // 4))
    index = np.concatenate([index, [0, size // 2, size // 2 + 1, size - 1]])
    return index, np.stack(np.unravel_index(index, (2 * fmax + 1,) * d), axis=1) - fmax


def check(p, x, fmax, weights=None):
    """Compare a cube with the truth; return it."""
    w = None if weights is None else np.atleast_2d(weights)
    power, errors = cube_powers(p, x, fmax, w)
    d = x.shape[2]
    assert power.shape == (2 * fmax + 1,) * d
    assert power.dtype == np.float64
    assert np.array_equal(power, np.flip(power))
    index, f = seen(fmax, d)
    met = root_distance(power.ravel()[index], mean_power(x, f, weights))
    assert met.max() <= errors.bound
    assert np.sqrt(np.mean(met**2)) <= max(UNIT[p.name], 4 * errors.rms)
    return power
