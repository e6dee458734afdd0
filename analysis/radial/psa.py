"""PSA's spectral statistics, effective Nyquist frequency and oscillations (Heck, Schlömer & Deussen 2013)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.radial.curve_statistics import effective_nyquist, oscillations, suffices
from gbnbench.analysis.radial.windowed_power import windowed_power
from gbnbench.analysis.spatial.rdf import pair_density
from gbnbench.analysis.standard_errors import left_out_sums, sample_variance
from gbnbench.core.errors import RefusalError
from gbnbench.core.sides import Sides, as_sides, shortest_side
from gbnbench.core.torus import FloatArray, as_realizations

FIRST_RANGE = 8.0  # sqrt(n) up to which frequencies are evaluated first; most sets need no more
MOST_POINTS = 200_000  # some minutes on one core, where there is no OpenCL device


@dataclass(frozen=True)
class SpectralStatistics:
    """Effective Nyquist frequency and oscillations of a source, with their errors.

    Attributes
    ----------
    effective_nyquist, oscillations : float
        Statistics of the power averaged over realizations, as PSA computes them.
    effective_nyquist_error, oscillations_error : float
        Their standard errors by the jackknife over realizations; nan for a single one.
    effective_nyquist_by_set, oscillations_by_set : (realizations,) float64
        Statistics of each set's own power. Its noise counts as oscillation too, so that they are larger.
    frequency : (k,) float64
        Left edges of PSA's bins, sqrt(n)/200 apart, as far as both statistics needed them.
    power : (realizations, k) float64
        Radial power of each set, derived from its radial distribution function.
    """

    effective_nyquist: float
    oscillations: float
    effective_nyquist_error: float
    oscillations_error: float
    effective_nyquist_by_set: FloatArray
    oscillations_by_set: FloatArray
    frequency: FloatArray
    power: FloatArray


def spectral_statistics(x: ArrayLike, sides: ArrayLike | None = None) -> SpectralStatistics:
    """PSA's effective Nyquist frequency and oscillations of one or several sets.

    Parameters
    ----------
    x : (n, 2) or (realizations, n, 2) float64
        Points on the unit torus, n >= 2.
    sides : (2,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a square if not given.

    Returns
    -------
    SpectralStatistics
        Effective Nyquist 0 where the power never falls low, as for random points.

    Raises
    ------
    InputError
        If sides are not two lengths.
    RefusalError
        If d is not 2, n < 2, or n > 200,000: a fifth of all pairs is counted. If one side is more than about
        four times the other: the disc of radius 1/4 in which pairs are counted does not fit.

    Notes
    -----
    Radial power at frequency v is

        P(v) = |1 + 2 pi n sum over r of (g(r) - 1) J0(2 pi v r) r w(r) dr|,

    g being the radial distribution function in M = int(100 sqrt(n)) bins over [0, 1/2], and v the M left
    edges of bins over [0, n/2]. The window is w(r) = 0.43 + 0.5 cos(pi r/X) + 0.08 cos(2 pi r/X) up to X =
    0.5 clamp(4 v/sqrt(n), 0.2, 0.5) and zero beyond.

    Effective Nyquist frequency: let C(v) = sum over v' <= v of 2 v' P(v') dv / v^2. From v = sqrt(n)/2
    upwards find the first C > 0.5, and from there downwards the first C < 0.1. The result is v there over
    sqrt(n), in steps of 0.005.

    Oscillations: 10 sqrt(2 pi Int (P - 1)^2 v dv / (pi (v1^2 - v0^2))) over v0..v1. P first reaches 0.98 at
    v0, or has its maximum there if it never does; v1 = min(v0 + 5 sqrt(n), n/2).

    The window ends at r = 1/4 at the latest, so pairs farther apart are not counted. From v = sqrt(n)/8 on
    the sum is taken over fewer radii (``hankel_nodes``): P changes by some 1e-15. Integrals are by the
    trapezoidal rule. PSA drops one sample if their number is odd and reads coordinates as float32, so that
    its figures may differ by 0.001.

    References
    ----------
    Heck, Schlömer & Deussen, "Blue noise sampling with controlled aliasing", ACM Transactions on Graphics
    32(3), 2013.
    """
    sets = as_realizations(x)
    return statistics_of(excess_density(sets, as_sides(sides, sets.shape[2])), sets.shape[1])


def excess_density(sets: FloatArray, sides: Sides | None = None) -> FloatArray:
    """Give the radial distribution functions from which ``spectral_statistics`` are computed.

    Parameters
    ----------
    sets : (realizations, n, 2) float64
        Checked points.
    sides : tuple of 2 floats, optional
        As ``as_sides`` returns them.

    Returns
    -------
    (realizations, bins) float64
        2 pi n (g - 1) r dr on the bins that the window covers.

    Raises
    ------
    RefusalError
        As ``spectral_statistics``.
    """
    n, d = sets.shape[1:]
    if d != 2:
        raise RefusalError(f"PSA's spectral statistics are defined in the plane; got d={d}")
    if n < 2:
        raise RefusalError("PSA's spectral statistics are made of pairs and need n >= 2; got n=1")
    if (reason := too_many_points(n, d)) is not None:
        raise RefusalError(reason)
    total = int(100 * math.sqrt(n))
    if (total // 2 + 1) * (0.5 / total) > 0.5 * shortest_side(sides):
        raise RefusalError(
            "PSA's spectral statistics count pairs to a quarter of the root of the area; half the "
            f"shorter side is {0.5 * shortest_side(sides):.3g} of it, and one side may be about four times "
            "the other at most"
        )
    width, bins = 0.5 / total, total // 2 + 1
    r = np.arange(bins) * width
    g = pair_density(sets, bins, width, sides)
    return np.asarray((2 * math.pi * n * width) * (g - 1) * r)


def too_many_points(n: int, d: int) -> str | None:
    """Say why ``spectral_statistics`` refuses so many points of the plane; None where it does not.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.

    Returns
    -------
    str or None
    """
    if d != 2 or n <= MOST_POINTS:
        return None
    return f"PSA's spectral statistics count n^2/10 pairs; n must be at most {MOST_POINTS}, got n={n}"


def statistics_of(excess: FloatArray, n: int) -> SpectralStatistics:
    """PSA's statistics of sets whose radial distribution functions are known.

    Parameters
    ----------
    excess : (realizations, bins) float64
        As ``excess_density`` returns it.
    n : int
        Points of a set.

    Returns
    -------
    SpectralStatistics
    """
    total, density = int(100 * math.sqrt(n)), np.transpose(excess)
    rows = min(total, math.ceil(FIRST_RANGE * total / (0.5 * math.sqrt(n))))
    while True:
        frequency: FloatArray = np.arange(rows, dtype=np.float64) * (0.5 * n / total)
        power = windowed_power(density, frequency, n, total)
        if rows == total or all(suffices(curve, frequency, n) for curve in _curves(power)):
            break
        rows = total
    found = [
        (effective_nyquist(curve, frequency, n), oscillations(curve, frequency, n))
        for curve in _curves(power)
    ]
    nyquist, omega = (np.array(column) for column in zip(*found, strict=True))
    last = len(excess) + 1
    return SpectralStatistics(
        effective_nyquist=float(nyquist[0]),
        oscillations=float(omega[0]),
        effective_nyquist_error=_jackknife(nyquist[last:]),
        oscillations_error=_jackknife(omega[last:]),
        effective_nyquist_by_set=nyquist[1:last],
        oscillations_by_set=omega[1:last],
        frequency=frequency,
        power=power,
    )


def _curves(power: FloatArray) -> Iterator[FloatArray]:
    """Give the mean power, that of each set, and that of all sets but one, for each if there are several."""
    yield power.mean(axis=0)
    yield from power
    if len(power) > 1:
        yield from (total / (len(power) - 1) for total in left_out_sums(power))


def _jackknife(left_out: FloatArray) -> float:
    sets = len(left_out)
    return (sets - 1) * math.sqrt(float(sample_variance(left_out)) / sets) if sets > 1 else math.nan
