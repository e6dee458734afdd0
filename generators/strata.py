"""Points in strata, equal parts of an axis, of which none leaves its own by rounding."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray


def placed_in_strata(stratum: NDArray[Any], place: FloatArray, strata: int) -> FloatArray:
    """Place each coordinate in its stratum.

    Parameters
    ----------
    stratum : (...) array
        Whole numbers from 0 to ``strata`` - 1.
    place : float64
        Where in the stratum, in [0, 1); of the same shape or one that extends to it.
    strata : int
        Equal parts of the axis.

    Returns
    -------
    (...) float64
        (stratum + place) / strata, in [0, 1).

    Notes
    -----
    Near its ends a place may be rounded out of its stratum, at the last one to 1: one coordinate in some 1e11
    of a thousand strata. Such a one is put in the middle of its stratum.

    Examples
    --------
    >>> placed_in_strata(np.array([0, 3]), np.array([0.5, 1 - 2.0**-53]), 4).tolist()
    [0.125, 0.875]
    """
    x: FloatArray = (stratum + place) / strata
    outside = np.floor(x * strata) != stratum
    x[outside] = (stratum[outside] + 0.5) / strata
    return x
