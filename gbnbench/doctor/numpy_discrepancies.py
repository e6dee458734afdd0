"""L2 discrepancies in plain numpy, as their formulas are printed, that kernels are checked against."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray


def numpy_periodic_square(x: FloatArray) -> float:
    """Square of the periodic L2 discrepancy, as its formula is printed: see ``measure_discrepancies``.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus, so few that little cancels.

    Returns
    -------
    float
    """
    t = np.abs(x[:, None] - x[None])
    return float(np.prod(0.5 - t * (1 - t), axis=2).mean() - 3.0 ** -x.shape[1])


def numpy_star_square(x: FloatArray) -> float:
    """Square of the star L2 discrepancy by Warnock's formula: see ``measure_discrepancies``.

    Parameters
    ----------
    x : (n, d) float64
        Points of the unit box, so few that little cancels.

    Returns
    -------
    float
    """
    corner = np.prod(1 - np.maximum(x[:, None], x[None]), axis=2).mean()
    return float(3.0 ** -x.shape[1] - 2 * np.prod((1 - x**2) / 2, axis=1).mean() + corner)


def numpy_centred_square(x: FloatArray) -> float:
    """Centred L2 discrepancy by Hickernell's formula: see ``measure_discrepancies``.

    Parameters
    ----------
    x : (n, d) float64
        Points of the unit box, so few that little cancels.

    Returns
    -------
    float
    """
    z = np.abs(x - 0.5)
    pairs = 1 + z[:, None] / 2 + z[None] / 2 - np.abs(x[:, None] - x[None]) / 2
    means = np.prod(1 + z / 2 - z**2 / 2, axis=1)
    return float((13 / 12) ** x.shape[1] - 2 * means.mean() + np.prod(pairs, axis=2).mean())
