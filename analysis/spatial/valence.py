"""Histogram of Delaunay valences on the torus (the last row of Ahmed, Ren & Wonka 2022, Fig. 8)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.spatial.delaunay import Neighbours, as_neighbours, plane_neighbours
from gbnbench.analysis.spatial.plane_rings import IndexArray
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Valence:
    """Histogram of Delaunay degrees.

    Attributes
    ----------
    degree : (k,) intp
        Every degree from the smallest to the largest that occurs.
    share : (k,) float64
        Share of the points that have it, mean over realizations; sums to 1.
    share_by_set : (realizations, k) float64
        The same for each set.
    """

    degree: IndexArray
    share: FloatArray
    share_by_set: FloatArray

    def of(self, degree: int) -> FloatArray:
        """Share of the points that have this degree in each set: (realizations,), 0 where none has it."""
        return np.asarray(self.share_by_set[:, self.degree == degree].sum(axis=1), dtype=np.float64)

    def to_frame(self) -> pd.DataFrame:
        """Columns degree, share."""
        import pandas as pd

        return pd.DataFrame({"degree": self.degree, "share": self.share})


def valence(x: ArrayLike | Sequence[Neighbours], sides: ArrayLike | None = None) -> Valence:
    """Histogram of the Delaunay degrees on the torus, averaged over realizations.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64, or what ``neighbours`` returned
        Points on the unit torus, d = 2 or 3.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given. Neighbours bring their own.

    Returns
    -------
    Valence
        ``valence(x).of(6)`` is the share v6 of each set.

    Raises
    ------
    InputError, RefusalError
        As ``neighbours``.
    """
    degrees = [each.degree for each in as_neighbours(x, sides)]
    low, high = min(int(k.min()) for k in degrees), max(int(k.max()) for k in degrees)
    by_set = np.array([np.bincount(k - low, minlength=high - low + 1) / len(k) for k in degrees])
    return Valence(np.arange(low, high + 1, dtype=np.intp), by_set.mean(axis=0), by_set)


def valence6(x: ArrayLike | Sequence[Neighbours], sides: ArrayLike | None = None) -> FloatArray:
    """Share of points with exactly six Delaunay neighbours in each set of the plane.

    Parameters
    ----------
    x : (n, 2) or (realizations, n, 2) float64, or what ``neighbours`` returned
        Points on the unit torus.
    sides : (2,) array_like, optional
        Lengths of the torus's sides, whose ratio counts; a square if not given. Neighbours bring their own.

    Returns
    -------
    (realizations,) float64
        Shares.

    Raises
    ------
    InputError
        If sides are not two lengths.
    RefusalError
        If d is not 2 (six is the plane's mean), or two points of a set coincide.
    """
    return valence(plane_neighbours(x, "the share of degree six", sides)).of(6)
