"""Power of point sets in the bounded box by cosines, which are the box's own modes.

The waves prod cos(pi f_a x_a) are those of a box through whose faces nothing flows. Their sum over points is
the periodogram of the set and its mirror images on the torus of side 2. That torus shows no step at the
border of the box, while the periodogram on the unit torus does.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.spectrum.shells import squared_radius
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray, as_realizations

MOST_MODES = 10**7  # of the cube held at once


def cosine_power(x: ArrayLike, fmax: int) -> FloatArray:
    """C(f) = 2^z / n (sum over k of prod over a of cos(pi f_a x_ka))^2, z the number of f_a that are not 0.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points of the box [0, 1)^d; power is averaged over realizations.
    fmax : int
        Largest number of half waves on each axis, at least 1.

    Returns
    -------
    (fmax + 1,)*d float64
        1 in expectation for uniform points, but C(0) = n. A mode has |f| / 2 cycles a box side.

    Raises
    ------
    InputError
        If x is not points of the unit box, or fmax is no whole number >= 1 or asks for too many modes.
    """
    points = as_realizations(x)
    sets, n, d = points.shape
    if int(fmax) != fmax or fmax < 1:
        raise InputError(f"fmax must be a whole number >= 1; got {fmax!r}")
    if (fmax + 1) ** d > MOST_MODES:
        most = int(MOST_MODES ** (1 / d)) - 1
        raise InputError(
            f"(fmax + 1)^d must be at most {MOST_MODES} modes; got fmax={fmax}, d={d}, at most {most}"
        )
    waves = np.arange(fmax + 1)
    total = np.zeros((fmax + 1,) * d)
    for each in points:
        amplitude = np.zeros((fmax + 1, (fmax + 1) ** (d - 1)))
        for part in np.array_split(each, -(-n * amplitude.shape[1] // MOST_MODES)):
            tables = [np.cos(np.pi * part[:, a, None] * waves) for a in range(d)]
            rest = np.ones((len(part), 1))
            for table in tables[1:]:
                rest = (rest[:, :, None] * table[:, None, :]).reshape(len(part), -1)
            amplitude += tables[0].T @ rest
        total += amplitude.reshape(total.shape) ** 2
    halves = sum(np.ix_(*[(waves > 0).astype(float)] * d))
    return np.asarray(total * 2.0**halves / (n * sets))


def cosine_radial(power: FloatArray, n: int) -> RadialPower:
    """Average a cube of ``cosine_power`` over modes of equal |f| <= fmax.

    Parameters
    ----------
    power : (fmax + 1,)*d float64
        What ``cosine_power`` returned.
    n : int
        Points of a set.

    Returns
    -------
    RadialPower
        Frequencies are in cycles a box side.
    """
    fmax, d = power.shape[0] - 1, power.ndim
    r2 = squared_radius(fmax, d).reshape((2 * fmax + 1,) * d)[(slice(fmax, None),) * d].ravel()
    inside = (r2 > 0) & (r2 <= fmax * fmax)
    keys, index, count = np.unique(r2[inside], return_inverse=True, return_counts=True)
    mean = np.bincount(index, power.ravel()[inside]) / count
    frequency = np.sqrt(keys.astype(np.float64)) / 2
    return RadialPower(frequency, frequency * n ** (-1 / d), mean, count)
