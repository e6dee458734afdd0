"""Pair correlation g(r) of points in a window, with translation edge correction (Ohser & Stoyan 1981)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats
from scipy.spatial import cKDTree
from scipy.special import jv

from gbnbench.analysis.window.box import Window
from gbnbench.core.torus import FloatArray

if TYPE_CHECKING:
    import pandas as pd

BIN = 0.1  # width of a bin, in mean spacings
LEAST_PAIRS = 25.0  # that a bin of Poisson points expects: few points get wider bins
REACH = {1: 10.0, 2: 6.0, 3: 4.0}  # largest distance, in mean spacings; 2 in more dimensions
PAIRS = 1 << 21  # at a time
RADII = 13  # distances at which the seen density is found, between which it is interpolated
DIRECTIONS = 64
FINE = 1000  # wave numbers of the integral over S


def pair_correlation(points: FloatArray, window: Window, spectrum: pd.DataFrame) -> pd.DataFrame:
    """Estimate g(r), the density of points at distance r from a point, over the mean density.

    Parameters
    ----------
    points : (n, d) float64
        Checked points of the window.
    window : Window
        The window.
    spectrum : pandas.DataFrame
        As ``radial_structure_factor`` returns it; the errors need ``k``, ``S`` and ``degrees``.

    Returns
    -------
    pandas.DataFrame
        A row a bin: ``r``, its middle, in the points' unit; ``spacings``, r over the mean spacing
        (volume / n)^(1/d); ``g``; ``standard_error``; ``pairs``, how many were counted.

    Notes
    -----
    g = volume^2 / (n (n - 1) v) times the sum over pairs i != j whose distance lies in the bin of
    1 / prod_a (L_a - |x_ia - x_ja|), v being the volume of the bin's shell. For n independent uniform points
    its expectation is 1 exactly. It is divided by the square of ``seen_density``, which takes out what the
    number of points near the border happens to be (Stoyan & Stoyan 2000). Its variance is taken to be

        2 / (n intensity) (g / v + min(g, 1)^2 integral of (S(k)^2 - 1) K(k)^2 dk / (2 pi)^d),

    K being the transform of the shell over v: the first part counts pairs, the second is how pairs that share
    neighbours go together, for Gaussian fluctuations of density. It is at least a quarter of the first. A bin
    without pairs gets the error of one pair.
    """
    import pandas as pd

    n, d = points.shape
    spacing = (window.volume / n) ** (1 / d)
    edges = _edges(n, spacing, window)
    counts, sums, squares = _sums_over_pairs(points, window, edges)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)
    shells = ball * np.diff(edges**d)
    middle, radii = (edges[1:] + edges[:-1]) / 2, np.linspace(0.0, edges[-1], RADII)
    seen = np.interp(middle, radii, [seen_density(points, window, r) for r in radii.tolist()])
    norm = window.volume**2 / (n * (n - 1) * shells * seen**2)
    g = 2 * norm * sums  # of a pair both orders count
    lone = np.where(counts > 0, squares, 1 / window.volume**2)
    counted = 4 * norm**2 * lone
    shared = 2 * window.volume / n**2 * shared_variance(edges, d, spectrum) * np.minimum(g, 1) ** 2
    error = np.sqrt(np.maximum(counted + shared, 0.25 * counted))
    return pd.DataFrame(
        {"r": middle, "spacings": middle / spacing, "g": g, "standard_error": error, "pairs": counts}
    )


def _edges(n: int, spacing: float, window: Window) -> FloatArray:
    """Choose bins of a tenth of a spacing, or wider where pairs are few, up to half the shortest side."""
    d = window.d
    reach = min(REACH.get(d, 2.0) * spacing, float(window.sides.min()) / 2)
    # A bin at one spacing expects n/2 times the volume of its shell in spacings.
    surface = 2 * math.pi ** (d / 2) / math.gamma(d / 2)
    width = max(BIN, min(0.5, LEAST_PAIRS / (0.5 * n * surface))) * spacing
    return np.linspace(0.0, reach, max(2, round(reach / width)) + 1)


def _sums_over_pairs(
    points: FloatArray, window: Window, edges: FloatArray
) -> tuple[np.ndarray[tuple[int], np.dtype[np.int64]], FloatArray, FloatArray]:
    """Count pairs in each bin, and sum their edge corrections and the squares of these."""
    bins = len(edges) - 1
    counts, sums, squares = np.zeros(bins, np.int64), np.zeros(bins), np.zeros(bins)
    order = np.argsort(points[:, 0], kind="stable")
    x = points[order]
    tree = cKDTree(x)
    near = float(tree.count_neighbors(tree, edges[-1])) / len(x)
    step = max(1, int(PAIRS / max(near, 1.0)))
    for begin in range(0, len(x), step):
        block = cKDTree(x[begin : begin + step])
        found = block.sparse_distance_matrix(tree, edges[-1], output_type="ndarray")
        i, j, distance = found["i"] + begin, found["j"], found["v"]
        once = (i < j) & (distance < edges[-1])
        i, j, distance = i[once], j[once], distance[once]
        label = np.minimum((distance / edges[1]).astype(np.intp), bins - 1)
        correction = 1 / np.prod(window.sides - np.abs(x[i] - x[j]), axis=1)
        counts += np.bincount(label, minlength=bins)
        sums += np.bincount(label, correction, bins)
        squares += np.bincount(label, correction**2, bins)
    return counts, sums, squares


def seen_density(points: FloatArray, window: Window, r: float) -> float:
    """Give the density of points as pairs at distance r see it, over n / volume.

    Parameters
    ----------
    points : (n, d) float64
        Points of the window.
    window : Window
        The window.
    r : float
        Distance, less than half the shortest side.

    Returns
    -------
    float
        Mean over points x and directions w of volume / prod_a (L_a - r |w_a|), where x + r w lies in the
        window, and 0 elsewhere; 1 in expectation.
    """
    directions = _directions(window.d)
    share = window.volume / np.prod(window.sides - r * np.abs(directions), axis=1)
    border = np.minimum(points - window.low, window.high - points).min(axis=1)
    near = points[border < r]
    total = (len(points) - len(near)) * float(share.mean())
    for begin in range(0, len(near), 4096):
        inside = np.ones((len(near[begin : begin + 4096]), len(directions)), bool)
        for axis in range(window.d):
            moved = near[begin : begin + 4096, axis, None] + r * directions[:, axis]
            inside &= (moved >= window.low[axis]) & (moved <= window.high[axis])
        total += float(inside.sum(axis=0) @ share) / len(directions)
    return total / len(points)


def _directions(d: int) -> FloatArray:
    """Spread unit vectors evenly: all of 1D, a circle's, and beyond those of a quasi-random set."""
    if d == 1:
        return np.array([[1.0], [-1.0]])
    if d == 2:
        angle = 2 * math.pi * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
        return np.stack([np.cos(angle), np.sin(angle)], axis=1)
    gauss = stats.qmc.MultivariateNormalQMC(np.zeros(d), rng=np.random.default_rng(0)).random(DIRECTIONS)
    both = np.concatenate([gauss, -gauss])
    vectors: FloatArray = both / np.linalg.norm(both, axis=1, keepdims=True)
    return vectors


