"""The amplitudes and their Jacobian written out, sharing no code with the package."""

from __future__ import annotations

import numpy as np


def half_space(edge, n, d):
    """One of each pair of integer vectors with 0 < |f| n**(-1/d) < edge, from the whole cube."""
    reach = int(edge * n ** (1 / d)) + 1
    cube = np.indices((2 * reach + 1,) * d).reshape(d, -1).T - reach
    cube = cube[len(cube) // 2 + 1 :]
    return cube[np.sum(cube**2, axis=1) < (edge * n ** (1 / d)) ** 2]


def amplitudes(x, f):
    """sum_k exp(-2 pi i f.x_k) in long double."""
    turns = np.asarray(x, np.longdouble) @ np.asarray(f, np.longdouble).T
    phase = 8 * np.arctan(np.longdouble(1)) * (turns - np.rint(turns))
    return np.cos(phase).sum(axis=0) - 1j * np.sin(phase).sum(axis=0)


def scaled_jacobian(x, f):
    """d F_f / d u_ka over sqrt(n) |q|, (m, n d) complex."""
    n, d = x.shape
    direction = f / np.linalg.norm(f, axis=1)[:, None]
    wave = np.exp(-2j * np.pi * x @ f.T)
    return np.einsum("km,ma->mka", -1j * wave, direction).reshape(len(f), n * d) / np.sqrt(n)
