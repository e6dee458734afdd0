"""Point sets and their exact power at drawn frequencies, for the tests of non-uniform FFTs."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from gbnbench.analysis.spectrum.evaluators.nufft.transform import LIBRARIES
from tests.oracles.power import roots

EDGE = 12  # drawn frequencies that lie on a face of the cube, at most
each_library = pytest.mark.parametrize(
    "library",
    [
        pytest.param(
            one,
            id=one.name,
            marks=pytest.mark.skipif(not one.available, reason=f"{one.name} is not installed"),
        )
        for one in LIBRARIES
    ],
)


def points(n, d, seed=0):
    """Draw points on the 2^-53 grid, whose phases are then exact in 64 bits."""
    return np.floor(np.random.default_rng(seed).random((n, d)) * 2.0**53) / 2.0**53


def drawn(fmax, d, count=40):
    """Draw frequencies: EDGE or fewer in corners, at ends of axes and on faces, then others anywhere."""
    rng = np.random.default_rng(count)
    f = rng.integers(-fmax, fmax + 1, (count, d))
    f[:2] = [[fmax] * d, [-fmax] * d]
    f[2:4] = 0
    f[2, 0], f[3, -1] = fmax, -fmax
    f[np.arange(4, EDGE), rng.integers(0, d, 8)] = rng.choice([-fmax, fmax], 8)
    return f[f.any(axis=1)]


def heavy(n):
    """Draw weights of both signs, whose squares overflow."""
    return np.random.default_rng(1).standard_normal(n) * 1e200


@cache
def truth(n, d, fmax, seed, count, *, weighted=False):
    """Give drawn frequencies and the roots of the power of drawn points there, which several tests share."""
    f = drawn(fmax, d, count)
    return f, roots(points(n, d, seed), f, heavy(n) if weighted else None)


@cache
def hard_sets(n, d, fmax):
    """Give clusters, sets of which half coincide and a lattice, each with its truth at drawn frequencies."""
    f = drawn(fmax, d)
    side = round(n ** (1 / d))
    sets = [np.indices((side,) * d).reshape(d, -1).T / side]
    for seed in range(2):
        sets.append(np.floor((points(1, d, seed) + 2.0**-9 * points(n, d)) % 1 * 2.0**53) / 2.0**53)
        sets.append(np.where(np.arange(n)[:, None] % 2 == 1, 0.0, points(n, d, seed)))
    return f, [(x, roots(x, f)) for x in sets]


def at(cube, f, fmax):
    return np.sqrt(cube[tuple((f + fmax).T)])
