"""Target amplitudes: those of the start, scaled ring by ring to a target power; their spread is kept."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.axis_waves import ComplexArray
from gbnbench.generators.gauss_newton.modes import Modes

TargetPower = Callable[[FloatArray], FloatArray]
PASSES = 4  # corrections of the start's profile by its rings' means


def target_power(target: TargetPower | float, modes: Modes) -> FloatArray:
    """Evaluate a target at each mode.

    Parameters
    ----------
    target : callable or float
        Power as a function of nu, or one power for all.
    modes : Modes
        Frequencies below the edge.

    Returns
    -------
    (m,) float64

    Raises
    ------
    InputError
        If it is negative or not finite anywhere.
    """
    return power_at(target if callable(target) else lambda nu: np.full(len(nu), target), modes.nu)


def power_at(target: TargetPower, nu: FloatArray) -> FloatArray:
    """Evaluate a target at some nu, and check that it gives a power for each.

    Parameters
    ----------
    target : callable
        Power as a function of nu.
    nu : (k,) float64
        Where.

    Returns
    -------
    (k,) float64

    Raises
    ------
    InputError
        If it gives anything but one number for all or one for each, or one that is negative or not finite.
    """
    given = target(nu)
    try:
        power = np.broadcast_to(np.asarray(given, dtype=np.float64), nu.shape)
    except (TypeError, ValueError):
        got = f"shape {np.shape(given)} for {len(nu)}" if np.ndim(given) else repr(given)
        raise InputError(f"target must give a power for each nu; got {got}") from None
    wrong = ~(np.isfinite(power) & (power >= 0))
    if wrong.any():
        k = int(np.argmax(wrong))
        raise InputError(f"target must be finite and >= 0 below the edge; got {power[k]} at nu={nu[k]:.4g}")
    return power


def smooth_radial_power(amplitudes: ComplexArray, modes: Modes) -> FloatArray:
    """Smooth the radial power of one set, and give it at each mode.

    Means over rings one unit of |f| wide, joined by straight lines in ln P over nu, and corrected by the
    rings' means of what they leave: the profile is steep within a ring. Exact shells would be too narrow: the
    mean of two or four amplitudes takes away a good part of their spread.

    Parameters
    ----------
    amplitudes : (m,) complex128
        Of the set.
    modes : Modes
        Their frequencies.

    Returns
    -------
    (m,) float64
        All > 0.
    """
    power = np.maximum(np.abs(amplitudes) ** 2 / modes.n, 1e-300)
    ring = np.rint(np.sqrt(modes.square)).astype(np.int64)
    _, ring = np.unique(ring, return_inverse=True)
    count = np.bincount(ring)
    centre = np.bincount(ring, modes.nu) / count
    logarithm = np.log(np.bincount(ring, power) / count)
    for _ in range(PASSES):
        smooth = np.exp(np.interp(modes.nu, centre, logarithm))
        logarithm += np.log(np.bincount(ring, power / smooth) / count)
    smooth_power: FloatArray = np.exp(np.interp(modes.nu, centre, logarithm))
    return smooth_power


def target_amplitudes(amplitudes: ComplexArray, modes: Modes, power: FloatArray) -> ComplexArray:
    """Scale the amplitudes so that their smooth radial power becomes ``power``; phase and spread are kept.

    Parameters
    ----------
    amplitudes : (m,) complex128
        Of the start.
    modes : Modes
        Their frequencies.
    power : (m,) float64
        Target, >= 0.

    Returns
    -------
    (m,) complex128
    """
    scaled: ComplexArray = amplitudes * np.sqrt(power / smooth_radial_power(amplitudes, modes))
    return scaled


def rounding_error(modes: Modes) -> FloatArray:
    """Error of each amplitude over sqrt(n) that rounding the coordinates to double can leave, (m,).

    A coordinate errs by 2**-53 / sqrt(12) of the box, a wave by 2 pi |f| times that, and so does their sum
    over sqrt(n); the sum itself errs by about 5e-16. Eight times that is allowed: the largest of a million
    such errors is five times the typical.
    """
    error: FloatArray = 2 * math.pi * np.sqrt(modes.square) * 2.0**-53 / math.sqrt(12) + 5e-16
    return 8 * error
