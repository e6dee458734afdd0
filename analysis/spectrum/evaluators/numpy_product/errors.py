"""Errors of the numpy product, worst and typical."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.numpy_product.phase_tables import (
    TURN,
    WHOLE,
    product_axes,
    real_type,
)
from gbnbench.analysis.spectrum.evaluators.numpy_product.product import (
    LISTED,
    bytes_per_point,
    chunk_points,
    scaled_weights,
)
from gbnbench.core.torus import FloatArray

# Bound of a tabulated exp(-i phase) in units of rounding: 2.4 for its angle, and two units in the last place
# for each part.
COSINE = 7.0
PRODUCT = math.sqrt(5)  # bound of a complex product, in the same units (Brent, Percival & Zimmermann 2007)


def numpy_errors(
    n: int,
    d: int,
    fmax: int,
    precision: str = "double",
    x: FloatArray | None = None,
    weights: FloatArray | None = None,
    listed: bool = False,
) -> Errors:
    """Errors of the square root of what ``numpy_power`` returns.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    precision : {"double", "float"}
        Precision of the evaluation.
    x : (n, d) float64, optional
        The points, whose coordinates then count with their actual rounding, which is none for most sets. The
        worst possible rounding is assumed if they are not given.
    weights : (n,) float64, optional
        A weight for each point.
    listed : bool
        State the errors of ``numpy_listed_power`` instead.

    Returns
    -------
    Errors
        The bound holds for every set, coincident points included; rms is typical of scattered points.

    Raises
    ------
    InputError
        If precision is neither of the two.

    Notes
    -----
    The bound is the sum of these parts, times sum |w| / sqrt(sum w^2), to first order in the unit roundoff u:

    - a coordinate is rounded to 2^-64 of a turn, which moves it by at most 2^-65 if it is below 2^-12, and
      otherwise not at all; the error is 2 pi |f| times that in each dimension;
    - a tabulated exp(-i phase) is off by 7 u, two units in the last place allowed to numpy's cosine, and a
      product of k of them by sqrt(5) u (k - 1) more;
    - a sum over K points in any order is off by K u times the sum of moduli (Higham 2002, eq. 3.5), and
      |cc| + |ss| <= 1 for each point; real and imaginary part make that sqrt(2). Chunks are added in double.
      Listed frequencies are summed pairwise.

    The typical error is the root of the sum of the parts' variances, with factors that were measured on
    random sets of 16 to 1e5 points.
    """
    u = float(np.finfo(real_type(precision)).eps) / 2
    u64 = 2.0**-53
    scaled, squares = scaled_weights(weights, n)
    worst = (n if scaled is None else float(np.abs(scaled).sum())) / math.sqrt(squares)
    phase, phase_rms = _phase_errors(n, d, fmax, x, scaled)
    if listed:
        factors, chunk, chunks = 1, 0, 18 + math.ceil(math.log2(n)) + n // LISTED
    else:
        fmaxes = product_axes(np.empty((d, 0), np.uint64), fmax)[1]
        factors = sum(1 if f <= WHOLE else 2 for f in fmaxes)
        points = chunk_points(bytes_per_point(fmaxes, real_type(precision)))
        chunk, chunks = min(n, points), -(-n // points)
    weighing = 0 if weights is None else 2
    table = u * (COSINE * factors + PRODUCT * max(0, factors - 2) + weighing)
    sums = math.sqrt(2) * (u * chunk + u64 * (min(n, chunks) + 4))
    bound = worst * min(2.0, phase + 1.01 * (table + sums))
    typical = (
        (u * 0.5) ** 2 * (factors + 0.5 * weighing)
        + (u * 0.3) ** 2 * chunk
        + (u64 * 0.3) ** 2 * (chunks + 4)
        + phase_rms**2
    )
    return Errors(rms=min(math.sqrt(typical), bound), bound=bound)


def _phase_errors(
    n: int, d: int, fmax: int, x: FloatArray | None, weights: FloatArray | None
) -> tuple[float, float]:
    """Bound the effect of rounded coordinates over sum |w|; give its typical size over the norm of w."""
    if x is None:
        rounding, mean_square = d * 0.5, d * 2.0**-12 / 12
    else:
        turns = x * TURN
        rest = np.abs(turns - np.rint(turns))
        share = np.ones(n) / n if weights is None else np.abs(weights) / np.abs(weights).sum()
        rounding = float(share @ rest.sum(axis=1))
        mean_square = float(share**2 @ (rest**2).sum(axis=1) / (share @ share))
    scale = 2 * math.pi * fmax / TURN
    return scale * rounding, scale * math.sqrt(mean_square / 3)
