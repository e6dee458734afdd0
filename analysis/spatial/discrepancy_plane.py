"""Squares of the L2 discrepancies in the plane by divide and conquer, in n log^2 n steps (Heinrich 1996)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spatial.discrepancy_kernels import ProductKernel
from gbnbench.core.double_double import DoubleDouble, exact_sum, running_sum
from gbnbench.core.torus import FloatArray

UNITS = 64  # error of the sum of distance products in units of 2^-53 of what it adds up, rounded up


@dataclass(frozen=True)
class DistanceProducts:
    """Sum over pairs of |x_i - x_j| |y_i - y_j|, which every discrepancy of the plane contains.

    Attributes
    ----------
    value : float
        Over all n^2 ordered pairs.
    error : float
        Bound of its error.
    """

    value: float
    error: float


def distance_products(points: FloatArray) -> DistanceProducts:
    """Sum |x_i - x_j| |y_i - y_j| over all pairs.

    Parameters
    ----------
    points : (n, 2) float64
        Points in [0, 1)^2.

    Returns
    -------
    DistanceProducts

    Notes
    -----
    Points are sorted by x; at every level blocks of them are sorted by y, by merging their halves. A pair
    falls into the two halves of one block at one level, where x_i - x_j = (x_i - s) + (s - x_j), s being the
    first x of the right half. Sums over the left half of |y_i - y_j| and (s - x_j) |y_i - y_j| are
    differences of running sums in the order of y. Only terms as small as the block is wide are added up.
    """
    n = len(points)
    size = 1 << (n - 1).bit_length()
    by_x = np.argsort(points[:, 0], kind="stable")
    x, y, weight = np.zeros(size), np.zeros(size), np.zeros(size)
    x[:n], y[:n], weight[:n] = points[by_x, 0], points[by_x, 1], 1.0
    x[n:] = x[n - 1]
    rank = np.empty(size, dtype=np.int32)
    rank[np.argsort(y, kind="stable")] = np.arange(size, dtype=np.int32)
    members: NDArray[np.intp] = np.arange(size, dtype=np.intp)
    totals, masses, width = [], [], 1
    while width < size:
        width *= 2
        halves = members.reshape(-1, width)
        members = np.take_along_axis(halves, np.argsort(rank[halves], axis=1, kind="stable"), axis=1)
        split = x[width // 2 :: width, None]
        left = np.where(members & (width // 2), 0.0, weight[members])
        right = weight[members] - left
        height, away = y[members], np.abs(x[members] - split)
        count, moment = running_sum(left), running_sum(left * away)
        first = _sums_of_distances(height, count, running_sum(left * height))
        second = _sums_of_distances(height, moment, running_sum(left * away * height))
        totals.append(float(np.sum(right * (away * first + second))))
        masses.append(float(np.sum(right * (away * count[:, -1:] + moment[:, -1:]))))
    # The running sums' own rest, at most width^4 2^-106 of the widest distance in all of a level.
    error = 2 * UNITS * 2.0**-53 * math.fsum(masses) + size**4 * 2.0**-104
    return DistanceProducts(2 * math.fsum(totals), error)


def _sums_of_distances(height: FloatArray, weight: FloatArray, moment: FloatArray) -> FloatArray:
    """Sum w_j |y - y_j| at each place y, from the running sums of w and w y in the order of y."""
    return height * (2 * weight - weight[:, -1:]) - (2 * moment - moment[:, -1:])


def plane_squares(
    points: FloatArray, kernel: ProductKernel, products: DistanceProducts
) -> tuple[float, float]:
    """Square of a discrepancy, and the bound of its error.

    Parameters
    ----------
    points : (n, 2) float64
        Points in [0, 1)^2.
    kernel : ProductKernel
        Kernel of the discrepancy.
    products : DistanceProducts
        Of the same points; they serve all kernels.

    Returns
    -------
    square, error : float
        The square may be negative where it is smaller than the error.

    Notes
    -----
    Each factor is q(u) + q(v) - 2 curve u v - slope |u - v| with q = p + curve u^2. Of the product of two,
    what has no distance is a polynomial of moments, what has one needs running sums along one axis, and what
    has two is ``products``. The first are found in double-double and added up exactly, so that only the last
    errs. Heinrich (1996) has the idea, for the star.

    References
    ----------
    Heinrich, "Efficient algorithms for computing the L2-discrepancy", Mathematics of Computation 65, 1996.
    """
    n = len(points)
    axes = [DoubleDouble.of(points[:, axis]) for axis in range(2)]
    q = [kernel.offsets(u) + DoubleDouble.of(Fraction(kernel.curve)) * (u * u) for u in axes]
    (x, y), (qx, qy) = axes, q
    slope, curve = Fraction(kernel.slope), Fraction(kernel.curve)
    total = 2 * n * exact_sum(qx * qy) + 2 * exact_sum(qx) * exact_sum(qy)
    total -= 4 * curve * (exact_sum(qx * y) * exact_sum(y) + exact_sum(qy * x) * exact_sum(x))
    total += 4 * curve**2 * exact_sum(x * y) ** 2
    for (u, qu), v in (((x, qx), y), ((y, qy), x)):
        total -= 2 * slope * _one_distance(u, qu, v, curve)
    total += slope**2 * Fraction(products.value)
    total += n**2 * kernel.grand_mean**2 - 2 * n * exact_sum(kernel.means(points))
    square = float(total / n**2)
    return square, kernel.slope**2 * products.error / n**2 + 2.0**-52 * abs(square)


def _one_distance(u: DoubleDouble, q: DoubleDouble, v: DoubleDouble, curve: Fraction) -> Fraction:
    """Sum (q_i - curve u_i u_j) |v_i - v_j| over all pairs."""
    order = np.argsort(v.high, kind="stable")
    n = len(order)
    u, q, v = u[order], q[order], v[order]
    ends = DoubleDouble.of(2.0 * np.arange(1, n + 1, dtype=np.float64) - n)
    distances = v * ends + -v.below_less_above()
    weighted = v * u.below_less_above() + -(u * v).below_less_above()
    return exact_sum(q * distances) - curve * exact_sum(u * weighted)
