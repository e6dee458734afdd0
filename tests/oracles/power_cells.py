"""Power cells on the torus in 2D by clipping with half-planes, in exact fractions."""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np

Corner = tuple[Fraction, Fraction]


def exact_cell(x: np.ndarray, weight: np.ndarray, k: int) -> list[Corner]:
    """Corners of the power cell of point k, from the point, counterclockwise; empty where it is hidden."""
    places = [(Fraction(a), Fraction(b)) for a, b in x.tolist()]
    weights = [Fraction(w) for w in weight.tolist()]
    half = Fraction(1, 2)
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    for j, turn in itertools.product(range(len(places)), itertools.product((-1, 0, 1), repeat=2)):
        normal = tuple(places[j][a] + turn[a] - places[k][a] for a in range(2))
        if normal != (0, 0):  # kept: 2 y.normal <= |normal|^2 + w_k - w_j
            bound = (normal[0] ** 2 + normal[1] ** 2 + weights[k] - weights[j]) / 2
            corners = _clipped(corners, normal, bound)  # type: ignore[arg-type]
    return corners


def _clipped(corners: list[Corner], normal: Corner, bound: Fraction) -> list[Corner]:
    above = [c[0] * normal[0] + c[1] * normal[1] - bound for c in corners]
    kept: list[Corner] = []
    for i in range(len(corners)):
        j = (i + 1) % len(corners)
        if above[i] <= 0:
            kept.append(corners[i])
        if above[i] * above[j] < 0:
            t = above[i] / (above[i] - above[j])
            (a, b), (c, d) = corners[i], corners[j]
            kept.append((a + t * (c - a), b + t * (d - b)))
    return kept


def exact_moments(corners: list[Corner]) -> tuple[Fraction, Corner, Fraction]:
    """Area, integral of y and integral of |y|**2 of a polygon, by the shoelace formulas."""
    area, first, second, third = Fraction(0), Fraction(0), Fraction(0), Fraction(0)
    for (a, b), (c, d) in zip(corners, corners[1:] + corners[:1], strict=True):
        cross = a * d - c * b
        area += cross / 2
        first += cross * (a + c) / 6
        second += cross * (b + d) / 6
        third += cross * (a * a + a * c + c * c + b * b + b * d + d * d) / 12
    return area, (first, second), third
