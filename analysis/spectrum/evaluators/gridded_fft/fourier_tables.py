"""Radices and twiddles of the transforms in fourier_passes.cl."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

PRIMES = (5, 3)  # besides 2, whose powers are taken as radices 8, 4 and 2


def radices(length: int) -> list[int]:
    """Part a length into radices.

    Parameters
    ----------
    length : int
        2^a 3^b 5^c.

    Returns
    -------
    list of int
        Among 2, 3, 4, 5 and 8, with as few 2s as can be; their product is the length.
    """
    found: list[int] = []
    for prime in PRIMES:
        while length % prime == 0:
            found.append(prime)
            length //= prime
    twos = length.bit_length() - 1
    fours = {0: 0, 1: 2, 2: 1}[twos % 3] if twos > 1 else 0
    eights, rest = divmod(twos - 2 * fours, 3)
    return [8] * eights + [4] * fours + [2] * rest + found


def twiddles(length: int, order: list[int]) -> FloatArray:
    """Table the twiddles of the passes of a transform.

    Parameters
    ----------
    length : int
        Length of the transform.
    order : list of int
        Radices of its passes.

    Returns
    -------
    (count, 2) float64
        Real and imaginary parts, pass after pass.
    """
    done, powers = 1, [np.empty(0, np.int64)]
    for radix in order:
        step = length // (done * radix)
        powers.append(np.outer(np.arange(step), done * np.arange(1, radix)).ravel())
        done *= radix
    return turns(np.concatenate(powers), length)


def turns(numerator: NDArray[np.int64], denominator: int) -> FloatArray:
    """Give exp(-2 pi i numerator / denominator), each part within rounding.

    Parameters
    ----------
    numerator : (count,) int64
        Non-negative.
    denominator : int
        At most 2^60.

    Returns
    -------
    (count, 2) float64
        Real and imaginary parts.
    """
    quadrant, rest = np.divmod(4 * (numerator % denominator) + denominator // 2, denominator)
    angle = np.pi / 2 * ((rest - denominator // 2) / denominator)  # at most pi / 4
    cosine, sine = np.cos(angle), -np.sin(angle)
    real = np.choose(quadrant % 4, [cosine, sine, -cosine, -sine])
    imaginary = np.choose(quadrant % 4, [sine, -cosine, -sine, cosine])
    return np.stack([real, imaginary], axis=-1)
