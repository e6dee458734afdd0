"""Descent to a target pair correlation function in the plane (Heck, Schlömer & Deussen 2013)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gauss_newton.targets import TargetPower
from gbnbench.generators.spectral_control.named_profiles import StepProfile
from gbnbench.generators.spectral_control.target_correlation import pair_correlation_of

FARTHEST = 0.5  # box sides that bins reach
USED = 0.49  # and forces: beyond, periods make the spectrum anisotropic
SMOOTHING = 8.0  # standard deviation of the Gaussian over bins
COOLEST, COOLING = 1e-3, 0.9  # spacings that the point with the largest force moves: from 1 down to this
LEVELS = math.ceil(math.log(COOLEST) / math.log(COOLING))
PATIENCE = 5  # steps without a better fit after which it cools
WORSE = 1.2  # times the best misfit: back to the best set
ROWS = 64  # points whose pairs are in the cache together
MOST = 4096  # points
PARTS = 20  # of a bin, over which a target is averaged

Block = tuple[slice, FloatArray, FloatArray, FloatArray]


def correlation_refusal(n: int, d: int) -> str | None:
    """Say why the pair correlation function of n points in d dimensions is not brought to a target.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    str or None
        The reason; None where it is.
    """
    if d != 2:
        return f"method=correlation is of the plane; got d={d}, nearest is 2"
    if n > MOST:
        return (
            f"n must be at most {MOST} for method=correlation, minutes of all pairs; got n={n}, "
            f"nearest is {MOST}"
        )
    return None


class CorrelationDescent:
    """The publication's descent for sets of n points in the plane.

    Parameters
    ----------
    n : int
        Points, and bins of the pair correlation function.
    target : callable
        Power as a function of nu.
    highest : float
        nu beyond which the power is taken as 1.

    Notes
    -----
    g is counted in n bins up to half the box and smoothed by a Gaussian of 8 bins; the target of a step is
    its closed form, averaged over each bin, any other is smoothed as g is. The misfit is the root of the
    integral of (g - target)**2. Two points push one another apart by the integral of g - target up to their
    distance r, over n r. The longest displacement is T spacings; T falls from 1 to 1e-3 by tenths, whenever
    five steps bring no better fit or one is a fifth worse than the best, to which it then goes back.
    """

    def __init__(self, n: int, target: TargetPower, highest: float) -> None:
        self.n, self.width = n, FARTHEST / n
        edges = np.arange(n) * self.width
        self._norm = n * (n - 1) / 2 * math.pi * self.width**2 * (2 * np.arange(n) + 1)
        reach = math.ceil(5 * SMOOTHING)
        self._reach, self._window = reach, np.exp(-(np.arange(-reach, reach + 1) ** 2) / (2 * SMOOTHING**2))
        self._share = 1 / self._windowed(np.ones(n))
        within = (edges[:, None] + (np.arange(PARTS) + 0.5) / PARTS * self.width) * math.sqrt(n)
        if isinstance(target, StepProfile):
            self.target = step_correlation(target.edge, within).mean(axis=1)
        else:
            self.target = self._smoothed(pair_correlation_of(target, 2, highest, within.mean(axis=1)))
        self._radius = np.append(1 / math.sqrt(n), edges[1:])  # the program divides every bin but the first

    def correlation(self, x: FloatArray) -> FloatArray:
        """Smoothed pair correlation function of points, (n,), bin by bin.

        Parameters
        ----------
        x : (n, 2) float64
            Points in [0, 1).

        Returns
        -------
        (n,) float64
        """
        count = np.zeros(self.n + 1, dtype=np.int64)
        for _, _, _, place in self._pairs(x):
            count += np.bincount(np.minimum(place, self.n).astype(np.intp).ravel(), minlength=self.n + 1)
        return self._smoothed(count[: self.n] / self._norm)

    def misfit(self, correlation: FloatArray) -> float:
        """Root of the integral of the squared deviation from the target."""
        return math.sqrt(self.width * float(np.sum((correlation - self.target) ** 2)))

    def forces(self, x: FloatArray, correlation: FloatArray) -> FloatArray:
        """Compute the forces on points; their scale means nothing.

        Parameters
        ----------
        x : (n, 2) float64
            Points in [0, 1).
        correlation : (n,) float64
            Theirs.

        Returns
        -------
        (n, 2) float64
        """
        force = np.cumsum(self.width * (correlation - self.target)) / (self.n * self._radius**2)
        force = np.append(force, 0.0)
        force[int(USED / self.width) :] = 0.0
        rise = np.append(np.diff(force), 0.0)
        total = np.zeros((self.n, 2))
        for rows, dx, dy, place in self._pairs(x):
            bin_of = np.minimum(place, self.n).astype(np.intp)
            strength = force[bin_of] + rise[bin_of] * (place - bin_of)
            for axis, apart in enumerate((dx, dy)):
                apart *= strength
                total[rows, axis] += apart.sum(axis=1)
                total[rows.start :, axis] -= apart.sum(axis=0)
        return total

    def run(self, x: FloatArray, steps: int, progress: Callable[[int, float], None] | None) -> FloatArray:
        """Move points until they are cool.

        Parameters
        ----------
        x : (n, 2) float64
            Start, in [0, 1).
        steps : int
            Most steps.
        progress : callable, optional
            Called with the levels of T that are done, of ``LEVELS``, and the least misfit.

        Returns
        -------
        (n, 2) float64
            The set with the least misfit.
        """
        best, correlation = x, self.correlation(x)
        least, level, waited = self.misfit(correlation), 0, 0
        for _ in range(steps):
            forces = self.forces(x, correlation)
            longest = math.sqrt(float(np.sum(forces**2, axis=1).max()))
            if level >= LEVELS or longest == 0:
                break
            x = wrap(x + COOLING**level / (math.sqrt(self.n) * longest) * forces)
            correlation = self.correlation(x)
            misfit, waited = self.misfit(correlation), waited + 1
            if misfit < least:
                best, least, waited = x, misfit, 0
            elif misfit > WORSE * least:
                x, waited = best, PATIENCE
            if waited >= PATIENCE:
                level, waited = level + 1, 0
            if progress is not None:
                progress(level, least)
        return best

    def _pairs(self, x: FloatArray) -> Iterator[Block]:
        """Pairs of each block of points with those after it: x and y apart, and their distance in bins.

        A pair that is not to be counted has a distance beyond the bins.
        """
        for start in range(0, self.n, ROWS):
            rows = slice(start, min(start + ROWS, self.n))
            dx, dy = (x[rows, None, axis] - x[None, start:, axis] for axis in (0, 1))
            dx -= np.rint(dx)
            dy -= np.rint(dy)
            place = np.sqrt(dx * dx + dy * dy) / self.width
            k = np.arange(rows.stop - start)
            place[:, : len(k)][k[:, None] >= k] = self.n
            yield rows, dx, dy, place

    def _smoothed(self, curve: FloatArray) -> FloatArray:
        return self._windowed(curve) * self._share

    def _windowed(self, curve: FloatArray) -> FloatArray:
        return np.convolve(curve, self._window)[self._reach : self._reach + self.n]


def step_correlation(edge: float, r: FloatArray) -> FloatArray:
    """Pair correlation function of a step in the plane: 1 - edge J_1(2 pi edge r) / r.

    Parameters
    ----------
    edge : float
        In nu.
    r : (...) float64
        Distances, in spacings, > 0.

    Returns
    -------
    (...) float64

    Examples
    --------
    >>> bool(abs(step_correlation(1 / np.sqrt(np.pi), np.array([1e-6]))[0]) < 1e-9)  # the widest
    True
    """
    from scipy.special import j1

    return np.asarray(1 - edge * j1(2 * math.pi * edge * r) / r)
