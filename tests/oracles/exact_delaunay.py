"""Delaunay neighbours on the torus by gift wrapping in exact integers."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np


def exact_neighbours(x: np.ndarray, sides: tuple[int, int] = (1, 1)) -> list[list[tuple[float, ...]]]:
    """Vectors, in fractions of the sides and counterclockwise, to the neighbours of each point.

    A neighbour's Voronoi edge has a length: of several points on one empty circle only those beside the point
    count.
    """
    unit = max(Fraction(value).denominator for value in x.ravel().tolist())
    places = [tuple(int(Fraction(value) * unit) for value in row) for row in x.tolist()]
    reach = math.hypot(*sides) * 1.01  # no empty circle is wider than the diagonal
    found = []
    for place in places:
        candidates = []
        for other in places:
            gap = [b - a for a, b in zip(place, other, strict=True)]
            turns = [range(-math.ceil(reach / side) - 1, math.ceil(reach / side) + 2) for side in sides]
            for right in turns[0]:
                for up in turns[1]:
                    vector = (gap[0] + right * unit, gap[1] + up * unit)
                    if 0 < math.hypot(*(v / unit * s for v, s in zip(vector, sides, strict=True))) <= reach:
                        candidates.append(vector)
        found.append([tuple(v / unit for v in each) for each in _wrapped(candidates, sides)])
    return found


def _wrapped(candidates: list[tuple[int, int]], sides: tuple[int, int]) -> list[tuple[int, int]]:
    def square(a: tuple[int, int]) -> int:
        return (sides[0] * a[0]) ** 2 + (sides[1] * a[1]) ** 2

    def cross(a: tuple[int, int], b: tuple[int, int]) -> int:
        return a[0] * b[1] - a[1] * b[0]

    def dot(a: tuple[int, int], b: tuple[int, int]) -> int:
        return sides[0] ** 2 * a[0] * b[0] + sides[1] ** 2 * a[1] * b[1]

    start = min(candidates, key=square)
    ring = [start]
    while True:
        last = ring[-1]
        best = None
        for each in candidates:
            if cross(last, each) <= 0:
                continue
            if best is None:
                best = each
                continue
            # The angle at which a point sees the edge falls as the circle through it grows.
            near, far = _cotangent(last, each, dot, cross), _cotangent(last, best, dot, cross)
            left, right = near[0] * far[1], far[0] * near[1]
            if left < right or (left == right and cross(best, each) > 0):
                best = each
        assert best is not None
        if best == start:
            return ring
        ring.append(best)


def _cotangent(a, b, dot, cross) -> tuple[int, int]:  # type: ignore[no-untyped-def]
    """Cotangent of the angle at b between the origin and a, as a fraction: smallest for the empty circle."""
    to_origin, to_a = (-b[0], -b[1]), (a[0] - b[0], a[1] - b[1])
    return dot(to_origin, to_a), cross(to_origin, to_a)


def exact_degrees_in_space(x: np.ndarray) -> list[int]:
    """Numbers of neighbours of points in general position on the cubic torus, from empty balls.

    For each facet of a point's star that candidate is sought whose ball with it is empty. The first facet has
    the nearest candidate, and that whose circle with both is smallest.
    """
    unit = max(Fraction(value).denominator for value in x.ravel().tolist())
    turns = list(itertools.product(range(-2, 3), repeat=3))
    degrees = []
    for place in x.tolist():
        exact = [int(Fraction(value) * unit) for value in place]
        others = [
            tuple(int(Fraction(v) * unit) + t * unit - e for v, t, e in zip(other, turn, exact, strict=True))
            for other in x.tolist()
            for turn in turns
        ]
        near = [each for each in others if 0 < _dot(each, each) <= 3 * unit**2]
        degrees.append(len(_star_in_space(near)))
    return degrees


def _star_in_space(candidates: list[tuple[int, ...]]) -> set[tuple[int, ...]]:
    first = min(candidates, key=lambda a: _dot(a, a))
    second = None
    for each in candidates:
        if any(_cross(first, each)) and (second is None or _sees_less(first, second, each)):
            second = each
    assert second is not None
    facets, done, found = [(first, second), (second, first)], set(), {first, second}
    while facets:
        a, b = facets.pop()
        if (a, b) in done:
            continue
        normal = _cross(a, b)
        left = [each for each in candidates if _dot(normal, each) > 0]
        best = left[0]
        for each in left[1:]:
            if _in_ball(a, b, best, each):
                best = each
        found.add(best)
        done |= {(a, b), (b, best), (best, a)}
        facets += [(best, b), (a, best)]
    return found


def _in_ball(a: tuple[int, ...], b: tuple[int, ...], c: tuple[int, ...], d: tuple[int, ...]) -> bool:
    """Whether d is in the ball through the origin, a, b and c, whose triple product is positive."""
    terms = zip((a, b, c), (_cross(b, c), _cross(c, a), _cross(a, b)), strict=True)
    slope = [0, 0, 0]
    for corner, normal in terms:
        slope = [s + _dot(corner, corner) * k for s, k in zip(slope, normal, strict=True)]
    return _dot(d, d) * _dot(a, _cross(b, c)) < _dot(d, slope)


def _sees_less(a: tuple[int, ...], b: tuple[int, ...], c: tuple[int, ...]) -> bool:
    """Whether the circle through the origin, a and c is smaller than that through the origin, a and b."""

    def square(p: tuple[int, ...]) -> Fraction:
        gap = [q - r for q, r in zip(p, a, strict=True)]
        return Fraction(_dot(p, p) * _dot(gap, gap), _dot(_cross(a, p), _cross(a, p)))

    return square(c) < square(b)


def _dot(a: Sequence[int], b: Sequence[int]) -> int:
    return sum(p * q for p, q in zip(a, b, strict=True))


def _cross(a: Sequence[int], b: Sequence[int]) -> tuple[int, ...]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
