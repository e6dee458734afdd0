"""The quality t of digital nets in base 2, by counting points in elementary intervals, in whole numbers."""

from __future__ import annotations

import itertools

import numpy as np

from gbnbench.core.torus import FloatArray


def net_quality(x: FloatArray) -> int:
    """Least t such that 2**m points are a (t, m, d)-net in base 2.

    Parameters
    ----------
    x : (2**m, d) float64
        Points in [0, 1).

    Returns
    -------
    int
        From 0 to m: every elementary interval of volume 2**(t - m) holds 2**t points (Niederreiter 1987).
    """
    n, d = x.shape
    m = n.bit_length() - 1
    assert n == 2**m
    digits = np.floor(x * n).astype(np.int64)  # exact: n is a power of two
    for t in range(m + 1):
        shapes = (s for s in itertools.product(range(m - t + 1), repeat=d) if sum(s) == m - t)
        if all(holds_alike(digits, shape, m) for shape in shapes):
            return t
    raise AssertionError("a set of 2**m points is a (m, m, d)-net")


def holds_alike(digits: np.ndarray, shape: tuple[int, ...], m: int) -> bool:
    """Whether all elementary intervals with so many digits an axis hold the same number of points."""
    index = np.zeros(len(digits), dtype=np.int64)
    for axis, bits in enumerate(shape):
        index = (index << bits) | (digits[:, axis] >> (m - bits))
    count = np.bincount(index, minlength=2 ** sum(shape))
    return bool(np.all(count == len(digits) >> sum(shape)))
