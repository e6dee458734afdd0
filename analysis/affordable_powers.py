"""Choice of the frequencies at which sets are measured: a cube where it is affordable, a ball where not."""

from __future__ import annotations

import math

from gbnbench.analysis.set_powers import SetPowers, ball_powers, box_ball_powers, box_powers, cube_powers
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
from gbnbench.core.torus import FloatArray

SHORTER = 0.9  # factor by which the radius of a ball is lowered until its frequencies are affordable
MOST_CUBE = 1 << 28  # powers of all sets together: 2 GB; beyond it a ball is listed


def set_powers(points: FloatArray, fmax: int | None, sides: Sides | None = None) -> SetPowers:
    """Evaluate the cube of every set where that is affordable, and the shells of a ball where it is not.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    fmax : int or None
        Largest harmonic on each axis, or radius of the ball; None for the default.
    sides : tuple of d floats, optional
        As ``as_sides`` returns them; a cube if not given.

    Returns
    -------
    SetPowers

    Raises
    ------
    InputError
        If fmax is no positive integer, or neither its cube nor its ball can be held.
    """
    realizations, n, d = points.shape
    if sides is not None:
        return _box_or_ball(points, fmax, sides)
    if fmax is None:
        cube = default_fmax(n, d, realizations)
        if realizations * (2 * cube + 1) ** d <= MOST_CUBE and cube_fits(cube, d):
            return cube_powers(points, cube)
        return ball_powers(points, affordable_square(n, d, realizations))
    f = check_positive(fmax)
    if cube_fits(f, d):
        return cube_powers(points, f)
    if largest_square(d, 2 * MOST_COORDINATES // d, f * f) < f * f:
        check_fmax(f, d)  # says what would fit
    return ball_powers(points, f * f)


def _box_or_ball(points: FloatArray, fmax: int | None, sides: Sides) -> SetPowers:
    """Evaluate the box round the ball |k| <= fmax, or the ball alone where that reaches farther."""
    realizations, n, d = points.shape
    if fmax is not None:
        radius = check_positive(fmax)
        if realizations * _box_size(radius, sides) <= MOST_CUBE:
            return box_powers(points, radius, sides)
        return box_ball_powers(points, float(radius), sides)
    radius = default_radius(n, d, realizations, sides)
    boxed = realizations * _box_size(radius, sides) <= MOST_CUBE and radius > math.pow(n, 1 / d)
    if boxed and _box_size(radius, sides) <= MOST_FREQUENCIES:
        return box_powers(points, radius, sides)
    lowest = 1 / max(sides)
    most = min(MOST_COORDINATES / d, MOST_TERMS / (n * d), MOST_KEPT / realizations)
    reach = LARGEST_NU * math.pow(n, 1 / d) + 1
    while reach > lowest and not _affordable(reach, sides, most):
        reach *= SHORTER
    return box_ball_powers(points, max(reach, lowest), sides)


def _box_size(radius: float, sides: Sides) -> int:
    return math.prod(2 * f + 1 for f in harmonics_within(radius, sides))


def _affordable(radius: float, sides: Sides, most: float) -> bool:
    try:
        return len(half_band((0.0, radius), sides, int(most))[1]) <= most
    except InputError:  # more than are listed
        return False


def farther_powers(points: FloatArray, near: SetPowers) -> SetPowers | None:
    """Evaluate the shells of a ball that reaches beyond a default cube.

    Parameters
    ----------
    points : (realizations, n, d) float64
        Checked points.
    near : SetPowers
        Power at the frequencies of the cube.

    Returns
    -------
    SetPowers or None
        None where no such ball is affordable, and for unequal sides.
    """
    if near.spectrum.sides is not None:
        return None
    realizations, n, d = points.shape
    most = affordable_square(n, d, realizations)
    return ball_powers(points, most) if most > max(near.most, near.spectrum.fmax**2) else None
