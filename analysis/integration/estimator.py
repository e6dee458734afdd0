"""Errors of integrals estimated by the mean over points (Ahmed, Ren & Wonka 2022, Section 5.2)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.integration.integrands.protocol import Integrand
from gbnbench.core.torus import FloatArray, as_realizations

CHUNK = 1 << 20  # points handed to an integrand at once


def estimate_errors(integrands: Sequence[Integrand], x: ArrayLike) -> FloatArray:
    """Error of each integrand's estimate by each set: mean over the points less the exact integral.

    Parameters
    ----------
    integrands : sequence of Integrand
        Functions of x's dimension.
    x : (n, d) or (realizations, n, d) float64
        Points in [0, 1)^d.

    Returns
    -------
    (integrands, realizations) float64
        (1/n) sum over points of f(x_i) - I.

    Notes
    -----
    The integral is subtracted from each value before numpy sums them pairwise, so that errors far below the
    roundings of the mean itself are seen, down to some 1e-16 of a value over sqrt(n).
    """
    sets = as_realizations(x)
    count, n, d = sets.shape
    block = max(1, CHUNK // n)
    errors = np.empty((len(integrands), count))
    for first in range(0, count, block):
        points = sets[first : first + block]
        for i, integrand in enumerate(integrands):
            values = integrand(points.reshape(-1, d)).reshape(points.shape[:2])
            errors[i, first : first + block] = (values - integrand.integral).mean(axis=1)
    return errors
