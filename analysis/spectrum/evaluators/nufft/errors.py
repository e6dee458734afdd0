"""Errors of non-uniform FFTs, as met in measurements, and the tolerance for a given error."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.spectrum.error_model import UNIT, Errors
from gbnbench.analysis.spectrum.evaluators.nufft.cost import cheapest_layout
from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import DIMENSIONS, LOOSEST, Library
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

LARGEST = 1.25  # largest root mean square error met on scattered points, over the tolerance


def nufft_tolerance(library: Library, rms: float, n: int = 1, d: int = 1, fmax: int = 0) -> float:
    """Find the loosest tolerance that reaches a typical error of sqrt(power).

    Parameters
    ----------
    library : Library
        The library.
    rms : float
        Error allowed, root mean square over frequencies.
    n, d, fmax : int, optional
        Points, dimensions and largest harmonic, with which rounding grows.

    Returns
    -------
    float
        Tolerance of the library.

    Raises
    ------
    InputError
        If the library cannot reach the error; the text gives the error that it reaches.
    """
    floor, tightest = _floor(library, n, d, fmax), library.tightest[min(d, DIMENSIONS) - 1]
    left = math.sqrt(rms**2 - floor**2) / LARGEST if rms > floor else 0.0
    if left < tightest:
        raise InputError(
            f"{library.name} reaches an error of sqrt(power) of {math.hypot(floor, LARGEST * tightest):.1e} "
            f"with n={n}, d={d}, |f| <= {fmax}; got rms={rms:g}. Ask for an exact method"
        )
    return min(left, LOOSEST)


def nufft_errors(
    library: Library, n: int, d: int, fmax: int, tolerance: float, weights: FloatArray | None = None
) -> Errors:
    """Errors of the square root of what ``nufft_power`` returns.

    Parameters
    ----------
    library : Library
        The library.
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    tolerance : float
        Tolerance of the library.
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
        If the library does not do these dimensions or cannot reach the tolerance.
    """
    upsampling = cheapest_layout(library, n, d, fmax, tolerance).upsampling
    worst = math.sqrt(n)
    if weights is not None:
        scaled = np.abs(weights) / np.abs(weights).max()
        worst = float(scaled.sum() / np.linalg.norm(scaled))
    units = library.roundings[d - 1]
    together = math.exp(np.interp(math.log(tolerance), *np.log(upsampling.together or units.together).T))
    rounding = units.worst + units.worst_harmonic * fmax + together * min(n, units.most)
    return Errors(
        rms=math.hypot(library.typical * tolerance, _floor(library, n, d, fmax)),
        bound=worst * min(2.0, library.coherent * tolerance + UNIT["double"] * rounding),
    )


def _floor(library: Library, n: int, d: int, fmax: int) -> float:
    """Give the error of rounding alone, on scattered points."""
    units, modes = library.roundings[min(d, DIMENSIONS) - 1], (2 * fmax + 1) ** d
    return UNIT["double"] * math.hypot(
        units.floor, units.harmonic * fmax, units.crowd * n / float(modes) ** units.power
    )
