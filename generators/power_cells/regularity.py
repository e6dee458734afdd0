"""Regular regions of a set with cells of equal area, found and broken up (de Goes et al. 2012)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray, spacing, wrap
from gbnbench.generators.power_cells.diagram import PowerDiagram

RELOCATED = 100  # regular points that are put elsewhere in one round, at most


def irregularity(diagram: PowerDiagram) -> FloatArray:
    """Mean difference of a cell's energy from those of its neighbours, in units of 1/n**2.

    Parameters
    ----------
    diagram : PowerDiagram
        Cells of n points.

    Returns
    -------
    (n,) float64
        0 in a lattice, where all cells are alike; some 0.003 in a good blue-noise set.
    """
    n = len(diagram.mass)
    a, b = diagram.edges.T
    difference = np.bincount(a, np.abs(diagram.energy[a] - diagram.energy[b]), n)
    return np.asarray(n * n * difference / np.maximum(np.bincount(a, minlength=n), 1))


def break_regions(
    x: FloatArray, diagram: PowerDiagram, regular: NDArray[np.bool_], rng: np.random.Generator
) -> FloatArray:
    """Move regular points and their neighbours about, and some regular points to uniform places.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.
    diagram : PowerDiagram
        Their cells.
    regular : (n,) bool
        Points that are too regular.
    rng : numpy.random.Generator
        Stream of the moves.

    Returns
    -------
    (n, 2) float64
        The points: each regular one and its neighbours by Gaussian noise of one spacing, no longer than that;
        of the regular ones at most ``RELOCATED``, chosen at random, anywhere.
    """
    a, b = diagram.edges.T
    stirred = regular.copy()
    stirred[b[regular[a]]] = True
    unit = spacing(len(x), 2)
    noise = rng.normal(size=x.shape)
    noise *= unit / np.maximum(1.0, np.linalg.norm(noise, axis=1, keepdims=True))
    moved = np.where(stirred[:, None], wrap(x + noise), x)
    chosen = rng.permutation(np.flatnonzero(regular))[:RELOCATED]
    moved[chosen] = rng.random((len(chosen), 2))
    return moved
