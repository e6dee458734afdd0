"""Effective Nyquist frequency and oscillations of one curve of radial power (Heck, Schlömer & Deussen 2013).

Their definitions stand with ``gbnbench.analysis.radial.psa.spectral_statistics``.
"""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.torus import FloatArray


def effective_nyquist(power: FloatArray, frequency: FloatArray, n: int) -> float:
    """Find the last frequency, over sqrt(n), at which accumulated power is low before it is first high.

    Parameters
    ----------
    power, frequency : (k,) float64
        Power at frequencies that begin at 0 and are evenly spaced.
    n : int
        Points of a set.

    Returns
    -------
    float
        0 where the power never falls low.
    """
    high = _first_high(power, frequency, n)
    if high is None:
        return 0.0
    low = np.flatnonzero(_accumulated(power, frequency)[1:high] < 0.1)
    return float(frequency[1 + low[-1]] / math.sqrt(n)) if len(low) else 0.0


def oscillations(power: FloatArray, frequency: FloatArray, n: int) -> float:
    """Measure how far the power swings about 1 behind its rise.

    Parameters
    ----------
    power, frequency : (k,) float64
        Power at frequencies that begin at 0 and are evenly spaced.
    n : int
        Points of a set.

    Returns
    -------
    float
    """
    rise = _rise(power)
    v0 = frequency[rise]
    v1 = min(v0 + 5 * math.sqrt(n), n / 2)
    end = min(int(v1 / frequency[1]) + 1, len(frequency) - 1)
    samples = ((power - 1) ** 2 * frequency)[rise : end + 1]
    integral = np.trapezoid(samples, dx=float(frequency[1]))
    return 10 * math.sqrt(2 * math.pi * float(integral) / (math.pi * (v1**2 - v0**2)))


def suffices(power: FloatArray, frequency: FloatArray, n: int) -> bool:
    """Tell whether a curve reaches far enough to determine both statistics.

    Parameters
    ----------
    power, frequency : (k,) float64
        The curve as far as it is known.
    n : int
        Points of a set.

    Returns
    -------
    bool
    """
    settled = (power >= 0.98).any() and frequency[_rise(power)] + 5 * math.sqrt(n) < frequency[-2]
    return bool(settled) and _first_high(power, frequency, n) is not None


def _rise(power: FloatArray) -> int:
    """Index where the power first reaches 0.98, or of its maximum where it never does."""
    reached = np.flatnonzero(power >= 0.98)
    return int(reached[0]) if len(reached) else int(np.argmax(power))


def _accumulated(power: FloatArray, frequency: FloatArray) -> FloatArray:
    running = np.cumsum(2 * frequency * power) * frequency[1]
    running[1:] /= frequency[1:] ** 2
    return np.asarray(running)


def _first_high(power: FloatArray, frequency: FloatArray, n: int) -> int | None:
    """Index of the first accumulated power above 0.5 from sqrt(n)/2 on."""
    start = int(math.sqrt(n) / 2 / frequency[1])
    high = np.flatnonzero(_accumulated(power, frequency)[start:] > 0.5)
    return start + int(high[0]) if len(high) else None
