"""KD-trees of points on the unit torus."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    from scipy.spatial import cKDTree


def toroidal_tree(x: FloatArray) -> cKDTree[Any, Any]:
    """Build a tree whose distances are those of the torus.

    Parameters
    ----------
    x : (n, d) float64
        Points in [0, 1).

    Returns
    -------
    scipy.spatial.cKDTree
    """
    from scipy.spatial import cKDTree  # loaded where it is used: the registry imports every generator

    return cKDTree(x, boxsize=np.ones(x.shape[1]))
