"""Choice of the frequencies at which sets are measured: a cube where it is affordable, a ball where not."""

from __future__ import annotations

import math

from gbnbench.analysis.frequency_region import FrequencyRegion
from gbnbench.analysis.realization_pieces import kept_groups
from gbnbench.analysis.spectrum.ball_power import half_band
from gbnbench.analysis.spectrum.box_shells import harmonics_within
from gbnbench.analysis.spectrum.limits import (
    LARGEST_NU,
    MOST_FREQUENCIES,
    MOST_KEPT,
    check_fmax,
    check_positive,
    cube_fits,
    default_fmax,
    default_radius,
)
from gbnbench.analysis.spectrum.listed_shells import (
    MOST_COORDINATES,
    MOST_TERMS,
    affordable_square,
    largest_square,
)
from gbnbench.core.errors import InputError
from gbnbench.core.sides import Sides

SHORTER = 0.9  # factor by which the radius of a ball is lowered until its frequencies are affordable
MOST_CUBE = 1 << 28  # powers that are kept together: 2 GB; beyond it a ball is listed


def near_region(
    n: int, d: int, realizations: int, fmax: int | None, sides: Sides | None = None
) -> FrequencyRegion:
    """Choose the cube where that is affordable, and a ball where it is not.

    Parameters
    ----------
    n, d, realizations : int
        Points of a set, dimension, and number of sets.
    fmax : int or None
        Largest harmonic on each axis, or radius of the ball; None for the default.
    sides : tuple of d floats, optional
        As ``as_sides`` returns them; a cube if not given.

    Returns
    -------
    FrequencyRegion

    Raises
    ------
    InputError
        If fmax is no positive integer, or neither its cube nor its ball can be held.
    """
    kept = kept_groups(realizations)
    if sides is not None:
        return _box_or_ball(n, d, kept, fmax, sides)
    if fmax is None:
        cube = default_fmax(n, d, kept)
        if kept * (2 * cube + 1) ** d <= MOST_CUBE and cube_fits(cube, d):
            return FrequencyRegion("cube", cube, d)
        return FrequencyRegion("ball", affordable_square(n, d, kept), d)
    f = check_positive(fmax)
    if cube_fits(f, d):
        return FrequencyRegion("cube", check_fmax(f, d), d)
    if largest_square(d, 2 * MOST_COORDINATES // d, f * f) < f * f:
        check_fmax(f, d)  # says what would fit
    return FrequencyRegion("ball", f * f, d)


def _box_or_ball(n: int, d: int, kept: int, fmax: int | None, sides: Sides) -> FrequencyRegion:
    """Choose the box round the ball |k| <= fmax, or the ball alone where that reaches farther."""
    if fmax is not None:
        radius = check_positive(fmax)
        boxed = kept * _box_size(radius, sides) <= MOST_CUBE
        return FrequencyRegion("cube" if boxed else "ball", radius, d, sides)
    radius = default_radius(n, d, kept, sides)
    boxed = kept * _box_size(radius, sides) <= MOST_CUBE and radius > math.pow(n, 1 / d)
    if boxed and _box_size(radius, sides) <= MOST_FREQUENCIES:
        return FrequencyRegion("cube", radius, d, sides)
    lowest = 1 / max(sides)
    most = min(MOST_COORDINATES / d, MOST_TERMS / (n * d), MOST_KEPT / kept)
    reach = LARGEST_NU * math.pow(n, 1 / d) + 1
    while reach > lowest and not _affordable(reach, sides, most):
        reach *= SHORTER
    return FrequencyRegion("ball", max(reach, lowest), d, sides)


def _box_size(radius: float, sides: Sides) -> int:
    return math.prod(2 * f + 1 for f in harmonics_within(radius, sides))


def _affordable(radius: float, sides: Sides, most: float) -> bool:
    try:
        return len(half_band((0.0, radius), sides, int(most))[1]) <= most
    except InputError:  # more than are listed
        return False


def farther_region(n: int, realizations: int, near: FrequencyRegion) -> FrequencyRegion | None:
    """Choose the ball whose shells reach beyond a default cube.

    Parameters
    ----------
    n, realizations : int
        Points of a set, and number of sets.
    near : FrequencyRegion
        The cube.

    Returns
    -------
    FrequencyRegion or None
        None where no such ball is affordable, and for unequal sides.
    """
    if near.sides is not None:
        return None
    most = affordable_square(n, near.d, kept_groups(realizations))
    reached = near.reach if near.listed else near.reach**2
    return FrequencyRegion("ball", most, near.d) if most > max(near.most, reached) else None