def shared_variance(edges: FloatArray, d: int, spectrum: pd.DataFrame) -> FloatArray:
    """Integrate (S^2 - 1) K^2 over wave vectors, over (2 pi)^d, for the shell of each bin.

    Parameters
    ----------
    edges : (bins + 1,) float64
        Edges of the bins of distance.
    d : int
        Dimension.
    spectrum : pandas.DataFrame
        Columns k, S and degrees.

    Returns
    -------
    (bins,) float64
        S is 1 beyond the last wave number, and that of the first bin below it. S^2 is freed of what its own
        error adds, a factor 1 + 1/degrees.
    """
    known = spectrum["S"].to_numpy()
    squared = known**2 * (spectrum["degrees"] / (spectrum["degrees"] + 1)).to_numpy()
    k = np.linspace(0.0, float(spectrum["k"].iloc[-1]), FINE + 1)[1:]
    excess = np.interp(k, spectrum["k"], squared) - 1
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)
    density = d * ball * k ** (d - 1) * (k[1] - k[0]) / (2 * math.pi) ** d
    volumes = ball * edges**d
    at = np.outer(np.maximum(edges, 1e-9 * edges[-1]), k)
    balls = volumes[:, None] * math.gamma(d / 2 + 1) * (2 / at) ** (d / 2) * jv(d / 2, at)
    shells = np.diff(balls, axis=0) / np.diff(volumes)[:, None]
    found: FloatArray = shells**2 @ (excess * density)
    return found
