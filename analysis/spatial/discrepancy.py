"""L2 discrepancies with their errors (Warnock 1972; Hickernell 1998; Zhou, Fang & Ning 2013)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.spatial.discrepancy_kernels import KERNELS, Discrepancy
from gbnbench.analysis.spatial.discrepancy_line import line_squares
from gbnbench.analysis.spatial.discrepancy_pairs import pair_squares
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, as_realizations

MOST_TERMS = 4 * 10**10  # n^2 d of one set: seconds on two cores
SECONDS_PER_TERM = 1.3e-10  # of one core with AVX-512
WORST_ERROR = 0.01  # of the value; beyond it the value is nan


@dataclass(frozen=True)
class DiscrepancyResult:
    """One discrepancy of each set.

    Attributes
    ----------
    kind : Discrepancy
        Which.
    value : (realizations,) float64
        nan where a reason stands.
    error : (realizations,) float64
        Bound of the value's error, which holds for every set: of the points as the doubles that they are.
    method : str
        How it was evaluated.
    reasons : tuple of str
        Why a set's value is nan, one a set; empty where there is a value.
    """

    kind: Discrepancy
    value: FloatArray
    error: FloatArray
    method: str
    reasons: tuple[str, ...]


def discrepancies(
    x: ArrayLike, kinds: Sequence[Discrepancy] = get_args(Discrepancy)
) -> dict[Discrepancy, FloatArray]:
    """L2 discrepancies of each set; ``measure_discrepancies`` has their errors too.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points in [0, 1)^d.
    kinds : sequence of {"CD", "WD", "MD", "L2-star", "L2-periodic", "diaphony"}
        The discrepancies to compute; all by default.

    Returns
    -------
    dict
        Kind -> (realizations,) float64; nan where ``measure_discrepancies`` has a reason.

    Raises
    ------
    RefusalError
        As ``measure_discrepancies``.
    InputError
        As ``measure_discrepancies``.

    Examples
    --------
    The centred grid on the line, whose wrap-around discrepancy is 1 / (6 n^2):

    >>> grid = (np.arange(20_000)[:, None] + 0.5) / 20_000
    >>> bool(abs(discrepancies(grid, ["WD"])["WD"][0] * 6 * 20_000**2 - 1) < 1e-12)
    True
    """
    return {kind: found.value for kind, found in measure_discrepancies(x, kinds).items()}


def measure_discrepancies(
    x: ArrayLike, kinds: Sequence[Discrepancy] = get_args(Discrepancy)
) -> dict[Discrepancy, DiscrepancyResult]:
    """L2 discrepancies of each set with their errors.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points in [0, 1)^d.
    kinds : sequence of {"CD", "WD", "MD", "L2-star", "L2-periodic", "diaphony"}
        The discrepancies to compute; all by default.

    Returns
    -------
    dict
        Kind -> ``DiscrepancyResult``. As SciPy defines them, CD, WD and MD are squares and L2-star is not;
        nor are L2-periodic and diaphony.

    Raises
    ------
    RefusalError
        If d > 1 and n^2 d exceeds 4e10: the sums run over all pairs.
    InputError
        If a kind is none of these.

    Notes
    -----
    With t = |x_a - y_a| on each axis, and K the product of a factor over the axes, the square of each is
    the mean of K over all n^2 pairs of points, less twice the mean over points of K's integral over one
    argument, plus its integral over both. The factors are

    - CD, centred: 1 + |x_a - 1/2|/2 + |y_a - 1/2|/2 - t/2 (Hickernell 1998a);
    - WD, wrap-around: 3/2 - t (1 - t) (Hickernell 1998b);
    - MD, mixture: 15/8 - |x_a - 1/2|/4 - |y_a - 1/2|/4 - 3 t/4 + t^2/2 (Zhou, Fang & Ning 2013);
    - L2-star: 1 - max(x_a, y_a) (Warnock 1972), the root mean square over boxes from the origin of the share
      of points in the box less its volume;
    - L2-periodic: 1/2 - t (1 - t) (Lev 1995; Hinrichs & Oettershagen 2016), the same over all boxes of the
      torus, both corners uniform. Some authors count points, which gives n times as much;
    - diaphony: 1 + 2 pi^2 (1/6 - t (1 - t)) (Zinterhof 1976), the root of the sum over integer f != 0 of
      P(f) / n over the product over axes of max(1, |f_a|)^2.

    The last and WD and L2-periodic do not change when the set is shifted on the torus. Their factors are a
    constant plus a multiple of B2(t) = t^2 - t + 1/6, so that on the line they are the same but for scale,
    and WD is the sum of the squares of L2-periodic over all projections on some of the axes.

    Written like this the three terms of nearly uniform sets agree in all digits. On the line the value is a
    sum of squares over the sorted points instead (``line_squares``), in more dimensions the centred kernel
    is summed in blocks in double precision (``pair_squares``), which suffices: the error is a few times
    1e-15 of K's mean, and no set's square falls far below 1/n^2. A value whose error exceeds 1% of it is nan.

    References
    ----------
    Hickernell, "A generalized discrepancy and quadrature error bound", Mathematics of Computation 67, 1998a.
    Hickernell, "Lattice rules: how well do they measure up?", in Random and Quasi-Random Point Sets, 1998b.
    Hinrichs & Oettershagen, "Optimal point sets for quasi-Monte Carlo integration of bivariate periodic
    functions with bounded mixed derivatives", MCQMC 2014, 2016. Lev, "On two versions of L2-discrepancy and
    geometrical interpretation of diaphony", Acta Mathematica Hungarica 69, 1995. Warnock, "Computational
    investigations of low-discrepancy point sets", in Applications of Number Theory to Numerical Analysis,
    1972. Zhou, Fang & Ning, "Mixture discrepancy for quasi-random point sets", Journal of Complexity 29,
    2013. Zinterhof, "Über einige Abschätzungen bei der Approximation von Funktionen mit
    Gleichverteilungsmethoden", Sitzungsberichte der Österreichischen Akademie der Wissenschaften II 185,
    1976.

    Examples
    --------
    >>> import gbnbench
    >>> found = measure_discrepancies(gbnbench.generate("sobol", n=256, seed=1), ["WD"])["WD"]
    >>> bool(found.error[0] < 1e-9 * found.value[0])
    True
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    unknown = [kind for kind in kinds if kind not in KERNELS]
    if unknown:
        raise InputError(f"discrepancies are {', '.join(KERNELS)}; got {unknown[0]!r}")
    if d > 1 and n * n * d > MOST_TERMS:
        raise RefusalError(
            f"a discrepancy sums over n^2 d terms; in d={d} n must be at most "
            f"{math.isqrt(MOST_TERMS // d)}, got n={n}: "
            f"some {n * n * d * SECONDS_PER_TERM:.0f} seconds of one core"
        )
    return {kind: _measured(sets, kind) for kind in kinds}


def _measured(sets: FloatArray, kind: Discrepancy) -> DiscrepancyResult:
    d = sets.shape[2]
    fault = KERNELS[kind].fault(d)
    found = [(math.nan, math.nan, fault)] * len(sets) if fault else [_of_set(points, kind) for points in sets]
    value, error, reasons = zip(*found, strict=True)
    method = "sum of squares over sorted points" if d == 1 else "centred pair sum, double"
    return DiscrepancyResult(
        kind,
        np.array(value),
        np.array(error),
        method,
        tuple(f"{kind}: {why}" if why else "" for why in reasons),
    )


def _of_set(points: FloatArray, kind: Discrepancy) -> tuple[float, float, str]:
    """Value, error and reason of one set."""
    kernel = KERNELS[kind]
    square, error = line_squares(points, kind) if points.shape[1] == 1 else pair_squares(points, kernel)
    if not error <= WORST_ERROR * square:
        return math.nan, math.nan, f"its square, {square:.2g}, is known to {error:.1g} only"
    if not kernel.rooted:
        return square, error, ""
    root = math.sqrt(square)
    return root, error / (1.99 * root) + 2.0**-53 * root, ""
