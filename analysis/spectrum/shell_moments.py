"""Count, mean and spread of the power on exact shells of |f|, over one half space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.request import SpectrumRequest
from gbnbench.analysis.spectrum.shells import squared_radius
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class ShellMoments:
    """Count, mean and spread of power on shells, over one half space.

    Attributes
    ----------
    square : (s,) int64
        |f|^2 of each shell that is not empty, ascending.
    count : (s,) int64
        Number of frequencies in the half space.
    mean : (s,) float64
        Mean of the power, which was averaged over sets before.
    deviation : (s,) float64
        Sum over the half space of (p - mean)^2.
    """

    square: NDArray[np.int64]
    count: NDArray[np.int64]
    mean: FloatArray
    deviation: FloatArray


def moments_of_cube(power: FloatArray, fmax: int, request: SpectrumRequest) -> ShellMoments:
    """Take the moments of shells from a whole cube.

    Parameters
    ----------
    power : (2*fmax+1,)*d float64
        The cube.
    fmax : int
        Its largest harmonic.
    request : SpectrumRequest
        The shells that are wanted.

    Returns
    -------
    ShellMoments
    """
    square, flat = squared_radius(fmax, request.d), power.ravel()
    wanted = (square >= request.low) & (square <= request.high)
    wanted[: len(wanted) // 2 + 1] = False  # one half space
    return moments_of_list(flat[wanted], square[wanted])


def moments_of_list(power: FloatArray, square: NDArray[np.int64]) -> ShellMoments:
    """Take the moments of shells from the listed frequencies of one half space.

    Parameters
    ----------
    power : (m,) float64
        Power, averaged over sets before.
    square : (m,) int64
        |f|^2 of each frequency.

    Returns
    -------
    ShellMoments
    """
    present, label, count = np.unique(square, return_inverse=True, return_counts=True)
    mean = np.bincount(label, power) / count
    deviation = np.bincount(label, (power - mean[label]) ** 2).astype(np.float64, copy=False)
    return ShellMoments(present, count.astype(np.int64), mean, deviation)
