"""L2 discrepancies of point sets, by SciPy (Warnock 1972; Hickernell 1998; Zhou, Fang & Ning 2013)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import qmc

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray, as_realizations

Discrepancy = Literal["CD", "WD", "MD", "L2-star"]
# Terms n^2 d of one set that SciPy sums in about a second a discrepancy.
MOST_TERMS = 10**9


def discrepancies(
    x: ArrayLike, kinds: Sequence[Discrepancy] = get_args(Discrepancy)
) -> dict[Discrepancy, FloatArray]:
    """Centred, wrap-around, mixture and star L2 discrepancies of each set, by ``scipy.stats.qmc``.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) float64
        Points in [0, 1)^d.
    kinds : sequence of {"CD", "WD", "MD", "L2-star"}
        The discrepancies to compute; all by default.

    Returns
    -------
    dict
        Kind -> (realizations,) float64. As SciPy defines them, the first three are squares and the last is
        not. Only WD does not change when the set is shifted on the torus.

    Raises
    ------
    RefusalError
        If n^2 d exceeds 1e9: the sums run over all pairs.
    """
    sets = as_realizations(x)
    n, d = sets.shape[1:]
    if n * n * d > MOST_TERMS:
        most = int((MOST_TERMS / d) ** 0.5)
        raise RefusalError(
            f"discrepancies sum over n^2 d terms; in d={d} n must be at most {most}, got n={n}"
        )
    return {kind: np.array([qmc.discrepancy(points, method=kind) for points in sets]) for kind in kinds}
