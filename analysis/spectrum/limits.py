"""Largest cubes of frequencies that fit in memory and can be counted, and the defaults of fmax."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.spectrum.shells import EDGE
from gbnbench.core.errors import InputError
from gbnbench.core.memory import memory_limit
from gbnbench.core.sides import Sides

MEMORY_SHARE = 0.5  # of the machine's memory that one cube may take
BYTES = 24  # for each frequency: 8 on the device, 8 on the host and 8 to work with it
LARGEST_COUNT = 1 << 63
FLOOR_NU = 0.25  # end of the band whose mean power is the noise floor
LARGEST_NU = 2.0  # as far as the peak and the pictures need
MOST_FREQUENCIES = 6_000_000  # of a default cube: 48 MB, F = 3 in d = 8
MOST_TERMS = 1e11  # frequencies times points of one set: about ten seconds on one core
MOST_KEPT = 1 << 27  # powers of all sets together, 1 GB


def check_fmax(fmax: object, d: int) -> int:
    """Check that fmax is a positive integer whose cube of powers fits in memory.

    Parameters
    ----------
    fmax : object
        What the user gave.
    d : int
        Dimension.

    Returns
    -------
    int
        fmax.

    Raises
    ------
    InputError
        If fmax is not a positive integer or (2*fmax+1)**d powers do not fit. The text names the largest fmax
        that fits.
    """
    f = check_harmonic(fmax, d)
    count = (2 * f + 1) ** d
    room = int(MEMORY_SHARE * memory_limit()) // BYTES
    if count > room:
        fitting = largest_fmax(room, d) if room >= 3**d else 0
        way_out = (
            f"the largest fmax that fits is {fitting}; gbnbench.shells(x, fmax) or --shells needs no cube"
            if fitting >= 1
            else "list the frequencies you need, or take gbnbench.shells(x, fmax): no cube"
        )
        raise InputError(
            f"fmax={f} in d={d} means {float(count):.3g} frequencies, of which {room:.3g} fit in memory; "
            f"{way_out}"
        )
    return f


def cube_fits(fmax: int, d: int) -> bool:
    """Tell whether a whole cube of frequencies fits in memory.

    Parameters
    ----------
    fmax, d : int
        Largest harmonic on each axis, and dimension.

    Returns
    -------
    bool
    """
    try:
        check_fmax(fmax, d)
    except InputError:
        return False
    return True


def check_harmonic(fmax: object, d: int) -> int:
    """Check that fmax is a positive integer whose frequencies can be counted in 64 bits.

    Parameters
    ----------
    fmax : object
        What the user gave.
    d : int
        Dimension.

    Returns
    -------
    int
        fmax.

    Raises
    ------
    InputError
        If fmax is not a positive integer, or (2*fmax+1)**d exceeds 2^63.
    """
    f = check_positive(fmax)
    if (2 * f + 1) ** d > LARGEST_COUNT:
        fitting = largest_fmax(LARGEST_COUNT, d)
        way_out = (
            f"the largest fmax is {fitting}"
            if (2 * fitting + 1) ** d <= LARGEST_COUNT
            else "list the frequencies you need"
        )
        raise InputError(
            f"fmax={f} in d={d} means (2*fmax+1)**d frequencies, more than 2^63, which cannot be counted; "
            f"{way_out}"
        )
    return f


def check_positive(fmax: object) -> int:
    """Return fmax if it is an integer of at least 1; an InputError says that it is not."""
    if isinstance(fmax, bool) or not isinstance(fmax, (int, np.integer)) or fmax < 1:
        raise InputError(f"fmax must be an integer of at least 1; got {fmax!r}")
    return int(fmax)


def largest_fmax(count: int, d: int) -> int:
    """Find the largest F, at least 1, with (2F+1)**d <= count.

    Parameters
    ----------
    count, d : int
        Frequencies allowed, and dimension.

    Returns
    -------
    int
    """
    f = max(1, math.floor((math.pow(count, 1 / d) - 1) / 2))
    while (2 * f + 1) ** d > count and f > 1:  # the root may round up
        f -= 1
    while (2 * f + 3) ** d <= count:  # or down
        f += 1
    return f


def default_fmax(n: int, d: int, realizations: int = 1) -> int:
    """Choose fmax for a cube: just beyond nu = 2, so that the ring there is whole, or less.

    It is less where the cube would be too large, take too long, or not fit in memory for all sets together.
    The band of the noise floor, nu <= 1/4, is always within it.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.
    realizations : int
        Number of sets whose powers are kept.

    Returns
    -------
    int
    """
    edge = math.pow(n, 1 / d)
    wanted = math.floor(LARGEST_NU * edge * (1 + EDGE)) + 1
    most = min(MOST_FREQUENCIES, MOST_TERMS / n, MOST_KEPT / realizations)
    floor = math.ceil(FLOOR_NU * edge)  # the noise floor is always wanted
    return max(1, min(wanted, max(floor, largest_fmax(int(most), d))))


def default_radius(n: int, d: int, realizations: int, sides: Sides) -> int:
    """Choose the largest |k| for a torus with unequal sides, as ``default_fmax`` does for a cube.

    The box |f_a| <= fmax s_a has as many frequencies as a cube may have, and the band of the noise floor is
    within it, with the shell beyond.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.
    realizations : int
        Number of sets whose powers are kept.
    sides : tuple of d floats
        As ``as_sides`` returns them.

    Returns
    -------
    int
        |k| in cycles per unit length, the torus having volume 1.
    """
    edge = math.pow(n, 1 / d)
    wanted = math.floor(LARGEST_NU * edge * (1 + EDGE)) + 1
    most = min(MOST_FREQUENCIES, MOST_TERMS / n, MOST_KEPT / realizations)
    least = math.ceil(FLOOR_NU * edge + 1 / max(sides))
    while wanted > least and math.prod(2 * math.floor(wanted * side) + 1 for side in sides) > most:
        wanted -= 1
    return wanted


def default_shell_fmax(n: int, d: int) -> int:
    """Choose fmax for shells: just beyond nu = 2, or the radius of the largest ball that is affordable.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.

    Returns
    -------
    int
    """
    wanted = math.floor(LARGEST_NU * math.pow(n, 1 / d) * (1 + EDGE)) + 1
    most = min(float(MOST_FREQUENCIES), MOST_TERMS / n)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)  # of radius 1
    return max(1, min(wanted, math.floor(math.pow(most / ball, 1 / d))))
