"""The reference that errors are measured against: exact integer phases, long double cosines, exact sums.

It shares no code with any evaluation. A coordinate is taken as it is, every bit of it, denormals too; f.x mod
1 is formed in integers of 128 bits, what lies below 2^-128 of a turn is added as a phase of its own; whole
quarters of a turn are taken off exactly; cosine and sine are the C library's in long double; they are added
as integers. Where long double has 64 bits of mantissa an amplitude is right to about 3e-19 sqrt(n); where it
is but a double (some systems have no other) to 1e-16 sqrt(n).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

LongArray = NDArray[np.longdouble]
Words = tuple[NDArray[np.uint64], NDArray[np.uint64]]  # high and low 64 bits of a fraction of a turn

TURN = 8 * np.arctan(np.longdouble(1))
LOW = np.uint64(0xFFFFFFFF)
HALF = np.uint64(32)
BLOCK = 1 << 13  # points at a time, whose numbers stay in the cache
ONE, TWO = np.uint64(1), np.uint64(2)


def reference_amplitudes(x: ArrayLike, frequencies: ArrayLike, weights: ArrayLike | None = None) -> LongArray:
    """|sum_k w_k exp(-2 pi i f.x_k)| at integer frequencies.

    Parameters
    ----------
    x : (n, d) array_like
        Coordinates in [0, 1), any double.
    frequencies : (m, d) array_like of int
        Any int64.
    weights : (n,) array_like, optional
        All 1 where not given.

    Returns
    -------
    (m,) long double
        The modulus; power is its square over n.
    """
    points = np.asarray(x, dtype=np.float64)
    n = len(points)
    blocks = [[split(c) for c in points[begin : begin + BLOCK].T] for begin in range(0, n, BLOCK)]
    w = None if weights is None else np.asarray(weights, dtype=np.float64).astype(np.longdouble)
    moduli = []
    for f in np.asarray(frequencies, dtype=np.int64):
        parts = [_terms(columns, [int(a) for a in f]) for columns in blocks]
        cosine, sine = (np.concatenate(part) for part in zip(*parts, strict=True))
        if w is not None:
            cosine, sine = cosine * w, sine * w
        moduli.append(np.hypot(exact_sum(cosine), exact_sum(sine)))
    return np.array(moduli, dtype=np.longdouble)


def reference_roots(x: ArrayLike, frequencies: ArrayLike, weights: ArrayLike | None = None) -> LongArray:
    """Compute the square root of power, |F| / sqrt(n), in which errors are compared.

    Parameters
    ----------
    x : (n, d) array_like
        Points of one set.
    frequencies : (m, d) array_like of int
        Frequencies.
    weights : (n,) array_like, optional
        Weights of the points; all 1 where not given.

    Returns
    -------
    (m,) long double
    """
    roots: LongArray = reference_amplitudes(x, frequencies, weights) / np.sqrt(
        np.longdouble(len(np.asarray(x)))
    )
    return roots


def split(coordinate: NDArray[np.float64]) -> tuple[Words, LongArray]:
    """Write coordinates as 128 bits of a turn and the rest, exactly: no bit of a double is lost."""
    scaled = np.ldexp(coordinate, 64)
    high = np.floor(scaled)
    middle = np.ldexp(scaled - high, 64)
    low = np.floor(middle)
    rest = np.ldexp((middle - low).astype(np.longdouble), -128)
    return (high.astype(np.uint64), low.astype(np.uint64)), rest


def exact_sum(terms: LongArray) -> np.longdouble:
    """Sum as integers: terms are rounded to 2^-62 of the largest's power of two, and nothing after that."""
    exponent = int(np.frexp(np.abs(terms).max())[1])
    whole = np.rint(np.ldexp(terms, 62 - exponent)).astype(np.int64)
    total = (int((whole >> 32).sum()) << 32) + int((whole & 0xFFFFFFFF).sum())  # n < 2^31: neither overflows
    high = np.longdouble(total >> 32)  # a long double holds either half exactly
    return np.longdouble(np.ldexp(np.ldexp(high, 32) + np.longdouble(total & 0xFFFFFFFF), exponent - 62))


def _terms(columns: list[tuple[Words, LongArray]], f: list[int]) -> tuple[LongArray, LongArray]:
    """Cosine and sine of 2 pi f.x for every point."""
    n = len(columns[0][1])
    phase: Words = (np.zeros(n, np.uint64), np.zeros(n, np.uint64))
    tiny = np.zeros(n, np.longdouble)
    for (words, rest), factor in zip(columns, f, strict=True):
        if factor:
            phase = _add(phase, _times(words, factor))
            tiny += rest * factor
    return _circle(phase, tiny)


def _add(a: Words, b: Words) -> Words:
    """Add, mod 1."""
    low = a[1] + b[1]
    return a[0] + b[0] + (low < a[1]).astype(np.uint64), low


def _times(a: Words, factor: int) -> Words:
    """Multiply by an integer of 64 bits, mod 1; products of 64 by 64 bits are made from halves."""
    size = np.uint64(abs(factor))
    a0, a1 = a[1] & LOW, a[1] >> HALF
    b0, b1 = size & LOW, size >> HALF
    middle = a1 * b0 + (a0 * b0 >> HALF)  # each step fits: (2^32 - 1)^2 + 2^32 - 1 < 2^64
    other = a0 * b1 + (middle & LOW)
    high = a1 * b1 + (middle >> HALF) + (other >> HALF) + a[0] * size
    low = a[1] * size
    return (high, low) if factor > 0 else (~high + (low == 0).astype(np.uint64), ~low + ONE)


def _circle(phase: Words, tiny: LongArray) -> tuple[LongArray, LongArray]:
    """Cosine and sine of a phase: the nearest quarter turn comes off in integers, the rest is within 1/8."""
    high, low = phase
    quarter = (high + (ONE << np.uint64(61))) >> np.uint64(62)
    left = (high - (quarter << np.uint64(62))).view(np.int64)
    angle = TURN * (
        np.ldexp(left.astype(np.longdouble), -64) + np.ldexp(low.astype(np.longdouble), -128) + tiny
    )
    cosine, sine = np.cos(angle), np.sin(angle)
    odd = (quarter & ONE).astype(bool)
    cosine, sine = np.where(odd, sine, cosine), np.where(odd, cosine, sine)
    np.negative(cosine, out=cosine, where=((quarter + ONE) & TWO).astype(bool))  # second and third quarter
    np.negative(sine, out=sine, where=(quarter & TWO).astype(bool))  # third and fourth
    return cosine, sine
