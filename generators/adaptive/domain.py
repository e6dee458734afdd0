"""Points within a density's domain: brought back to the torus or inside of the borders, and onto the ink."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density

Mode = Literal["grid-wrap", "nearest"]


def within(density: Density, x: FloatArray) -> FloatArray:
    """Bring points back to the torus, or to the nearest place inside of the borders.

    Parameters
    ----------
    density : Density
        The density.
    x : (n, d) float64
        In pixels.

    Returns
    -------
    (n, d) float64
    """
    shape = np.array(density.shape, np.float64)
    if density.toroidal:
        x = x - shape * np.floor(x / shape)
        return np.where(x >= shape, 0.0, x)
    return np.clip(x, 0, np.nextafter(shape, 0))


def interpolation_mode(*, toroidal: bool) -> Mode:
    """Give the name by which ``scipy.ndimage`` knows what lies beyond the border of a field of pixels.

    Parameters
    ----------
    toroidal : bool
        Whether opposite borders meet.

    Returns
    -------
    str
    """
    return "grid-wrap" if toroidal else "nearest"


def shortest(density: Density, apart: FloatArray) -> FloatArray:
    """Give differences of places their shortest image on the torus; in a box they are as they are.

    Parameters
    ----------
    density : Density
        The density.
    apart : (..., d) float64
        In pixels.

    Returns
    -------
    (..., d) float64
    """
    if not density.toroidal:
        return apart
    shape = np.array(density.shape, np.float64)
    return apart - shape * np.rint(apart / shape)


def pixels_of(density: Density, x: FloatArray) -> tuple[NDArray[np.intp], ...]:
    """Tell in which pixel each point lies, as an index of the density's values.

    Parameters
    ----------
    density : Density
        The density.
    x : (n, d) float64
        Points within it, in pixels.

    Returns
    -------
    tuple of d (n,) intp
    """
    return tuple(np.minimum(x.astype(np.intp), np.array(density.shape) - 1).T)


def to_ink(density: Density, x: FloatArray) -> FloatArray:
    """Move points that lie on pixels without ink into the nearest pixel that has some.

    Parameters
    ----------
    density : Density
        The density.
    x : (n, d) float64
        Points, in pixels.

    Returns
    -------
    (n, d) float64
        Points that were distinct still are: one that came from farther lies nearer to the pixel's border.
    """
    from scipy.spatial import cKDTree

    astray = density.values[pixels_of(density, x)] == 0
    if not astray.any():
        return x
    centres = np.argwhere(density.values > 0) + 0.5
    tree = cKDTree(centres, boxsize=np.array(density.shape, np.float64) if density.toroidal else None)
    nearest = centres[tree.query(x[astray])[1]]
    away = shortest(density, x[astray] - nearest)
    x = x.copy()
    x[astray] = nearest + 0.5 * away / (1 + np.abs(away).max(axis=1, keepdims=True))
    return x
