"""Distances to the nearest neighbour in a window, corrected for its border (Hanisch 1984)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from gbnbench.analysis.window.box import Window
from gbnbench.core.torus import FloatArray

TOGETHER = 2.0  # mean spacings within which distances depend on one another


@dataclass(frozen=True)
class NearestDistances:
    """Distances to the nearest neighbour, of the points whose neighbour is nearer than the border.

    Attributes
    ----------
    distance : (m,) float64
        Ascending, in the points' unit.
    weight : (m,) float64
        1 over the volume of the part of the window that is farther than this from the border; they add up
        to 1.
    mean, mean_error : float
        Weighted mean, and its standard error.
    smallest : float
        The smallest distance of any two points in the window.
    hidden : float
        Estimated share of points whose nearest neighbour is farther than half the shortest side, where no
        border is farther and none can be counted: the estimator of Kaplan and Meier (Baddeley & Gill 1997).
    hidden_error : float
        Its standard error by Greenwood's formula.
    """

    distance: FloatArray
    weight: FloatArray
    mean: float
    mean_error: float
    smallest: float
    hidden: float
    hidden_error: float

    def distribution(self, r: FloatArray) -> FloatArray:
        """Give the share of points whose nearest neighbour is no farther than r: (m,) -> (m,)."""
        total = np.concatenate([[0.0], np.cumsum(self.weight)])
        shares: FloatArray = total[np.searchsorted(self.distance, r, side="right")]
        return shares


def nearest_distances(points: FloatArray, window: Window) -> NearestDistances:
    """Estimate the distribution of distances to the nearest neighbour.

    Parameters
    ----------
    points : (n, d) float64
        Checked points of the window.
    window : Window
        The window.

    Returns
    -------
    NearestDistances

    Notes
    -----
    A point counts if its neighbour is nearer than the border, b_i > d_i, so that no neighbour is hidden, with
    the weight 1 / prod_a (L_a - 2 d_i), which makes up for those that do not count: Hanisch (1984). The mean
    is a ratio of two sums over points; its variance is the sum of the products of the points' parts in that
    ratio, over pairs of points nearer than two mean spacings, beyond which distances are taken to be
    independent; it is at least the sum of their squares.
    """
    tree = cKDTree(points)
    distance = np.asarray(tree.query(points, k=2)[0])[:, 1]
    border = np.minimum(points - window.low, window.high - points).min(axis=1)
    counts = distance < border
    farther = window.sides - 2 * np.where(counts, distance, 0.0)[:, None]
    weight = np.where(counts, 1 / np.prod(farther, axis=1), 0.0)
    total = float(weight.sum())
    if total == 0.0:
        return NearestDistances(np.empty(0), np.empty(0), np.nan, np.nan, float(distance.min()), 1.0, 0.0)
    weight /= total
    mean = float(weight @ distance)
    part = weight * (distance - mean)
    spacing = (window.volume / len(points)) ** (1 / window.d)
    reach = TOGETHER * spacing if window.d <= 3 else float(distance.max())
    near = tree.query_pairs(reach, output_type="ndarray")
    alone = float(part @ part)
    variance = max(alone, alone + 2 * float(part[near[:, 0]] @ part[near[:, 1]]))
    order = np.flatnonzero(counts)[np.argsort(distance[counts], kind="stable")]
    return NearestDistances(
        distance[order], weight[order], mean, float(np.sqrt(variance)), float(distance.min()),
        *_never_met(distance, border),
    )  # fmt: skip


def _never_met(distance: FloatArray, border: FloatArray) -> tuple[float, float]:
    """Estimate the share of points whose neighbours lie farther than any border can, and its error."""
    order = np.lexsort((distance >= border, np.minimum(distance, border)))
    left = np.arange(len(order), 0, -1)[(distance < border)[order]].astype(np.float64)  # when one meets one
    share = float(np.prod(1 - 1 / left))
    return share, share * float(np.sqrt((1 / (left * np.maximum(left - 1, 1))).sum()))
