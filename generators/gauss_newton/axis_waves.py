"""The waves exp(2 pi i f x) of all frequencies on one axis, from a few sines and cosines a point."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.integer_frequencies import IntArray
from gbnbench.core.torus import FloatArray

ComplexArray = NDArray[np.complex128]
SPLIT = 2.0**26  # a coordinate's leading bits, whose product with a frequency below 2**27 is exact


def axis_waves(x: FloatArray, fmax: int) -> ComplexArray:
    """Evaluate exp(2 pi i f x) for f = 0..fmax, then -fmax..-1, to a few roundings.

    Parameters
    ----------
    x : (n,) float64
        Coordinates on one axis, box sides.
    fmax : int
        Highest frequency.

    Returns
    -------
    (n, 2 fmax + 1) complex128
    """
    up = rising_waves(x, fmax)
    return np.concatenate([up, np.conj(up[:, :0:-1])], axis=1)


def rising_waves(x: FloatArray, fmax: int) -> ComplexArray:
    """Evaluate exp(2 pi i f x) for f = 0..fmax, to a few roundings.

    Two levels, f = coarse j + i, take a sine and a cosine for about 2 sqrt(fmax) multiples of x alone.

    Parameters
    ----------
    x : (n,) float64
        Coordinates on one axis, box sides.
    fmax : int
        Highest frequency.

    Returns
    -------
    (n, fmax + 1) complex128
    """
    coarse = math.isqrt(fmax) + 1
    fine = _sines_and_cosines(x, np.arange(coarse))
    steps = _sines_and_cosines(x, np.arange(0, fmax + 1, coarse))
    waves: ComplexArray = (steps[:, :, None] * fine[:, None, :]).reshape(len(x), -1)[:, : fmax + 1]
    return waves


def _sines_and_cosines(x: FloatArray, f: IntArray) -> ComplexArray:
    head = np.rint(x * SPLIT) / SPLIT
    turns = head[:, None] * f
    turns = turns - np.rint(turns) + (x - head)[:, None] * f
    out = np.empty(turns.shape, np.complex128)
    turns *= 2 * math.pi
    np.cos(turns, out=out.real)
    np.sin(turns, out=out.imag)
    return out
