"""Density of points of the bounded box against their depth, the distance to the nearest face."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.standard_errors import sample_variance
from gbnbench.core.errors import InputError
from gbnbench.core.sides import as_sides
from gbnbench.core.torus import FloatArray, as_realizations

if TYPE_CHECKING:
    import pandas as pd

ROUNDED = 2.0**-52  # box sides; what a coordinate near 1, and its distance from there, may be off by
EDGE = 1e-12  # relative rounding of a distance in spacings


@dataclass(frozen=True)
class EdgeDensity:
    """Density of the points of one source against their depth in the box.

    Attributes
    ----------
    edges : (bins + 1,) float64
        Depths between which a bin counts, spacings n**(-1/d).
    density : (bins,) float64
        Mean over sets of the share of points in the bin over the bin's volume: 1 for uniform points.
    standard_error : (bins,) float64
        Standard error of that mean over sets; nan for a single set.
    cumulative : (bins,) float64
        Density within all bins up to this one; the last is 1 where the bins reach the centre.
    extreme : float
        Mean over sets and faces of the depth of the point nearest to a face, spacings.
    extreme_error : float
        Standard error of ``extreme`` over sets; nan for a single set.
    sets : int
        Realizations.
    """

    edges: FloatArray
    density: FloatArray
    standard_error: FloatArray
    cumulative: FloatArray
    extreme: float
    extreme_error: float
    sets: int

    def to_frame(self) -> pd.DataFrame:
        """Columns low, high (depths in spacings), density, standard_error, cumulative: a row a bin."""
        import pandas as pd

        return pd.DataFrame(
            {
                "low": self.edges[:-1],
                "high": self.edges[1:],
                "density": self.density,
                "standard_error": self.standard_error,
                "cumulative": self.cumulative,
            }
        )


def edge_density(
    x: ArrayLike, width: float = 0.25, depth: float = 8.0, sides: ArrayLike | None = None
) -> EdgeDensity:
    """Profile of the density over the distance to the nearest face.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points of the box [0, 1)^d.
    width : float
        Width of a bin, spacings.
    depth : float
        End of the last bin, spacings; the centre of the box where that is nearer.
    sides : (d,) array_like, optional
        Lengths of the box's sides, whose ratios count; a cube if not given.

    Returns
    -------
    EdgeDensity
        Mean over the sets with standard errors.

    Raises
    ------
    InputError
        If x is not points of the unit box, width and depth are not 0 < width <= depth, or sides are not d
        lengths.

    Notes
    -----
    A bin [a, b) is the shell between two boxes, in a cube of volume (1 - 2 a / L)^d - (1 - 2 b / L)^d with
    L = n^(1/d): so corners, which belong to several faces, are counted once and need no correction. A depth
    that is an edge to rounding counts beyond it, so that the rows of a grid at either face stay together.

    Examples
    --------
    >>> profile = edge_density(np.random.default_rng(0).random((50, 400, 2)))
    >>> bool(np.all(abs(profile.density - 1) < 5 * profile.standard_error))
    True
    """
    points = as_realizations(x)
    if not 0 < width <= depth < math.inf:
        raise InputError(f"width and depth must be 0 < width <= depth, spacings; got {width} and {depth}")
    sets, n, d = points.shape
    lengths = as_sides(sides, d)
    side = n ** (1 / d) * (np.ones(d) if lengths is None else np.array(lengths))
    last = min(depth, float(np.min(side)) / 2)
    edges = np.append(np.arange(0, last - width / 1e6, width), last)
    distance = _distances(points, side)
    # The last bin of a histogram holds its upper edge, as it should at the centre alone.
    distance = np.where(distance < last, distance, last if last == side.min() / 2 else np.inf)
    volume = _shell_volumes(np.minimum(2 * edges[:, None] / side, 1))
    gaps = [points.min(axis=1) * side, (1 - points.max(axis=1)) * side]
    extremes = np.concatenate(gaps, axis=1).mean(axis=1)
    counts = np.stack([np.histogram(each, edges)[0] for each in distance])
    share = counts / n
    density = share / volume
    return EdgeDensity(
        edges,
        density.mean(axis=0),
        _error(density),
        np.cumsum(share.mean(axis=0)) / np.cumsum(volume),
        float(extremes.mean()),
        float(_error(extremes)),
        sets,
    )


def _distances(points: FloatArray, side: FloatArray) -> FloatArray:
    """Distances to the nearest face, (sets, n): where one is an edge but for rounding, not below it."""
    nearest = (np.minimum(points, 1 - points) + ROUNDED) * side
    return np.asarray(nearest.min(axis=2) * (1 + EDGE), dtype=np.float64)


def _error(values: FloatArray) -> FloatArray:
    """Return the standard error of the mean over the first axis; nan for a single value."""
    if len(values) < 2:
        return np.full(values.shape[1:], np.nan)
    return np.sqrt(sample_variance(values) / len(values))


def _shell_volumes(cut: FloatArray) -> FloatArray:
    """Volumes between the boxes of sides 1 - a and 1 - b, for cuts a < b: (bins + 1, d) -> (bins,).

    They are summed axis by axis, since a difference of two products near 1 would cancel.
    """
    outer, inner = 1 - cut[:-1], 1 - cut[1:]
    parts = [
        outer[:, :a].prod(axis=1) * np.diff(cut[:, a]) * inner[:, a + 1 :].prod(axis=1)
        for a in range(cut.shape[1])
    ]
    return np.asarray(np.sum(parts, axis=0))
