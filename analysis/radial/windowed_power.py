"""PSA's radial power from g(r): a Hankel transform under a window (Heck, Schlömer & Deussen 2013)."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import pairwise

import numpy as np
from scipy.special import j0

from gbnbench.analysis.radial.hankel_nodes import nodes_for, on_nodes, stride_for
from gbnbench.core.large_arrays import empty_array
from gbnbench.core.torus import FloatArray

ROWS = 256  # of the Bessel matrix made at once: the lower their frequencies, the fewer radii carry the sum
SETS = 256  # transformed at once: on its way to the nodes each takes some hundred kilobytes
WIDEST = 0.25  # where the window ends for all frequencies from sqrt(n)/8 on
KEPT = 1 << 22  # numbers of a matrix that is kept from call to call, in blocks
KEPT_BLOCKS = 16


def windowed_power(density: FloatArray, frequency: FloatArray, n: int, total: int) -> FloatArray:
    """Radial power of all sets at once, by the formula of ``spectral_statistics``.

    Parameters
    ----------
    density : (bins, realizations) float64
        2 pi n (g - 1) r dr of every set.
    frequency : (k,) float64
        The first k of PSA's frequencies.
    n, total : int
        Points of a set, and M = int(100 sqrt(n)).

    Returns
    -------
    (realizations, k) float64
    """
    bins, rows = len(density), len(frequency)
    lowest = min(rows, 1 + math.ceil(0.25 * total / math.sqrt(n)))  # frequencies of narrower windows
    blocks = [(0, lowest, 1)]
    for start, end in pairwise([*range(lowest, rows, ROWS), rows]):
        blocks.append((start, end, stride_for(0.5 * math.pi * end * n / total**2)))
    kept = sum((end - start) * nodes_for(bins, stride) for start, end, stride in blocks) <= KEPT
    kernel = _kept_kernel if kept else _kernel
    radii = np.arange(bins, dtype=np.float64) * (0.5 / total)
    window = _window(radii, np.array(WIDEST))[:, None]
    power = empty_array((density.shape[1], rows))
    for start, end, stride in blocks:
        matrix = kernel(n, total, nodes_for(bins, stride) if start else bins, start, end, stride)
        for first in range(0, len(power), SETS):
            some = density[:, first : first + SETS]
            weights = on_nodes(some * window, stride) if start else some
            power[first : first + SETS, start:end] = np.abs(1 + matrix @ weights).T
    return power


def _kernel(n: int, total: int, nodes: int, start: int, end: int, stride: int) -> FloatArray:
    """J0(2 pi v r) at every ``stride``-th bin, times the window for the lowest v: (frequencies, nodes)."""
    r = np.arange(nodes, dtype=np.float64) * (stride * 0.5 / total)
    v = np.arange(start, end)[:, None] * (0.5 * n / total)
    bessel = np.asarray(j0(2 * math.pi * v * r))
    if start:
        return bessel
    reach = np.asarray(0.5 * np.clip(4 * v / math.sqrt(n), 0.2, 2 * WIDEST), dtype=np.float64)
    return np.asarray(bessel * _window(r, reach))


def _window(r: FloatArray, reach: FloatArray) -> FloatArray:
    window: FloatArray = 0.43 + 0.5 * np.cos(math.pi * r / reach) + 0.08 * np.cos(2 * math.pi * r / reach)
    return np.asarray(np.where(r > reach, 0.0, window))


# It depends on n alone, and is most of the work for a few sets of a thousand points.
_kept_kernel = lru_cache(maxsize=KEPT_BLOCKS)(_kernel)
