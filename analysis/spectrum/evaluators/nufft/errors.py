"""Errors of FINUFFT's transforms, as met in measurements, and the tolerance for a given error."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.nufft.cost import WIDE, upsampling_factor
from gbnbench.analysis.spectrum.evaluators.nufft.limits import LOOSEST, TIGHTEST, check_tolerance
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

UNIT = 2.0**-53
# Errors of sqrt(power) on scattered points, over the tolerance: typical and largest. All numbers here were
# measured with n = 16 to 3e5 and F = 4 to 20,000.
TYPICAL, LARGEST = 0.35, 1.0
# Rounding on scattered points in units of 2^-53: a constant, a factor of F, and one of n over the root of the
# number of modes.
FLOOR, FLOOR_HARMONIC, FLOOR_POINT = 15.0, 1.0, 0.1
# Bounds on coincident points, where errors are coherent, over sqrt(n): a factor of the tolerance, and in
# units of 2^-53 a constant, a factor of F and one of the points. At least three times what was measured.
COHERENT, COHERENT_FLOOR, COHERENT_HARMONIC = 30.0, 100.0, 3.0
COHERENT_POINT = (5.0, 8.0, 20.0)  # in 1, 2 and 3 dimensions, at the wide upsampling factor
COHERENT_POINT_NARROW = 1e5  # in any dimension, at the narrow one
# Points that FINUFFT sums one after another, in 1, 2 and 3 dimensions.
SUBPROBLEM = (10_000, 100_000, 100_000)


def nufft_tolerance(rms: float, n: int = 1, d: int = 1, fmax: int = 0) -> float:
    """Find the loosest tolerance that reaches a typical error of sqrt(power).

    Parameters
    ----------
    rms : float
        Error allowed, root mean square over frequencies.
    n, d, fmax : int, optional
        Points, dimensions and largest harmonic, with which FINUFFT's rounding grows.

    Returns
    -------
    float
        Tolerance of FINUFFT.

    Raises
    ------
    InputError
        If FINUFFT cannot reach the error; the text gives the error that it reaches.
    """
    floor = _floor(n, d, fmax)
    left = math.sqrt(rms**2 - floor**2) / LARGEST if rms > floor else 0.0
    if left < TIGHTEST:
        raise InputError(
            f"FINUFFT reaches an error of sqrt(power) of {math.hypot(floor, LARGEST * TIGHTEST):.1e} with "
            f"n={n}, d={d}, |f| <= {fmax}; got rms={rms:g}. Ask for an exact method"
        )
    return min(left, LOOSEST)


def nufft_errors(n: int, d: int, fmax: int, tolerance: float, weights: FloatArray | None = None) -> Errors:
    """Errors of the square root of what ``nufft_power`` returns.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    tolerance : float
        Tolerance of FINUFFT.
    weights : (n,) float64, optional
        A weight for each point.

    Returns
    -------
    Errors
        The typical error of scattered points, and a bound. Unlike those of exact methods the bound is not
        proven: it is some three times the largest error met on scattered, clustered and coincident points. On
        coincident points errors add up coherently, to a few times the tolerance times sqrt(n).

    Raises
    ------
    InputError
        If FINUFFT does not do these dimensions or cannot reach the tolerance.
    """
    check_tolerance(d, tolerance)
    worst = math.sqrt(n)
    if weights is not None:
        scaled = np.abs(weights) / np.abs(weights).max()
        worst = float(scaled.sum() / np.linalg.norm(scaled))
    wide = upsampling_factor(n, d, fmax, tolerance) == WIDE
    point = COHERENT_POINT[d - 1] if wide else COHERENT_POINT_NARROW
    together = min(n, SUBPROBLEM[d - 1])
    rounding = UNIT * (COHERENT_FLOOR + COHERENT_HARMONIC * fmax + point * together)
    return Errors(
        rms=math.hypot(TYPICAL * tolerance, _floor(n, d, fmax)),
        bound=worst * min(2.0, COHERENT * tolerance + rounding),
    )


def _floor(n: int, d: int, fmax: int) -> float:
    """Give the error of rounding alone, on scattered points."""
    return UNIT * math.hypot(FLOOR, FLOOR_HARMONIC * fmax, FLOOR_POINT * n / math.sqrt((2 * fmax + 1) ** d))
