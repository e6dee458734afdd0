"""From a density of points to the picture that they draw: how dark the densest is, and tones."""

from __future__ import annotations

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.flags import check_flags
from gbnbench.core.torus import FloatArray

BLACK = 0.99  # of the points lie where it is less dense than what is drawn black, unless coverage is given


def tones(density: FloatArray, *, coverage: float | None = None, invert: bool = False) -> FloatArray:
    """Draw a density: darkness is in proportion to it, up to black.

    Parameters
    ----------
    density : float64 array
        At least 0, and above 0 somewhere; its scale is free.
    coverage : float, optional
        Mean darkness, above 0 and at most 1, before what exceeds black is cut to it. By default as dense as
        one point in a hundred lies, or denser, is black.
    invert : bool
        Dense is light.

    Returns
    -------
    float64 array
        0 black to 1 white.

    Raises
    ------
    InputError
        If coverage is out of range, or invert neither True nor False.
    """
    check_flags(invert=invert)
    if coverage is None:
        levels = np.sort(density, axis=None)
        below = np.cumsum(levels)
        black = float(levels[np.searchsorted(below, BLACK * below[-1])])
    elif 0 < coverage <= 1:
        black = float(density.mean()) / coverage
    else:
        raise InputError(f"coverage must be above 0 and at most 1; got {coverage}")
    dark: FloatArray = np.minimum(density / black, 1)
    return dark if invert else 1 - dark
