"""Bins of the wave number, and the allowed wave vectors in each: all of them, or as many as are affordable.

Allowed wave vectors are k = 2 pi (m_1 / L_1, ..., m_d / L_d) with integer m. Of k and -k one is taken, since
their powers are the same.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gbnbench.analysis.window.tapers import IntArray
from gbnbench.core.torus import FloatArray

LEAST_IN_BIN = {1: 12.0}  # wave vectors expected in a bin, of one half space
LEAST_BEYOND = 6.0  # the same in more dimensions
WIDTH = 0.06  # of a bin, over its wave number
# Edges lie below what they are called by this part: allowed wave vectors that are exactly as long, as in
# windows of sides 2:1, are in the upper bin whatever the unit of length rounds to.
EDGE = 1e-9
LISTED = 1 << 21  # wave vectors of a box that are enumerated to pick a bin's


@dataclass(frozen=True)
class Bin:
    """Wave vectors whose length lies in [low, high).

    Attributes
    ----------
    low, high : float
        Edges, in radians a length.
    multiples : (m, d) int64
        Wave vectors in units of 2 pi / L_a, of one half space: the last coordinate that is not 0 is positive.
    share : float
        Which part of the half space's allowed wave vectors these are.
    """

    low: float
    high: float
    multiples: IntArray
    share: float


def half_count(low: float, high: float, sides: FloatArray) -> float:
    """Expect how many allowed wave vectors of a half space lie between two wave numbers.

    Parameters
    ----------
    low, high : float
        Wave numbers, in radians a length.
    sides : (d,) float64
        Lengths of the window's sides.

    Returns
    -------
    float
        Half the volume of the shell over that of a cell of allowed wave vectors.
    """
    d = len(sides)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)
    cells = float(np.prod(sides / (2 * math.pi)))
    return float(0.5 * ball * (high**d - low**d) * cells)


def bin_edges(kmax: float, sides: FloatArray) -> FloatArray:
    """Choose the edges of bins: each is as wide as a step of the shortest side's wave numbers, or 6% of k.

    Parameters
    ----------
    kmax : float
        Last edge, in radians a length.
    sides : (d,) float64
        Lengths of the window's sides.

    Returns
    -------
    (bins + 1,) float64
        From half a step on, each less by a part of 1e-9; a bin expects at least six wave vectors, 12 in 1D.
    """
    d, step = len(sides), 2 * math.pi / float(sides.min())
    edges = [0.5 * step]
    while edges[-1] < kmax * (1 - EDGE):
        wide = edges[-1] + max(step if d > 1 else 0.0, WIDTH * edges[-1])
        enough = (edges[-1] ** d + LEAST_IN_BIN.get(d, LEAST_BEYOND) / half_count(0.0, 1.0, sides)) ** (1 / d)
        edges.append(max(wide, enough))
    if len(edges) > 2 and edges[-1] > kmax * (1 + WIDTH):
        edges.pop()
    return np.array(edges) * (1 - EDGE)


def every_wave_vector(high: float, sides: FloatArray) -> IntArray:
    """List the allowed wave vectors of a half space that are shorter than ``high``.

    Parameters
    ----------
    high : float
        Wave number, in radians a length.
    sides : (d,) float64
        Lengths of the window's sides.

    Returns
    -------
    (m, d) int64
        In units of 2 pi / L_a.
    """
    reach = np.floor(high * sides / (2 * math.pi)).astype(np.int64)
    axes = [np.arange(-m, m + 1) for m in reach[:-1].tolist()] + [np.arange(reach[-1] + 1)]
    squares = np.zeros((1,) * len(sides))
    for axis, (values, side) in enumerate(zip(axes, sides.tolist(), strict=True)):
        shape = [-1 if a == axis else 1 for a in range(len(sides))]
        squares = squares + ((2 * math.pi / side * values) ** 2).reshape(shape)
    index = np.nonzero(squares < high**2)
    found = np.stack([values[at] for values, at in zip(axes, index, strict=True)], axis=1)
    return found[in_half_space(found)]


def in_half_space(multiples: IntArray) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Tell whether the last coordinate that is not 0 is positive, as of one of k and -k: (m, d) -> (m,)."""
    chosen = np.zeros(len(multiples), bool)
    undecided = np.ones(len(multiples), bool)
    for column in multiples.T[::-1]:
        chosen |= undecided & (column > 0)
        undecided &= column == 0
    return chosen


def enumerable(high: float, sides: FloatArray) -> bool:
    """Tell whether the box around all wave vectors up to ``high`` is small enough to be listed.

    Parameters
    ----------
    high : float
        Wave number, in radians a length.
    sides : (d,) float64
        Lengths of the window's sides.

    Returns
    -------
    bool
    """
    return float(np.prod(2 * np.floor(high * sides / (2 * math.pi)) + 1)) <= 2 * LISTED


def some_wave_vectors(
    low: float, high: float, sides: FloatArray, count: int, rng: np.random.Generator
) -> IntArray:
    """Draw distinct allowed wave vectors of a half space from a shell, evenly.

    Parameters
    ----------
    low, high : float
        The shell, in radians a length.
    sides : (d,) float64
        Lengths of the window's sides.
    count : int
        How many, at most; fewer where the shell holds few.
    rng : numpy.random.Generator
        Source of randomness.

    Returns
    -------
    (m, d) int64
    """
    d = len(sides)
    found = np.empty((0, d), np.int64)
    for _ in range(20):
        direction = rng.normal(size=(4 * count, d))
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        # Uniform in a slightly larger shell, and rounded to allowed ones; those in the shell are kept.
        margin = math.pi * math.sqrt(float((1 / sides**2).sum()))
        radius = rng.uniform(max(low - margin, 0.0) ** d, (high + margin) ** d, 4 * count) ** (1 / d)
        rounded = np.rint(direction * radius[:, None] * sides / (2 * math.pi)).astype(np.int64)
        length = np.linalg.norm(2 * math.pi / sides * rounded, axis=1)
        rounded = rounded[(length >= low) & (length < high)]
        rounded[~in_half_space(rounded)] *= -1
        found = np.unique(np.concatenate([found, rounded]), axis=0)
        if len(found) >= count:
            return found[np.sort(rng.choice(len(found), count, replace=False))]
    return found
