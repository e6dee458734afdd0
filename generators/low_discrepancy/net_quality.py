"""The quality t of nets in base 2, by counting points in elementary intervals (Niederreiter 1987)."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray, check_points


def net_quality(x: FloatArray) -> int:
    """Least t with which 2**m points are a (t, m, d)-net: 2**t per elementary interval of volume 2**(t - m).

    Parameters
    ----------
    x : (2**m, d) float64
        Points in [0, 1).

    Returns
    -------
    int
        From 0 to m: every elementary interval of volume 2**(t - m) holds 2**t points. 0 is the best.

    Raises
    ------
    InputError
        If x is no set of points of the unit cube.
    RefusalError
        If their number is no power of two.

    Notes
    -----
    Exact: coordinates are cut to m binary digits, which doubles hold, and points are counted. There are
    binom(m - t + d - 1, d - 1) shapes of elementary intervals.

    Examples
    --------
    >>> net_quality(np.array([[0.0, 0.0], [0.5, 0.5]])), net_quality(np.array([[0.0, 0.0], [0.25, 0.5]]))
    (0, 1)
    """
    points = check_points(x)
    n, d = points.shape
    m = int(n).bit_length() - 1
    if n != 2**m:
        raise RefusalError(f"a net in base 2 has 2**m points; got n={n}")
    digits = np.floor(points * n).astype(np.int64)
    for t in range(m):
        shapes = (shape for shape in itertools.product(range(m - t + 1), repeat=d) if sum(shape) == m - t)
        if all(_holds_alike(digits, shape, m) for shape in shapes):
            return t
    return m


def _holds_alike(digits: NDArray[np.int64], shape: tuple[int, ...], m: int) -> bool:
    """Tell whether all elementary intervals of so many digits an axis hold the same number of points."""
    index = np.zeros(len(digits), dtype=np.int64)
    for axis, bits in enumerate(shape):
        index = (index << bits) | (digits[:, axis] >> (m - bits))
    count = np.bincount(index, minlength=2 ** sum(shape))
    return bool(np.all(count == len(digits) >> sum(shape)))
