"""Lattices among the hard cases: their power is known in closed form, and tiny or 0 off the harmonics."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.benchmarks.spectra.hard_case import Frequencies, HardCase
from gbnbench.benchmarks.spectra.reference import LongArray, reference_roots
from gbnbench.core.torus import FloatArray

SHALLOW = 1e-25  # a true power near the least that double resolves


def lattice(m: int, d: int) -> FloatArray:
    """Return the regular grid of m**d points k/m, rounded where m is no power of two.

    Parameters
    ----------
    m, d : int
        Points on each axis, and dimension.

    Returns
    -------
    (m**d, d) float64
    """
    axes = np.meshgrid(*[np.arange(m) / m] * d, indexing="ij")
    return np.stack(axes, axis=-1).reshape(-1, d)


def lattices() -> list[HardCase]:
    """List dyadic lattices, lattices whose coordinates are rounded, and one with a point displaced."""
    dyadic = [_dyadic(m, d, reach) for m, d, reach in ((256, 1, 600), (16, 2, 40), (4, 4, 5), (2, 8, 2))]
    return [*dyadic, _uneven(15**2, 1, 600), _uneven(15, 2, 40), _displaced()]


def _dyadic(m: int, d: int, reach: int) -> HardCase:
    """Take a lattice whose coordinates are exact: sqrt(n) on the harmonics, 0 off them."""

    def truth(x: FloatArray, f: Frequencies) -> LongArray:
        return _comb(x, f, m)

    also = ((m,) * d, (m,) + (0,) * (d - 1))
    name = f"dyadic lattice {m}^{d}"
    return HardCase(name, m**d, d, reach, lambda: lattice(m, d), truth, probes=800, also=also)


def _uneven(m: int, d: int, reach: int) -> HardCase:
    """Take a lattice whose coordinates are rounded: its power off the harmonics is small, not 0."""
    n = m**d

    def ceiling(f: Frequencies) -> FloatArray:
        return _rounded(f, m, n)

    name = f"rounded lattice {m}^{d}"
    return HardCase(name, n, d, reach, lambda: lattice(m, d), probes=100, also=((m,) * d,), ceiling=ceiling)


def _comb(x: FloatArray, f: Frequencies, m: int) -> LongArray:
    """sqrt(n) on the harmonics of an exact lattice, 0 off them."""
    return np.where((f % m == 0).all(axis=1), np.sqrt(np.longdouble(len(x))), np.longdouble(0))


def _rounded(f: Frequencies, m: int, n: int) -> FloatArray:
    """Root of n (2 pi |f| 2^-54)^2 off the harmonics: coordinates are within 2^-54 of the lattice's."""
    length = np.sqrt((f.astype(float) ** 2).sum(axis=1))
    return np.where((f % m == 0).all(axis=1), np.inf, math.sqrt(n) * 2 * math.pi * length * 2.0**-54)


def _displaced() -> HardCase:
    """Move a dyadic lattice's first point along axis 0 by so little that P is 1e-25 at f_0 = 1.

    Off the harmonics F = exp(-2 pi i f_0 step) - 1, whence P = 4 sin(pi f_0 step)^2 / n.
    """
    m, d, n = 16, 2, 256
    step = np.ldexp(np.rint(np.ldexp(math.asin(math.sqrt(SHALLOW * n) / 2) / math.pi, 64)), -64)

    def build() -> FloatArray:
        x = lattice(m, d)
        x[0, 0] = step
        return x

    def truth(x: FloatArray, f: Frequencies) -> LongArray:
        moved = 2 * np.abs(np.sin(np.pi * f[:, 0] * np.longdouble(step))) / np.sqrt(np.longdouble(len(x)))
        return np.where((f % m == 0).all(axis=1), reference_roots(x, f), moved)

    return HardCase(
        f"true power {SHALLOW:g}", n, d, 5, build, truth, probes=100, also=((1, 0), (-1, 0), (1, 3), (1, -5))
    )
