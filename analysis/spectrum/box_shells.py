"""Groups of the frequencies of a torus with unequal sides by |k|, k_a = f_a / s_a, and the pooling of shells.

Exact shells are frequencies whose |k| agree to rounding. In a cube a shell of |f| holds all directions that
its integer allows. Where the squared ratios of the sides are irrational it holds the mirror images (+-f_a)
alone, whose powers are alike whatever the point process, and so tell nothing of direction and average little
noise. ``pooled`` therefore joins neighbours in |k| until a shell has 2^d independent frequencies, two sets of
mirror images; 16 above four dimensions, where spectra end at frequencies of few nonzero components.

In 2D such a shell covers the same area of the plane at any |k|: the power of an exponential profile
exp(c nu^2) changes by a factor of exp(8 c / (pi n)) within it, 1.1 for a Gaussian blue noise of 1024 points,
where a ring of width 1 would have a factor of 3.4 at nu = 0.5.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.shells import EDGE, Shells
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.sides import Sides, squared_lengths
from gbnbench.core.torus import FloatArray, spacing

INDEPENDENT = (
    2,
    4,
    8,
    16,
)  # frequencies of one half space in a pooled shell at least, in d = 1 to 4 and above
TIE = 1e-13  # relative difference of |k|^2 at or below which frequencies belong to one shell


def harmonics_within(radius: float, sides: Sides) -> tuple[int, ...]:
    """Largest harmonic on each axis of the box that holds the ball |k| <= radius: floor(radius s_a).

    Parameters
    ----------
    radius : float
        Largest |k|, cycles per unit length, the torus having volume 1.
    sides : tuple of d floats
        As ``as_sides`` returns them.

    Returns
    -------
    tuple of d ints
        0 on an axis so short that the ball holds no harmonic of it.
    """
    return tuple(math.floor(radius * side * (1 + EDGE)) for side in sides)


def equal_lengths(square: FloatArray) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Give numbers to the groups of equal |k|^2, ascending.

    Parameters
    ----------
    square : (m,) float64
        |k|^2 in any order.

    Returns
    -------
    group : (m,) int64
        Group of each; values that differ by rounding alone have one group.
    count : (groups,) int64
        How many each has.
    """
    order = np.argsort(square, kind="stable")
    ascending = square[order]
    begins = np.ones(len(square), bool)
    begins[1:] = np.diff(ascending) > TIE * ascending[1:]
    group = np.empty(len(square), np.int64)
    group[order] = np.cumsum(begins) - 1
    return group, np.bincount(group)


@lru_cache(maxsize=4)
def box_shells(harmonics: tuple[int, ...], sides: Sides, radius: float) -> Shells:
    """Group the frequencies 0 < |k| <= radius of a box by equal |k|.

    Parameters
    ----------
    harmonics : tuple of d ints
        Largest harmonic on each axis.
    sides : tuple of d floats
        As ``as_sides`` returns them.
    radius : float
        Largest |k|, whose ball the box must hold.

    Returns
    -------
    Shells
    """
    square, inside = _ball(harmonics, sides, radius)
    group, count = equal_lengths(square[inside])
    mean = np.bincount(group, np.sqrt(square[inside])) / count
    label = np.full(len(square), len(count), np.int32)
    label[inside] = group
    return Shells(label, mean, count)


@lru_cache(maxsize=4)
def box_annuli(harmonics: tuple[int, ...], sides: Sides, radius: float, width: float) -> Shells:
    """Group the frequencies 0 < |k| <= radius of a box by floor(|k| / width), as PSA averages.

    Parameters
    ----------
    harmonics, sides, radius
        As for ``box_shells``.
    width : float
        Width of an annulus, cycles per unit length.

    Returns
    -------
    Shells
    """
    square, inside = _ball(harmonics, sides, radius)
    length = np.sqrt(square[inside])
    # An edge that |k| meets but for rounding belongs to the annulus above it.
    _, index, count = np.unique(
        np.floor(length / width * (1 + EDGE)), return_inverse=True, return_counts=True
    )
    label = np.full(len(square), len(count), np.int32)
    label[inside] = index
    return Shells(label, np.bincount(index, length) / count, count.astype(np.int64))


def listed_box_shells(square: FloatArray) -> Shells:
    """Group the listed frequencies of one half space by equal |k|.

    Parameters
    ----------
    square : (m,) float64
        |k|^2 of each, above 0.

    Returns
    -------
    Shells
    """
    group, count = equal_lengths(square)
    radius = np.bincount(group, np.sqrt(square)) / count
    return Shells(group.astype(np.int32), radius, 2 * count, pairs=1)


def _ball(harmonics: tuple[int, ...], sides: Sides, radius: float) -> tuple[FloatArray, NDArray[np.bool_]]:
    square = squared_lengths(harmonics, sides).ravel()
    return square, (square > 0) & (square <= (radius * (1 + EDGE)) ** 2)


def pools(count: NDArray[np.int64], d: int) -> NDArray[np.int64]:
    """Give numbers to the pools of consecutive shells, each with 2^d independent frequencies at least.

    Parameters
    ----------
    count : (s,) int64
        Frequencies of each shell over the whole space, two for each independent one.
    d : int
        Dimension.

    Returns
    -------
    (s,) int64
        Pool of each shell; what is left at the end belongs to the last.
    """
    least, held, pool = 2 * INDEPENDENT[min(d, len(INDEPENDENT)) - 1], 0, 0
    numbers = []
    for size in count.tolist():
        numbers.append(pool)
        held += size
        if held >= least:
            pool, held = pool + 1, 0
    return np.minimum(numbers, max(pool - 1, 0)).astype(np.int64)


def pooled(shells: Shells, d: int) -> Shells:
    """Join neighbouring shells of a cube or box until each has 2^d independent frequencies.

    Parameters
    ----------
    shells : Shells
        Exact shells.
    d : int
        Dimension.

    Returns
    -------
    Shells
        Radii are means over frequencies.
    """
    pool = pools(shells.count, d)
    count = np.bincount(pool, shells.count).astype(np.int64)
    radius = np.bincount(pool, shells.radius * shells.count) / count
    label = np.append(pool, len(count)).astype(np.int32)[shells.label]
    return replace(shells, label=label, radius=radius, count=count)


def pooled_spectrum(shells: ShellSpectrum) -> ShellSpectrum:
    """Join the shells of a spectrum as ``pooled`` does, by their moments (Chan, Golub & LeVeque 1979).

    Parameters
    ----------
    shells : ShellSpectrum
        Exact shells.

    Returns
    -------
    ShellSpectrum
        Radii and powers are means over frequencies.
    """
    pool = pools(shells.count, shells.d)
    count = np.bincount(pool, shells.count).astype(np.int64)

    def mean(values: FloatArray) -> FloatArray:
        return np.asarray(np.bincount(pool, values * shells.count) / count, dtype=np.float64)

    power, radius = mean(shells.power), mean(shells.frequency)
    between = (shells.power - power[pool]) ** 2 * (shells.count / 2)
    deviation = np.bincount(pool, shells.deviation + between).astype(np.float64, copy=False)
    nu = radius * spacing(shells.n, shells.d)
    return replace(shells, frequency=radius, nu=nu, power=power, count=count, deviation=deviation)
