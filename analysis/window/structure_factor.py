"""Structure factor of points seen in a window, by orthogonal sine tapers, at any wave vectors.

J_p(k) = sum_j g(x_j) with g(x) = h_p(x) exp(-i k.x) - c h_1(x), h_p the tapers. c makes the integral of g 0,
so that the points' mean density drops out (Rajala, Olhede, Grainger & Murrell 2023; Hawat, Gautier, Bardenet
& Lachièze-Rey 2023). Then E |J_p(k)|^2 = intensity times the integral of S(k') |G(k')|^2 / (2 pi)^d, exactly,
G being the transform of g: S is averaged over a neighbourhood of k as wide as the tapers' bandwidth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.window.box import Window, check_window
from gbnbench.analysis.window.tapered_sums import direct_sums
from gbnbench.analysis.window.tapers import ComplexArray, SineTapers, default_counts
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class TaperedPoints:
    """Points of a window with the tapers' values at them.

    Attributes
    ----------
    window : Window
        The window.
    u : (n, d) float64
        Points as fractions of the window's sides.
    tapers : SineTapers
        The tapers.
    values : (tapers, n) float64
        Each taper at the points, where its square has mean 1 over the window.
    """

    window: Window
    u: FloatArray
    tapers: SineTapers
    values: FloatArray

    @property
    def weight(self) -> float:
        """Points as the tapers see them: mean over tapers of sum_j h_p(x_j)^2, n in expectation."""
        return float((self.values**2).sum()) / len(self.values)

    def powers(
        self, sums: ComplexArray, k: FloatArray, rows: slice = slice(None)
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return |J_p(k)|^2, the integral of |g|^2, and that of |grad g|^2, which is k^2 as averaged.

        Parameters
        ----------
        sums : (tapers, m) complex128
            sum_j h_p(x_j) exp(-i k.x_j), x_j from the window's lower corner.
        k : (m, d) float64
            Wave vectors, in radians a length.
        rows : slice
            The tapers that these are; all of them if not given.

        Returns
        -------
        powers, masses, squares : (tapers, m) float64
            S = sum of powers / (``weight`` times sum of masses) at the wave number whose square is
            sum of squares / sum of masses.
        """
        tapers = self.tapers
        c = tapers.transforms(k)[rows] / tapers.first_mean
        shared = (c.conj() * tapers.overlaps(k)[rows]).real
        own = np.abs(c) ** 2
        first = tapers.squared_bandwidths[0]
        length = (k**2).sum(axis=1) + tapers.squared_bandwidths[rows, None]
        powers = np.abs(sums - c * self.values[0].sum()) ** 2
        return powers, 1 - 2 * shared + own, length - first * (2 * shared - own)


def tapered(points: FloatArray, window: Window, tapers: tuple[int, ...] | None = None) -> TaperedPoints:
    """Evaluate the tapers at points.

    Parameters
    ----------
    points : (n, d) float64
        Checked points of the window.
    window : Window
        The window.
    tapers : tuple of int, optional
        Tapers of each axis; ``default_counts`` chooses them.

    Returns
    -------
    TaperedPoints

    Raises
    ------
    InputError
        If tapers are not d counts of at least 1.
    """
    counts = default_counts(window.sides) if tapers is None else tuple(tapers)
    if len(counts) != window.d or min(counts) < 1:
        raise InputError(f"tapers must be {window.d} counts of at least 1, one an axis; got {tapers!r}")
    chosen = SineTapers(window.sides, counts)
    u = window.fractions(points)
    return TaperedPoints(window, u, chosen, chosen.values(u))


def structure_factor(
    points: ArrayLike,
    low: ArrayLike,
    high: ArrayLike,
    k: ArrayLike,
    *,
    tapers: tuple[int, ...] | None = None,
) -> pd.DataFrame:
    """Estimate the structure factor of a point process at any wave vectors, from one set in a window.

    Parameters
    ----------
    points : (n, d) array_like
        Points in any unit, n >= 16.
    low, high : float or (d,) array_like
        Opposite corners of the window.
    k : (m, d) array_like
        Wave vectors, in radians a length: 2 pi times a frequency.
    tapers : tuple of int, optional
        How many sine tapers each axis gets: more have less variance and less resolution. By default two in
        two to four dimensions, more along longer sides.

    Returns
    -------
    pandas.DataFrame
        A row a wave vector: k0, k1, ..., ``k``, the effective wave number; ``S``; ``standard_error``, that of
        an average over as many independent exponential powers as there are tapers; ``resolved``, whether
        |k| is at least the tapers' bandwidth.

    Raises
    ------
    InputError
        If the points do not lie in the window, or k or tapers do not fit.

    Notes
    -----
    S(k) = 1 + intensity times the integral of (g(r) - 1) exp(-i k.r); Poisson points have S = 1. The estimate
    is unbiased at ``k`` where S is linear in k^2 over the bandwidth. Cost: a sine and a cosine for each point
    and wave vector, about 40 ns.

    Examples
    --------
    >>> points = np.random.default_rng(1).random((2000, 2)) * [40, 50]
    >>> structure_factor(points, 0, [40, 50], [[3.0, 4.0]]).round(3).to_dict("records")
    [{'k0': 3.0, 'k1': 4.0, 'k': 5.003, 'S': 1.572, 'standard_error': 0.786, 'resolved': True}]
    """
    import pandas as pd

    x, window = check_window(points, low, high)
    vectors = np.asarray(k, dtype=np.float64)
    if vectors.ndim != 2 or vectors.shape[1] != window.d or not np.isfinite(vectors).all():
        raise InputError(
            f"k must be (m, {window.d}) finite wave vectors, radians a length; got shape {vectors.shape}"
        )
    seen = tapered(x, window, tapers)
    sums = direct_sums(seen.u, seen.values, vectors * window.sides / (2 * math.pi), Progress())
    powers, masses, squares = (part.sum(axis=0) for part in seen.powers(sums, vectors))
    with np.errstate(invalid="ignore", divide="ignore"):
        s, length = powers / (seen.weight * masses), np.sqrt(squares / masses)
    # Of tapers at one k the powers are independent, but near k = 0 J(k) is correlated with its conjugate.
    steps = vectors * window.sides / math.pi
    overlaps = [seen.tapers.squared_overlaps(axis, steps[:, axis]) for axis in range(window.d)]
    variance = (len(seen.values) + np.prod(overlaps, axis=0)) / len(seen.values) ** 2
    columns = {f"k{axis}": vectors[:, axis] for axis in range(window.d)}
    resolved = np.linalg.norm(vectors, axis=1) >= seen.tapers.bandwidth
    return pd.DataFrame(
        {**columns, "k": length, "S": s, "standard_error": s * np.sqrt(variance), "resolved": resolved}
    )
