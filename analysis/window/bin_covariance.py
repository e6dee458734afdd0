"""Covariance of the means of tapered powers over bins of wave vectors, for Gaussian amplitudes."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.window.tapers import SineTapers
from gbnbench.analysis.window.wave_vectors import Bin
from gbnbench.core.torus import FloatArray

COUNTED = 512  # wave vectors of a bin whose neighbours are counted
NEIGHBOURS = 1 << 20  # of a bin's wave vectors, at most
STEEPEST = 4.0  # exponent of S below the first bin


def relative_covariance(bins: list[Bin], k: FloatArray, s: FloatArray, tapers: SineTapers) -> FloatArray:
    """Find the covariance of the bins' estimates over the product of their expectations.

    Parameters
    ----------
    bins : list of Bin
        The bins, in order.
    k, s : (bins,) float64
        Effective wave numbers, and the structure factor there.
    tapers : SineTapers
        Tapers.

    Returns
    -------
    (bins, bins) float64
        Its diagonal is 1 over the number of independent exponential powers that a bin's mean is worth.

    Notes
    -----
    For amplitudes that are Gaussian with E J_p(k) conj J_q(k') ~ sqrt(S(k) S(k')) C_pq(k - k'), where C_pq is
    the transform of h_p h_q, it is the sum over k of the one bin, k' of the other, p and q of
    S(k) S(k') |C_pq(k - k')|^2 over the product of the sums of S. C is summed over a few neighbours, beyond
    which it is less than 1e-4. S is interpolated between the estimates.
    """
    d, number = len(tapers.sides), len(bins)
    steps = [np.arange(-r, r + 1) for r in (1 if count == 1 else count + 2 for count in tapers.counts)]
    size = math.prod(len(step) for step in steps)
    overlap = np.ones(1)
    for axis, step in enumerate(steps):
        overlap = (overlap[:, None] * tapers.squared_overlaps(axis, step)).ravel()
    itself = size // 2
    edges = np.array([bins[0].low] + [b.high for b in bins])
    covariance, totals = np.zeros((number, number)), np.zeros(number)
    for i, shell in enumerate(bins):
        counted = min(len(shell.multiples), max(16, min(COUNTED, NEIGHBOURS // size)))
        own = shell.multiples[np.linspace(0, len(shell.multiples) - 1, counted).astype(np.intp)]
        squares = np.zeros((counted, 1))
        for axis in range(d):
            moved = (2 * math.pi / tapers.sides[axis] * (own[:, axis, None] + steps[axis])) ** 2
            squares = (squares[:, :, None] + moved[:, None, :]).reshape(counted, -1)
        length = np.sqrt(squares)
        label = np.searchsorted(edges, length, side="right") - 1
        inside = (label >= 0) & (label < number)
        at = interpolated(np.maximum(length, 0.1 * edges[0]), k, s)
        product = at[:, itself, None] * at * overlap
        covariance[i] = np.bincount(label[inside], product[inside], number) / counted
        covariance[i] *= [other.share for other in bins]
        if shell.share < 1:
            covariance[i, i] += (1 - shell.share) * float(product[:, itself].mean())
        totals[i] = float(at[:, itself].mean())
    covariance *= np.array([len(b.multiples) / b.share for b in bins])[:, None] / len(tapers.orders) ** 2
    sums = totals * np.array([len(b.multiples) for b in bins])
    shares = np.array([b.share for b in bins])
    covariance *= shares[:, None] / np.outer(sums, sums)
    return (covariance + covariance.T) / 2


def interpolated(at: FloatArray, k: FloatArray, s: FloatArray, exponent: float | None = None) -> FloatArray:
    """Interpolate a structure factor between its bins, as a power law from each to the next.

    Parameters
    ----------
    at : (...) float64
        Wave numbers, above 0.
    k, s : (bins,) float64
        Effective wave numbers and estimates.
    exponent : float, optional
        Of the power law below the first bin, taken to lie in 0 .. 4; that of the first two bins if not given.

    Returns
    -------
    (...) float64
        Beyond the last bin the last value.
    """
    x, y = np.log(k), np.log(np.maximum(s, 1e-300))
    place = np.log(at)
    found = np.interp(place, x, y)
    if len(k) > 1:
        slope = (y[1] - y[0]) / (x[1] - x[0]) if exponent is None else exponent
        slope = min(max(slope, 0.0), STEEPEST)
        found += slope * np.minimum(place - x[0], 0.0)
    values: FloatArray = np.exp(found)
    return values
