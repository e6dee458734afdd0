"""Noise floor and nearest points of a set and of its projections, beside those of random points."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.radial.profile_measures import noise_floor, power_at_1
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spatial.distances import min_distance
from gbnbench.analysis.spectrum.limits import FLOOR_NU
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.sides import as_sides
from gbnbench.core.torus import FloatArray, as_realizations, densest_spacing

ALL_PAIRS = 16  # dimensions up to which every pair of axes is measured
COINCIDENT = 1e-15  # sides: distances below are rounding alone


@dataclass(frozen=True)
class ProjectionQuality:
    """What renderers ask of the dimensions that they take together.

    Attributes
    ----------
    axes : tuple of int
        Coordinates onto which the points are projected.
    noise_floor, power_at_1 : float
        Of the mean spectrum, as ``profile_measures.noise_floor`` and ``power_at_1`` define them; 1 for random
        points.
    min_distance : float
        Smallest toroidal distance of two points, in sides of a torus of volume 1, mean over the sets; nan for
        a single point or beyond 24 dimensions.
    over_random : float
        The same over ``random_min_distance``; above 1 points keep apart, and 0 is where some of every set
        coincide.
    """

    axes: tuple[int, ...]
    noise_floor: float
    power_at_1: float
    min_distance: float
    over_random: float


def projection_quality(
    x: ArrayLike, axes: Sequence[int], sides: ArrayLike | None = None
) -> ProjectionQuality:
    """Measure the projection of sets onto some of their coordinates.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus.
    axes : sequence of int
        Coordinates onto which they are projected; all of them for the sets themselves.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    ProjectionQuality

    Raises
    ------
    InputError
        If x is not points of the unit torus, axes are not some of its coordinates, each once, or sides are
        not d lengths.

    Notes
    -----
    Only shells that the noise floor needs are evaluated, to just beyond nu = 1/4.

    Examples
    --------
    >>> x = np.random.default_rng(0).random((8, 256, 3))
    >>> round(projection_quality(x, (0, 2)).noise_floor)
    1
    """
    points = as_realizations(x)
    d = points.shape[2]
    if not axes or len(set(axes)) < len(axes) or not all(0 <= a < d for a in axes):
        raise InputError(
            f"a projection must name some of the coordinates 0 to {d - 1}, each once; got {tuple(axes)}"
        )
    lengths = as_sides(sides, d)
    projected = np.ascontiguousarray(points[:, :, list(axes)])
    n, m = projected.shape[1:]
    own = None if lengths is None else as_sides([lengths[a] for a in axes], m)
    beyond = math.floor(FLOOR_NU * math.pow(n, 1 / m)) + 1
    if own is not None:
        beyond += math.ceil(1 / max(own))
    spectrum = periodogram(projected, beyond) if m == 1 else shells(projected, beyond, sides=own)
    profile = radial(spectrum)
    nearest = _nearest(projected, own)
    return ProjectionQuality(
        tuple(axes),
        noise_floor(profile),
        power_at_1(profile),
        nearest,
        nearest / random_min_distance(n, m) if n > 1 else math.nan,
    )


def renderers_projections(d: int) -> tuple[tuple[int, ...], ...]:
    """List the projections of which renderers ask: every axis, and every pair of axes.

    Parameters
    ----------
    d : int
        Dimension.

    Returns
    -------
    tuple of tuple of int
        None for d <= 2, where the sets themselves tell; for d > 16 of pairs only neighbours 0+1, 2+3, ...,
        as renderers take them.
    """
    if d <= 2:
        return ()
    pairs = (
        tuple(itertools.combinations(range(d), 2))
        if d <= ALL_PAIRS
        else tuple((a, a + 1) for a in range(0, d - 1, 2))
    )
    return tuple((a,) for a in range(d)) + pairs


def qualities(
    x: ArrayLike,
    chosen: Sequence[Sequence[int]],
    sides: ArrayLike | None = None,
    progress: Callable[[int, int, str], None] | None = None,
) -> tuple[ProjectionQuality, ...]:
    """Measure several projections as ``projection_quality`` does, and tell of each.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus.
    chosen : sequence of sequences of int
        Coordinates of each projection.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.
    progress : callable, optional
        Called with (projections done, projections in all, what is being done).

    Returns
    -------
    tuple of ProjectionQuality
        In the order of ``chosen``.

    Raises
    ------
    InputError
        As ``projection_quality``.
    """
    found = []
    for k, axes in enumerate(chosen):
        found.append(projection_quality(x, axes, sides))
        if progress is not None:
            progress(k + 1, len(chosen), "projections")
    return tuple(found)


def random_min_distance(n: int, m: int) -> float:
    """Return the expected smallest distance of n random points on a torus of volume 1.

    Parameters
    ----------
    n, m : int
        Points, at least 2, and dimension.

    Returns
    -------
    float
        Gamma(1 + 1/m) (N V)^(-1/m), N = n (n - 1) / 2 pairs and V the volume of the unit ball: the numbers of
        pairs within a distance are Poisson's, to a part in n.

    Examples
    --------
    >>> round(random_min_distance(100, 1) * 100**2, 2)  # exactly 1 on a circle
    1.01
    """
    ball = math.pi ** (m / 2) / math.gamma(m / 2 + 1)
    return math.gamma(1 + 1 / m) * math.pow(ball * n * (n - 1) / 2, -1 / m)


def _nearest(x: FloatArray, sides: tuple[float, ...] | None) -> float:
    try:
        distance = float(min_distance(x, sides).mean()) * densest_spacing(*x.shape[1:])
    except RefusalError:
        return math.nan
    return 0.0 if distance < COINCIDENT else distance
