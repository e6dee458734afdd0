"""The frequencies below an edge and the Jacobian of their amplitudes, written out."""

from __future__ import annotations

import numpy as np

from tests.oracles.power import half_space


def half_space_below(edge, n, d):
    """One of each pair of integer vectors with 0 < |f| n**(-1/d) < edge, from the whole cube."""
    f = half_space(int(edge * n ** (1 / d)) + 1, d)
    return f[np.sum(f**2, axis=1) < (edge * n ** (1 / d)) ** 2]


def scaled_jacobian(x, f):
    """d F_f / d u_ka over sqrt(n) |q|, (m, n d) complex."""
    n, d = x.shape
    direction = f / np.linalg.norm(f, axis=1)[:, None]
    wave = np.exp(-2j * np.pi * x @ f.T)
    return np.einsum("km,ma->mka", -1j * wave, direction).reshape(len(f), n * d) / np.sqrt(n)
