"""The energy and its gradient at fixed points, to more digits than a double holds; shares no code with ours.

``python -m tests.regression.exact_energy`` prints what gbnbench/regression/cases.json expects of its fields.
"""

from __future__ import annotations

import json
import math

import mpmath
import numpy as np

MASK = 2**64 - 1


def points(n: int, d: int, seed: int) -> list[list[int]]:
    """Coordinates times 2^24: the top bits of splitmix64, whose state starts at seed * 2^32 steps."""
    rows = []
    counter = seed << 32
    for _ in range(n):
        row = []
        for _ in range(d):
            counter += 1
            z = counter * 0x9E3779B97F4A7C15 & MASK
            z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & MASK
            z = (z ^ z >> 27) * 0x94D049BB133111EB & MASK
            row.append((z ^ z >> 31) >> 40)
        rows.append(row)
    return rows


def by_theta(n: int, d: int, sigma: float, seed: int, rows: int | None = None, digits: int = 30):
    """Gradient in spacings at the first rows, and excess energy, by Jacobi's theta function (Eq. 22)."""
    x = points(n, d, seed)
    with mpmath.workdps(digits):
        side = mpmath.mpf(n) ** (mpmath.mpf(1) / d)
        s = mpmath.mpf(sigma) / side
        nome = mpmath.exp(-2 * mpmath.pi**2 * s**2)
        scale = mpmath.sqrt(2 * mpmath.pi) * s
        known: dict[int, tuple] = {}

        def theta(apart: int) -> tuple:
            key = apart % 2**24
            if key not in known:
                z = mpmath.pi * mpmath.mpf(key) / 2**24
                slope = scale * mpmath.pi * mpmath.jtheta(3, z, nome, 1) / side
                known[key] = scale * mpmath.jtheta(3, z, nome), slope
            return known[key]

        energy, gradient = mpmath.mpf(0), []
        for k in range(n if rows is None else rows):
            force = [mpmath.mpf(0)] * d
            for m in range(n):
                pairs = [theta(x[k][a] - x[m][a]) for a in range(d)]
                energy += mpmath.fprod(value for value, _ in pairs) / 2
                for a in range(d):
                    others = mpmath.fprod(value for b, (value, _) in enumerate(pairs) if b != a)
                    force[a] += pairs[a][1] * others
            gradient.append(force)
        uniform = n * (2 * mpmath.pi) ** (mpmath.mpf(d) / 2) * mpmath.mpf(sigma) ** d / 2
        return gradient, (energy - uniform) / n


def by_images(n: int, d: int, sigma: float, seed: int):
    """The same of all points by adding images, in long double: 64 bits of mantissa on x86."""
    real = np.longdouble
    x = np.array(points(n, d, seed), dtype=real) / real(2**24)
    side = real(n) ** (real(1) / real(d))
    reach = math.ceil(10.5 * sigma / float(side) + 0.5)
    energy, gradient = real(0), np.empty((n, d), real)
    for k in range(n):
        apart = x[k] - x
        apart -= np.rint(apart)
        u = (apart[..., None] + np.arange(-reach, reach + 1).astype(real)) * side / real(sigma)
        gauss = np.exp(-u * u / 2)
        value, slope = gauss.sum(axis=-1), (-u * gauss).sum(axis=-1) / real(sigma)
        energy += value.prod(axis=-1).sum() / 2
        for a in range(d):
            gradient[k, a] = (slope[:, a] * np.delete(value, a, axis=1).prod(axis=1)).sum()
    pi = real("3.14159265358979323846264338327950288")
    uniform = real(n) * np.sqrt(2 * pi) ** d * real(sigma) ** d / 2
    return gradient, (energy - uniform) / n


def values(gradient, excess) -> dict[str, list[float]]:
    """Take what a case expects: the excess, the gradient at four points, and its norm."""
    chosen = sorted({int(k) for k in np.linspace(0, len(gradient) - 1, 4)})
    with mpmath.workdps(30):
        exact = [g if isinstance(g, mpmath.mpf) else mpmath.mpf(str(g)) for row in gradient for g in row]
        norm = mpmath.sqrt(mpmath.fsum(g**2 for g in exact))
    return {
        "excess": [float(excess)],
        "gradient": [float(g) for k in chosen for g in gradient[k]],
        "gradient_norm": [float(norm)],
    }


if __name__ == "__main__":
    for n, d, sigma in ((2, 2, 1.0), (64, 2, 1.0)):
        print(json.dumps([n, d, sigma, values(*by_theta(n, d, sigma, 1))]), flush=True)
    for n, d, sigma in ((64, 1, 1.0), (64, 2, 1.0), (1024, 2, 1.0), (343, 3, 1.0), (64, 8, 1.0)):
        print(json.dumps([n, d, sigma, values(*by_images(n, d, sigma, 1))]), flush=True)
