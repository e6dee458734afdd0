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
from gbnbench.analysis.spatial.discrepancy_plane import distance_products, plane_squares
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, as_realizations

MOST_TERMS = 4 * 10**10  # n^2 d of one set where d > 2: seconds on two cores
SECONDS_PER_TERM = 1.3e-10  # of one core with AVX-512
PLANE_FROM = 10_000  # points of the plane from which divide and conquer is the cheaper
MOST_PLANE_POINTS = 1 << 22  # some 40 seconds of one core, and a gigabyte
WORST_ERROR = 0.01  # of the value; beyond it the value is nan
METHODS = {
    "line": "sum of squares over sorted points",
    "plane": "divide and conquer",
    "pairs": "centred pair sum in double precision",
}
_Found = tuple[float, float, str]  # value, error, reason


@dataclass(frozen=True)
class DiscrepancyResult:
    """One discrepancy of each set.

    Attributes
    ----------
    kind : Discrepancy
        Which.
    method : str
        How it was evaluated.
    value : (realizations,) float64
        nan where a reason stands.
    error : (realizations,) float64
        Bound of the value's error, which holds for every set: of the points as the doubles that they are.
    reasons : tuple of str
        Why a set's value is nan, one a set; empty where there is a value.
    """

    kind: Discrepancy
    method: str
    value: FloatArray
    error: FloatArray
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
        If d > 2 and n^2 d exceeds 4e10, as the sums run over all pairs, or d = 2 and n exceeds 2^22.
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
    sum of squares over the sorted points instead (``line_squares``). In more dimensions the centred kernel
    is summed in blocks in double precision (``pair_squares``), which suffices: the error is some 1e-14 of K's
    mean, and the square of the best sets some 1/n^2. In the plane divide and conquer (``plane_squares``) is
    the cheaper from 10,000 points on. A value whose error exceeds 1% of it is nan.

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
    if (reason := too_many_terms(n, d)) is not None:
        raise RefusalError(reason)
    method = "line" if d == 1 else "plane" if d == 2 and n >= PLANE_FROM else "pairs"
    each = [_of_set(points, kinds, method) for points in sets]
    results = {}
    for kind in kinds:
        value, error, reasons = zip(*(found[kind] for found in each), strict=True)
        results[kind] = DiscrepancyResult(kind, METHODS[method], np.array(value), np.array(error), reasons)
    return results


def too_many_terms(n: int, d: int) -> str | None:
    """Say why ``measure_discrepancies`` refuses sets of this size, and what they would take.

    Parameters
    ----------
    n, d : int
        Points of a set, and dimension.

    Returns
    -------
    str or None
        None where it does not.
    """
    if d == 2 and n > MOST_PLANE_POINTS:
        return (
            f"a discrepancy in the plane needs n of at most {MOST_PLANE_POINTS}; got n={n}: "
            f"some {n * 1e-5:.0f} seconds of one core and {n / 4e6:.0f} GB"
        )
    if d > 2 and n * n * d > MOST_TERMS:
        return (
            f"a discrepancy sums over n^2 d terms; in d={d} n must be at most "
            f"{math.isqrt(MOST_TERMS // d)}, got n={n}: "
            f"some {n * n * d * SECONDS_PER_TERM:.0f} seconds of one core"
        )
    return None


def _of_set(points: FloatArray, kinds: Sequence[Discrepancy], method: str) -> dict[Discrepancy, _Found]:
    products = distance_products(points) if method == "plane" else None
    found: dict[Discrepancy, _Found] = {}
    for kind in kinds:
        kernel = KERNELS[kind]
        fault = kernel.fault(points.shape[1])
        if fault:
            found[kind] = math.nan, math.nan, f"{kind}: {fault}"
        elif products is not None:
            found[kind] = _judged(kind, *plane_squares(points, kernel, products))
        elif method == "line":
            found[kind] = _judged(kind, *line_squares(points, kind))
        else:
            found[kind] = _judged(kind, *pair_squares(points, kernel))
    return found


def _judged(kind: Discrepancy, square: float, error: float) -> _Found:
    """Turn a square and its error into a value, or into the reason why there is none."""
    if not error <= WORST_ERROR * square:
        return math.nan, math.nan, f"{kind}: its square, {square:.2g}, is known to {error:.1g} only"
    if not KERNELS[kind].rooted:
        return square, error, ""
    root = math.sqrt(square)
    return root, error / (1.99 * root) + 2.0**-53 * root, ""
