"""Distances of coordinates from the fixed-point numbers they are rounded to, summed over a set's points."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gbnbench.analysis.spectrum.cached_blocks import block_shape, cached_blocks
from gbnbench.core.torus import FloatArray

BITS = {"double": 64, "float": 32}  # of a fixed-point coordinate
EXACT_FROM = 2.0**-12  # doubles of at least this size are multiples of 2^-64
ROWS = 1 << 20  # points whose rounding is looked at together


@dataclass(frozen=True)
class Coordinates:
    """Distance of fixed-point coordinates from the true ones, for the worst of several sets.

    Attributes
    ----------
    coherent : float
        sum_k |w_k| sum_a |delta_ka| / sqrt(sum_k w_k^2), delta being the rounding of a coordinate; in turns.
    scattered : float
        sqrt(sum_k w_k^2 sum_a delta_ka^2 / sum_k w_k^2); in turns.
    share : float
        sum_k |w_k| / sqrt(sum_k w_k^2), which is sqrt(n) without weights.
    """

    coherent: float
    scattered: float
    share: float

    def or_larger(self, other: Coordinates) -> Coordinates:
        """Take the worse of each number.

        Parameters
        ----------
        other : Coordinates
            Of other sets.

        Returns
        -------
        Coordinates
        """
        coherent, scattered = max(self.coherent, other.coherent), max(self.scattered, other.scattered)
        return Coordinates(coherent, scattered, max(self.share, other.share))


NOT_ROUNDED = Coordinates(0.0, 0.0, 0.0)


def coordinates(x: FloatArray, precision: str, weights: FloatArray | None = None) -> Coordinates:
    """Measure how far coordinates are rounded: to 64 bits of a turn in double, to 32 in float.

    Parameters
    ----------
    x : (sets, n, d) float64
        Points of the unit torus.
    precision : {"double", "float"}
        Precision of the evaluation.
    weights : (sets or 1, n) float64, optional
        Weights of the points; 1 where not given.

    Returns
    -------
    Coordinates
    """
    n = x.shape[1]
    if n > ROWS:
        return _of_blocks(x, precision, weights)
    if weights is None:
        share = math.sqrt(n)
    else:
        share = float((np.abs(weights).sum(axis=1) / np.sqrt((weights**2).sum(axis=1))).max())
    if precision == "float":
        return _all_rounded(x, weights, share)
    flat = x.reshape(-1)
    inexact = (flat < EXACT_FROM).nonzero()[0]
    if not inexact.size:
        return Coordinates(0.0, 0.0, share)
    scaled = flat[inexact] * 2.0 ** BITS["double"]
    scaled -= np.rint(scaled)
    if not scaled.any():
        return Coordinates(0.0, 0.0, share)
    away = np.abs(scaled) * 2.0 ** -BITS["double"]
    of_set, of_point, _ = np.unravel_index(inexact, x.shape)
    norm: FloatArray | float = float(n)
    if weights is not None:
        dealt = np.broadcast_to(weights, (len(x), n))
        away *= np.abs(dealt[of_set, of_point])
        norm = (dealt**2).sum(axis=1)
    coherent = np.bincount(of_set, away, len(x)) / np.sqrt(norm)
    scattered = np.sqrt(np.bincount(of_set, away**2, len(x)) / norm)
    return Coordinates(float(coherent.max()), float(scattered.max()), share)


def coordinates_of_sums(precision: str, n: int, absolute: float, square: float) -> Coordinates:
    """State how far coordinates are rounded, whose roundings were summed elsewhere.

    Parameters
    ----------
    precision : {"double", "float"}
        Precision of the evaluation.
    n : int
        Points of a set.
    absolute, square : float
        Sums over a set's coordinates of the absolute value and of the square of what each was rounded, in
        units of the last bit of a turn.

    Returns
    -------
    Coordinates
    """
    unit, share = 2.0 ** -BITS[precision], math.sqrt(n)
    return Coordinates(unit * absolute / share, unit * math.sqrt(square) / share, share)


def rounded_at_worst(n: int, d: int, precision: str) -> Coordinates:
    """Assume the rounding of unknown coordinates: none in double, the largest possible in float.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.
    precision : {"double", "float"}
        Precision of the evaluation.

    Returns
    -------
    Coordinates
    """
    half = 0.0 if precision == "double" else 2.0 ** -(BITS[precision] + 1)
    share = math.sqrt(n)
    return Coordinates(share * d * half, math.sqrt(d / 3) * half, share)


def _of_blocks(x: FloatArray, precision: str, weights: FloatArray | None) -> Coordinates:
    """Put together what blocks of points have, so that a large set is never held twice."""
    worst = np.zeros(3)
    for k, points in enumerate(x):
        given = None if weights is None else weights[k if len(weights) > 1 else 0]
        coherent = square = norm = size = 0.0
        for begin in range(0, len(points), ROWS):
            some = slice(begin, begin + ROWS)
            own = np.ones(len(points[some])) if given is None else given[some]
            if (mass := float((own**2).sum())) > 0:
                part = coordinates(points[None, some], precision, None if given is None else own[None])
                coherent += part.coherent * math.sqrt(mass)
                square += part.scattered**2 * mass
                norm, size = norm + mass, size + float(np.abs(own).sum())
        worst = np.maximum(worst, np.array([coherent, math.sqrt(square), size]) / math.sqrt(norm))
    return Coordinates(*worst.tolist())


def _all_rounded(x: FloatArray, weights: FloatArray | None, share: float) -> Coordinates:
    """Measure the rounding of all coordinates in float."""
    sets, n, d = x.shape
    unit = 2.0 ** -BITS["float"]
    coherent, square = np.zeros(sets), np.zeros(sets)
    scaled, nearest = np.empty((2, *block_shape(sets, n, d), d))
    norm: FloatArray | float = float(n)
    dealt = None if weights is None else np.abs(np.broadcast_to(weights, (sets, n)))
    if dealt is not None:
        norm = (dealt**2).sum(axis=1)
    for of_sets, points in cached_blocks(sets, n, d):
        some = x[of_sets, points]
        away, whole = scaled[: some.shape[0], : some.shape[1]], nearest[: some.shape[0], : some.shape[1]]
        np.multiply(some, 1 / unit, out=away)
        np.rint(away, out=whole)
        np.subtract(away, whole, out=away)
        np.abs(away, out=away)
        if dealt is not None:
            away *= dealt[of_sets, points, None]
        each = away.reshape(len(away), -1)
        coherent[of_sets] += each.sum(axis=1)
        square[of_sets] += np.einsum("ij,ij->i", each, each)
    coherent, scattered = coherent / np.sqrt(norm), np.sqrt(square / norm)
    return Coordinates(unit * float(coherent.max()), unit * float(scattered.max()), share)
