"""Exact squares of L2 discrepancies by their definitions: in fractions, or integers for dyadic points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

import mpmath
import numpy as np

HALF = Fraction(1, 2)


def squares(x: np.ndarray) -> dict[str, Fraction]:
    """Exact square of each discrepancy but the diaphony, of few points of any coordinates."""
    points = [[Fraction(float(v)) for v in p] for p in x]
    n, d = x.shape
    pairs = [[(p, q, abs(p - q)) for p, q in zip(a, b, strict=True)] for a in points for b in points]

    def over_pairs(factor) -> Fraction:
        return sum((math.prod(factor(p, q, t) for p, q, t in pair) for pair in pairs), Fraction(0)) / n**2

    def over_points(factor) -> Fraction:
        return sum((math.prod(factor(p) for p in point) for point in points), Fraction(0)) / n

    def z(v: Fraction) -> Fraction:
        return abs(v - HALF)

    return {
        "CD": Fraction(13, 12) ** d
        - 2 * over_points(lambda p: 1 + z(p) / 2 - z(p) ** 2 / 2)
        + over_pairs(lambda p, q, t: 1 + z(p) / 2 + z(q) / 2 - t / 2),
        "WD": over_pairs(lambda p, q, t: Fraction(3, 2) - t * (1 - t)) - Fraction(4, 3) ** d,
        "MD": Fraction(19, 12) ** d
        - 2 * over_points(lambda p: Fraction(5, 3) - z(p) / 4 - z(p) ** 2 / 4)
        + over_pairs(lambda p, q, t: Fraction(15, 8) - z(p) / 4 - z(q) / 4 - 3 * t / 4 + t * t / 2),
        "L2-star": Fraction(1, 3**d)
        - 2 * over_points(lambda p: (1 - p * p) / 2)
        + over_pairs(lambda p, q, t: 1 - max(p, q)),
        "L2-periodic": over_pairs(lambda p, q, t: HALF - t * (1 - t)) - Fraction(1, 3**d),
    }


def diaphony_square(x: np.ndarray) -> mpmath.mpf:
    """Square of the diaphony in 40 digits, of few points."""
    with mpmath.workdps(40):
        total, n = mpmath.mpf(0), len(x)
        for a in x:
            for b in x:
                t = [abs(mpmath.mpf(float(p)) - float(q)) for p, q in zip(a, b, strict=True)]
                total += mpmath.fprod(1 + 2 * mpmath.pi**2 * (s * s - s + mpmath.mpf(1) / 6) for s in t)
        return total / n**2 - 1


def dyadic_squares(numerators: np.ndarray, bits: int) -> dict[str, Fraction]:
    """Exact squares for many points numerators / 2^bits, by 64-bit integers; bits <= 8, d = 2."""
    n, d = numerators.shape
    m, u = 2**bits, numerators.astype(np.int64)
    z2 = np.abs(2 * u - m)  # 2 m |x - 1/2|

    def over_pairs(factor, scale: int) -> Fraction:
        total = 0
        for k in range(n):
            rows = np.prod([factor(u[k, a], u[:, a], z2[k, a], z2[:, a]) for a in range(d)], axis=0)
            total += int(rows.sum())
        return Fraction(total, scale**d * n**2)

    def over_points(factor, scale: int) -> Fraction:
        return Fraction(int(np.prod(factor(u, z2), axis=1).sum()), scale**d * n)

    return {
        "CD": Fraction(13, 12) ** d
        - 2 * over_points(lambda p, z: 8 * m * m + 2 * m * z - z * z, 8 * m * m)
        + over_pairs(lambda p, q, y, z: 4 * m + y + z - 2 * abs(p - q), 4 * m),
        "WD": over_pairs(lambda p, q, y, z: 3 * m * m - 2 * abs(p - q) * (m - abs(p - q)), 2 * m * m)
        - Fraction(4, 3) ** d,
        "MD": Fraction(19, 12) ** d
        - 2 * over_points(lambda p, z: 80 * m * m - 6 * m * z - 3 * z * z, 48 * m * m)
        + over_pairs(
            lambda p, q, y, z: 15 * m * m - m * (y + z) - 6 * m * abs(p - q) + 4 * (p - q) ** 2, 8 * m * m
        ),
        "L2-star": Fraction(1, 3**d)
        - 2 * over_points(lambda p, z: m * m - p * p, 2 * m * m)
        + over_pairs(lambda p, q, y, z: m - np.maximum(p, q), m),
        "L2-periodic": over_pairs(lambda p, q, y, z: m * m - 2 * abs(p - q) * (m - abs(p - q)), 2 * m * m)
        - Fraction(1, 3**d),
    }


def lattice_square(n: int, generator: Sequence[int], constant: Fraction) -> Fraction:
    """Exact square of WD (constant 3/2) or L2-periodic (1/2) of a rank-1 lattice."""
    i = np.arange(n, dtype=np.int64)
    scale = 2 * constant.denominator
    total, rows = 0, [i * g % n for g in generator]
    for k in range(n):
        steps = [int(row[k]) for row in rows]
        total += math.prod(int(constant * scale) * n * n - scale * t * (n - t) for t in steps)
    d = len(generator)
    return Fraction(total, (scale * n * n) ** d * n) - (constant - Fraction(1, 6)) ** d
