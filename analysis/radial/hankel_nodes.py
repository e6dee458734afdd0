"""Sums of weights times J0(k r) over equally spaced radii, from fewer radii: J0(k r) is band-limited in r."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from gbnbench.core.torus import FloatArray

STEP = math.pi / 2  # largest k times the distance of two nodes; sinc interpolation needs less than pi
HALF = 24  # nodes to either side of a radius
SHARPNESS = 0.98 * HALF * (math.pi - STEP)  # of the Kaiser-Bessel window: its main lobe ends at pi - STEP


def stride_for(step: float) -> int:
    """Bins from node to node.

    Parameters
    ----------
    step : float
        Largest k times the width of a bin, radians.

    Returns
    -------
    int
        1 where every bin is needed.
    """
    return max(1, int(STEP / step))


def nodes_for(bins: int, stride: int) -> int:
    """Count the nodes that ``on_nodes`` carries weights to.

    Parameters
    ----------
    bins, stride : int
        Radii, and bins from node to node.

    Returns
    -------
    int
    """
    return bins if stride == 1 else -(-bins // stride) + HALF


def on_nodes(weights: FloatArray, stride: int) -> FloatArray:
    """Carry weights at radii 0, 1, 2, ... bins to every ``stride``-th of them.

    Parameters
    ----------
    weights : (bins, m) float64
        Weight of each radius, for each of m sums.
    stride : int
        As ``stride_for`` gives it.

    Returns
    -------
    (nodes, m) float64
        Weights at radii 0, stride, 2 stride, ... bins. Their sum against J0(k r) departs from that of the
        weights given by less than 1e-14 of the sum of |weights|, for every k that the stride allows.

    Notes
    -----
    J0(k r) is the mean of cos(k r sin t) over t. Each of these is interpolated from nodes h apart, with
    k h <= pi/2, by sinc under a Kaiser-Bessel window of 24 nodes to either side: the error falls as
    exp(-24 (pi - k h)) (Knab 1979) and is below rounding. J0 is even: nodes at r < 0 are those at -r.

    References
    ----------
    Knab, "Interpolation of band-limited functions using the approximate prolate series", IEEE Transactions on
    Information Theory 25(6), 1979.
    """
    if stride == 1:
        return weights
    bins, sums = weights.shape
    cells = -(-bins // stride)
    padded = np.zeros((cells * stride, sums))
    padded[:bins] = weights
    shares = np.tensordot(_interpolation(stride), padded.reshape(cells, stride, sums), axes=(0, 1))
    carried = np.zeros((cells + 2 * HALF, sums))  # from node 1 - HALF on
    for tap, share in enumerate(shares):
        carried[tap : tap + cells] += share
    nodes = carried[HALF - 1 : -1]
    nodes[1:HALF] += carried[: HALF - 1][::-1]
    return nodes


@cache
def _interpolation(stride: int) -> FloatArray:
    """Share of each node around a cell in a radius at each place of the cell: (stride, 2 HALF)."""
    away = np.arange(stride)[:, None] / stride - np.arange(1 - HALF, HALF + 1)
    inside = np.sqrt(np.maximum(1 - (away / HALF) ** 2, 0.0))
    return np.asarray(np.sinc(away) * np.i0(SHARPNESS * inside) / np.i0(SHARPNESS))
