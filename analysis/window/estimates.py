"""All estimates of one point set in a window: ``gbnbench.in_window``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.window.bin_covariance import interpolated
from gbnbench.analysis.window.box import Window, check_window
from gbnbench.analysis.window.hyperuniformity import Value, beyond_gauss, hyperuniformity
from gbnbench.analysis.window.nearest_neighbours import NearestDistances, nearest_distances
from gbnbench.analysis.window.pair_correlation import pair_correlation
from gbnbench.analysis.window.radial_structure_factor import NU_MAX, radial_structure_factor
from gbnbench.analysis.window.structure_factor import tapered
from gbnbench.core.errors import InputError
from gbnbench.core.results.measures import Measures
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress

if TYPE_CHECKING:
    import pandas as pd

MODES = {1: 4096, 2: 128, 3: 24}  # half steps of pi / L over which the variance of n is summed
UNSEEN = 0.25  # standard errors by which hidden neighbours may lower the mean distance
LOWEST = 0.05  # of the first bin's wave number, below which S is taken there

TITLES: Mapping[str, str] = {
    "intensity": "points per unit of volume",
    "s_zero": "S(k -> 0), extrapolated",
    "s_peak": "S at its peak",
    "nu_peak": "nu of the peak",
    "hyperuniformity": "H = S(0) / S(peak)",
    "exponent": "alpha, in S ~ k^alpha at small k",
    "mean_distance": "mean distance to the nearest neighbour",
    "min_distance": "smallest distance of two points",
    "resolution": "smallest k that the window resolves",
}


@dataclass(frozen=True)
class WindowEstimates:
    """Estimates for points seen in a window that is no torus: the result of ``gbnbench.in_window``.

    Attributes
    ----------
    n, d : int
        Points and dimension.
    window : Window
        ``low``, ``high``, ``sides`` and ``volume``.
    tapers : tuple of int
        Sine tapers of each axis.
    structure_factor : pandas.DataFrame
        Columns k, nu, S, standard_error, low, high, count, degrees, leakage, resolved: see
        ``gbnbench.analysis.window.radial_structure_factor``.
    pair_correlation : pandas.DataFrame
        Columns r, spacings, g, standard_error, pairs.
    nearest : NearestDistances
        Distances to the nearest neighbour, corrected for the border; ``nearest.distribution(r)``.
    scalars : Measures
        Values by name with ``standard_error`` and ``reasons``: intensity, s_zero, s_peak, nu_peak,
        hyperuniformity, exponent, mean_distance, min_distance, resolution.
    intervals : dict
        Name -> ends of the 95% interval, of the same names; nan where there is no error.

    Examples
    --------
    >>> import gbnbench
    >>> x = gbnbench.generate("jittered", n=1024, d=2, seed=0)
    >>> found = gbnbench.in_window(x, 0, 1)
    >>> abs(found.scalars["s_zero"]) < 3 * found.scalars.standard_error["s_zero"]  # hyperuniform
    True
    >>> found.tapers, len(found.structure_factor.columns)
    ((2, 2), 10)
    """

    n: int
    d: int
    window: Window
    tapers: tuple[int, ...]
    structure_factor: pd.DataFrame
    pair_correlation: pd.DataFrame
    nearest: NearestDistances
    scalars: Measures
    intervals: Mapping[str, tuple[float, float]]

    def to_frame(self) -> pd.DataFrame:
        """One row a scalar: columns measure, value, standard_error, low, high, reason."""
        table = self.scalars.to_frame()
        table.insert(3, "low", [self.intervals[name][0] for name in table["measure"]])
        table.insert(4, "high", [self.intervals[name][1] for name in table["measure"]])
        return table


def in_window(
    points: ArrayLike,
    low: ArrayLike,
    high: ArrayLike,
    *,
    nu_max: float = NU_MAX,
    tapers: tuple[int, ...] | None = None,
    seed: int = 0,
    progress: Progress | None = None,
) -> WindowEstimates:
    """Estimate spectrum, pair correlation and distances of points seen in a window that is no torus.

    Parameters
    ----------
    points : (n, d) array_like
        Points in any unit, n >= 16, d <= 8: what a window shows of a pattern that continues beyond it, alike
        everywhere and in all directions (stationary and isotropic).
    low, high : float or (d,) array_like
        Opposite corners of the window: not of the points' bounding box, which is smaller.
    nu_max : float
        How far S(k) goes, in nu = k / (2 pi) over intensity^(1/d).
    tapers : tuple of int, optional
        Sine tapers of each axis; by default four in 1D, two in 2D to 4D, one beyond, more on longer sides.
    seed : int
        Draws the wave vectors of bins that hold too many for all to be summed (3D from about 10,000 points,
        more dimensions).
    progress : Progress, optional
        Told of each step; nothing is said without it.

    Returns
    -------
    WindowEstimates
        Each number with its standard error from this single set.

    Raises
    ------
    InputError
        If points are no (n, d) real numbers in the window, or another argument breaks its rule.

    Notes
    -----
    The page "Points in a window" has the formulas and sources, and how often the stated errors hold against
    closed forms. Errors are those of Gaussian fluctuations of density: they are too small for strongly
    clustered sets. Cost: 100,000 points take 7 CPU seconds in 2D, 20 in 3D, and 500 MB.

    Examples
    --------
    >>> x = np.random.default_rng(3).random((1000, 2)) * [512, 256]
    >>> found = in_window(x, 0, [512, 256])
    >>> round(found.scalars["s_zero"], 2), round(found.scalars.standard_error["s_zero"], 2)  # Poisson: 1
    (0.75, 0.17)
    >>> list(found.pair_correlation.columns)
    ['r', 'spacings', 'g', 'standard_error', 'pairs']
    """
    x, window = check_window(points, low, high)
    if not (isinstance(nu_max, (int, float, np.number)) and 0.5 <= nu_max <= 100):
        raise InputError(f"nu_max must be a number from 0.5 to 100; got {nu_max!r}")
    told = Progress() if progress is None else progress
    n, d = x.shape
    rate = (n / window.volume) ** (1 / d)
    seen = tapered(x, window, tapers)
    rng = np.random.default_rng(np.random.SeedSequence(seed))
    spectrum, covariance = radial_structure_factor(seen, 2 * math.pi * nu_max * rate, rng, told)
    told.start(2, 0, "pair correlation")
    pairs = pair_correlation(x, window, spectrum)
    told.advance("nearest neighbours")
    nearest = nearest_distances(x, window)
    told.advance("nearest neighbours")
    low_band = hyperuniformity(spectrum, covariance, beyond_gauss(n, d))
    intensity = n / window.volume
    alpha = low_band.exponent
    relative = count_variance(spectrum, window, 0.0 if alpha.reason else alpha.value - alpha.error)
    found = {
        "intensity": Value.normal(intensity, intensity * math.sqrt(relative / n)),
        "s_zero": low_band.s_zero,
        "s_peak": low_band.s_peak,
        "nu_peak": Value(low_band.nu_peak, math.nan, low_band.s_peak.reason),
        "hyperuniformity": low_band.ratio,
        "exponent": low_band.exponent,
        "mean_distance": _mean_distance(nearest, window),
        "min_distance": Value(nearest.smallest, math.nan),
        "resolution": Value(seen.tapers.bandwidth, math.nan),
    }
    scalars = Measures(
        {name: v.value for name, v in found.items()},
        {name: v.error for name, v in found.items()},
        {name: v.reason for name, v in found.items() if v.reason},
    )
    intervals = {name: v.interval for name, v in found.items()}
    return WindowEstimates(n, d, window, seen.tapers.counts, spectrum, pairs, nearest, scalars, intervals)


def _mean_distance(nearest: NearestDistances, window: Window) -> Value:
    """Give the mean, or why the window is too narrow for it."""
    if not len(nearest.distance):
        return Value(math.nan, math.nan, "no point has its nearest neighbour nearer than the border")
    longest = float(window.sides.min()) / 2
    surely = nearest.hidden - nearest.hidden_error
    if surely * (longest - nearest.mean) > UNSEEN * nearest.mean_error:
        return Value(
            math.nan, math.nan,
            f"the neighbours of some {nearest.hidden:.2g} of the points are farther than half the window's "
            f"shortest side, {longest:g}, where none can be seen for the border: a wider window is needed",
        )  # fmt: skip
    return Value.normal(nearest.mean, nearest.mean_error)


def count_variance(spectrum: pd.DataFrame, window: Window, exponent: float) -> float:
    """Estimate the variance of n over its mean: the mean of S under the window's own transform.

    Parameters
    ----------
    spectrum : pandas.DataFrame
        Columns k and S.
    window : Window
        The window.
    exponent : float
        Of the power law that S follows below its first bin; taken as 0 if it is less.

    Returns
    -------
    float
        1 + sum over multiples m of pi / L_a of (S - 1) prod_a sinc(m_a / 2)^2 / 2, S being a power law
        below the first bin, and 1 beyond the last. In more than three dimensions that of the first bin.
    """
    k, s = spectrum["k"].to_numpy(), spectrum["S"].to_numpy()
    if window.d not in MODES:
        return float(s[0])
    steps = np.arange(-MODES[window.d], MODES[window.d] + 1)
    squares, weight = np.zeros(1), np.ones(1)
    for side in window.sides.tolist():
        squares = (squares[:, None] + (math.pi / side * steps) ** 2).ravel()
        weight = (weight[:, None] * np.sinc(steps / 2) ** 2 / 2).ravel()
    at = np.sqrt(squares)
    excess: FloatArray = np.where(
        at > k[-1], 0.0, interpolated(np.maximum(at, LOWEST * k[0]), k, s, exponent) - 1
    )
    return max(1 + float(weight @ excess), 0.0)
