"""The energy and its gradient at fixed points, to more digits than a double holds; shares no code with ours.

``python -m tests.regression.exact_energy`` prints what gbnbench/regression/cases.json expects of its fields.
"""

from __future__ import annotations

import json

import mpmath
import numpy as np

from tests.oracles.energy import image_field, theta_field

MASK = 2**64 - 1


def points(n: int, d: int, seed: int) -> np.ndarray:
    """(n, d) coordinates of 24 bits: the top bits of splitmix64, whose state starts at seed * 2^32 steps."""
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
    return np.array(rows) / 2.0**24


def values(gradient, excess) -> dict[str, list[float]]:
    """Take what a case expects: the excess, the gradient at four points, and its norm."""
    chosen = sorted({int(k) for k in np.linspace(0, len(gradient) - 1, 4)})
    with mpmath.workdps(30):
        norm = mpmath.sqrt(mpmath.fsum(mpmath.mpf(float(g)) ** 2 for row in gradient for g in row))
    return {
        "excess": [float(excess)],
        "gradient": [float(g) for k in chosen for g in gradient[k]],
        "gradient_norm": [float(norm)],
    }


if __name__ == "__main__":
    for n, d, sigma in ((2, 2, 1.0), (64, 2, 1.0), (64, 8, 1.0)):
        print(json.dumps([n, d, sigma, values(*theta_field(points(n, d, 1), sigma, 40))]), flush=True)
    for n, d, sigma in ((64, 1, 1.0), (1024, 2, 1.0), (343, 3, 1.0)):
        print(json.dumps([n, d, sigma, values(*image_field(points(n, d, 1), sigma))]), flush=True)
